#include "host/lab/protocol/entries.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "firmware/can/e2e.hpp"
#include "firmware/can/ids.hpp"

namespace whisker::protocol {

const can::Signal kProtection[2] = {
    {"Crc", 0, 8, false, 0, 255, "1", "", "over the identifier and all bytes after it"},
    {"Counter", 8, 4, false, 0, can::kAliveModulus - 1, "1", "", "one more with every frame"},
};

std::vector<Entry> entries_of(std::uint8_t robot) {
  std::vector<Entry> out;
  const can::Message& e_stop = can::message_of(can::MessageKind::e_stop);
  out.push_back({&e_stop, can::id_of(e_stop.function, 0), "EStopAll", ""});
  for (const can::Message& m : can::kMessages) {
    const auto add = [&](can::Party party, const char* sender, bool named) {
      const std::uint32_t id = can::id_of(m.function, can::node_of(robot, party));
      out.push_back({&m, id, named ? fmt::format("{}{}", m.name, sender) : m.name, sender});
    };
    const bool both = m.from_controller && m.from_base;
    if (m.from_controller) add(can::Party::controller, "Controller", both);
    if (m.from_base) add(can::Party::base, "Base", both);
    if (m.from_operator) add(can::Party::controller, "Operator", m.from_base);
  }
  std::sort(out.begin(), out.end(), [](const Entry& a, const Entry& b) { return a.id < b.id; });
  return out;
}

std::string physical(const can::Signal& signal, std::int64_t raw) {
  return fmt::format("{:.10g}", static_cast<double>(raw) * std::strtod(signal.factor, nullptr));
}

}  // namespace whisker::protocol
