#include "host/harness/hil/error_names.hpp"

#include <fmt/format.h>

#include "firmware/can/value_names.hpp"

namespace whisker::hil {
std::string error_names(std::uint16_t errors) {
  std::string words;
  for (int bit = 0; bit < 16; ++bit) {
    if ((errors >> bit & 1) == 0) continue;
    const char* const word = can::word_in<can::kErrorWords>(bit);
    words += (words.empty() ? "" : ", ") + std::string(word != nullptr ? word : "unknown");
  }
  return words;
}

std::string waits_for(const can::BaseNode& node, const BusOptions& options) {
  const std::string what = options.bus_waits_for ? options.bus_waits_for() : "";
  switch (node.state()) {
    case can::NodeState::off_bus: return "waits for " + (what.empty() ? "the bus" : what);
    case can::NodeState::waiting:
      if ((node.errors() & can::Error::wrong_version) != 0) return "the controller speaks another protocol";
      return "waits for the controller" + (what.empty() ? "" : ", and for " + what);
    case can::NodeState::e_stopped: return "E-stop";
    case can::NodeState::safe_stop: return "safe stop: " + error_names(node.errors());
    case can::NodeState::ready:
    case can::NodeState::running: break;
  }
  return "";
}

void refuse_rules(std::uint32_t had, std::uint32_t wanted) {
  if (had == 0) throw OtherRules("the controller has no response table, and takes none");
  throw OtherRules(
      fmt::format("the controller drives with the response table {:08x}, not {:08x}, and takes no other; "
                  "start it with the same --rules",
                  had, wanted));
}

void refuse_calibration(const can::BaseNode& node, can::Order order) {
  if (!calibrates(order) || node.order_state() != can::OrderState::refused) return;
  if (node.order_status() == can::MissionStatus::unsupported)
    throw NoCalibration("the controller does not calibrate; whisker controller does with --calibration");
  if (node.order_status() == can::MissionStatus::out_of_range)
    throw NoCalibration("a straight calibration is 0.5 m long at least: the goal is too near");
}

}  // namespace whisker::hil
