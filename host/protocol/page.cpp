#include "host/protocol/page.hpp"

#include <iterator>

#include <fmt/format.h>

#include "firmware/can/e2e.hpp"
#include "firmware/can/ids.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/can/param_server.hpp"
#include "firmware/can/table_hash.hpp"
#include "host/protocol/entries.hpp"
#include "host/protocol/examples.hpp"
#include "host/protocol/page_text.hpp"
#include "host/scenario/params_text.hpp"

namespace whisker::protocol {
namespace {

class Writer {
 public:
  std::string text() {
    out_ = fmt::format(kBeginning, fmt::arg("most_lost", can::kMostLost),
                       fmt::arg("most_ahead", can::kMostLost + 1));
    out_ += fmt::format(kOrder, fmt::arg("hash", can::kTableHash), fmt::arg("order_ms", can::kOrderRepeat_ms),
                        fmt::arg("protocol", can::kProtocol), fmt::arg("heartbeat", can::kHeartbeat_ms),
                        fmt::arg("old", can::kCommandOld_ms), fmt::arg("stop_repeat", can::kStopRepeat_ms),
                        fmt::arg("velocity_late", can::kVelocityLate_ms), fmt::arg("peer", can::kPeerLost_ms),
                        fmt::arg("velocity_cycle", can::message_of(can::MessageKind::velocity).cycle_ms));
    out_ += fmt::format(kRules, fmt::arg("nodes", fuzzy::kTableNodes), fmt::arg("block", can::kRulesBlock),
                        fmt::arg("repeat", can::kRulesRepeat_ms));
    out_ += kCalibration;
    out_ += examples();
    out_ += fmt::format(
        kStates, fmt::arg("velocity_late", can::kVelocityLate_ms), fmt::arg("hold", can::kHoldAfter_ms),
        fmt::arg("range", can::kRangeLatch_ms), fmt::arg("odometry", can::kOdometryLate_ms),
        fmt::arg("command", can::kCommandLate_ms), fmt::arg("old", can::kCommandOld_ms),
        fmt::arg("peer", can::kPeerLost_ms), fmt::arg("restart", can::kRestartAfter_ms),
        fmt::arg("limit", can::kBusOffLimit), fmt::arg("window", can::kBusOffWindow_ms / 1000));
    errors();
    messages();
    for (const can::Message& m : can::kMessages) signals(m);
    params();
    return out_;
  }

 private:
  template <class... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
  }

  void errors() {
    put("## Errors\n\nThe bits of Errors in Heartbeat and of Code in Fault.\n\n| bit | name |\n|---|---|\n");
    for (int bit = 0; bit < 16; ++bit) {
      if (const char* word = can::word_in<can::kErrorWords>(bit)) put("| {} | {} |\n", bit, word);
    }
  }

  static std::string senders(const can::Message& m) {
    if (m.from_operator) return m.from_base ? "base and operator" : "operator";
    if (m.from_controller && m.from_base) return "both";
    return m.from_controller ? "controller" : "base";
  }

  void messages() {
    put("\n## Messages\n\nThe identifiers are those of robot 1, sent by its controller, its base and its "
        "operator.\n\n"
        "| message | function | controller | base | operator | bytes | period | meaning "
        "|\n|---|---|---|---|---|---|---|---|\n");
    for (const can::Message& m : can::kMessages) {
      const auto id = [&](bool sends, can::Party party) {
        return sends ? fmt::format("0x{:03X}", can::id_of(m.function, can::node_of(1, party))) : "";
      };
      put("| {} | 0x{:02X} | {} | {} | {} | {} | {} | {} |\n", m.name, m.function,
          id(m.from_controller, can::Party::controller), id(m.from_base, can::Party::base),
          id(m.from_operator, can::Party::controller), m.size,
          m.cycle_ms > 0 ? fmt::format("{} ms", m.cycle_ms) : "on an event", m.about);
    }
  }

  static std::string words(const can::Signal& s) {
    if (s.word == nullptr) return "";
    std::string list;
    for (std::int64_t raw = s.min; raw <= s.max; ++raw) {
      if (const char* word = s.word(raw)) list += fmt::format("{}{} {}", list.empty() ? "" : ", ", raw, word);
    }
    return list;
  }

  void signals(const can::Message& m) {
    put("\n### {}\n\nFrom {}: {}.\n\n| signal | bits | sign | raw range | unit of 1 | meaning |\n"
        "|---|---|---|---|---|---|\n",
        m.name, senders(m), m.about);
    for (std::uint8_t i = 0; i < m.count; ++i) {
      const can::Signal& s = m.signals[i];
      const std::string part = s.part >= 0 ? fmt::format(" (part {})", s.part) : "";
      const std::string unit = *s.unit != 0 ? fmt::format("{} {}", s.factor, s.unit) : "";
      const std::string named = words(s);
      put("| {}{} | {}..{} | {} | {}..{} | {} | {}{}{} |\n", s.name, part, s.start, s.start + s.length - 1,
          s.is_signed ? "signed" : "", s.min, s.max, unit, s.about,
          *s.about != 0 && !named.empty() ? ": " : "", named);
    }
  }

  void number_row(const char* name, const char* unit, std::int64_t raw, std::int64_t low, std::int64_t high) {
    put("| {} | {} | {} | {} | {}..{} |\n", index_++, name, unit, raw, low, high);
  }

  void params();

  friend class ParamRows;
  std::string out_;
  int index_ = 0;
};

/// Visitor for for_each_param.
class ParamRows {
 public:
  explicit ParamRows(Writer& writer) : writer_(writer) {}
  void number(const char* key, const Length& x, Length low, Length high) { row(key, "um", x, low, high); }
  void number(const char* key, const Speed& x, Speed low, Speed high) { row(key, "um/s", x, low, high); }
  void number(const char* key, const Acceleration& x, Acceleration low, Acceleration high) {
    row(key, "um/s2", x, low, high);
  }
  void number(const char* key, const AngularRate& x, AngularRate low, AngularRate high) {
    row(key, "urad/s", x, low, high);
  }
  void number(const char* key, const Duration& x, Duration low, Duration high) {
    row(key, "ms", x, low, high);
  }
  void number(const char* key, const Ratio& x, Ratio low, Ratio high) { row(key, "1e-6", x, low, high); }
  void number(const char* key, const Angle& x, Angle low, Angle high) {
    row(key, "2^-32 turn", x, low, high);
  }
  void number(const char* key, const Direction& x, Direction low, Direction high) {
    row(key, "2^-32 turn", x, low, high);
  }
  void count(const char* key, const int32_t& x, int32_t low, int32_t high) {
    writer_.number_row(key, "1", x, low, high);
  }
  template <class E>
  void choice(const char* key, const E& x, const char* const*, int names) {
    writer_.number_row(key, "choice", static_cast<std::int64_t>(x), 0, names - 1);
  }

 private:
  template <class T>
  void row(const char* key, const char* unit, T x, T low, T high) {
    writer_.number_row(key, unit, x.raw(), low.raw(), high.raw());
  }
  Writer& writer_;
};

void Writer::params() {
  out_ += kParams;
  const Params defaults;
  ParamRows rows(*this);
  for_each_param(defaults, rows);
  put("\nRelations between parameters. Value of an inconsistent commit is the number.\n\n| number | relation "
      "|\n|---|---|\n");
  for (int i = 0; i <= UINT8_MAX; ++i) {
    const std::string words = relation(static_cast<ParamFault>(i)).words;
    if (!words.empty()) put("| {} | {} |\n", i, words);
  }
}

}  // namespace

std::string page() { return Writer().text(); }

}  // namespace whisker::protocol
