#include "host/lab/protocol/page.hpp"

#include <iterator>
#include <string>

#include <fmt/format.h>

#include "firmware/can/codec.hpp"
#include "firmware/can/e2e.hpp"
#include "firmware/can/ids.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/can/param_server.hpp"
#include "firmware/can/table_hash.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/lab/protocol/entries.hpp"
#include "host/lab/protocol/page_text.hpp"

namespace whisker::protocol {
namespace {

constexpr std::uint8_t kController = can::node_of(1, can::Party::controller);
constexpr std::uint8_t kBase = can::node_of(1, can::Party::base);
constexpr std::uint8_t kOperator = kController;
constexpr std::uint16_t kBoot = 0x1234;

class Section {
 public:
  std::string text() {
    out_ = "## Frames as examples\n\n";
    crc();
    out_ +=
        "\nOf robot 1, in the order of a run; each is the first of its identifier, or counts on from the row "
        "above.\n\n| what | SLCAN |\n|---|---|\n";
    handshake();
    mission();
    ticks();
    others();
    return out_ + "\n";
  }

 private:
  /// The steps of one CRC, and two frames of AUTOSAR's form.
  void crc() {
    const hal::CanFrame frame = can::encode(can::Heartbeat{}, kBase, 0);
    std::uint8_t value = 0;
    std::string steps;
    const auto step = [&](std::uint8_t byte) {
      value = can::crc8::add(value, byte);
      steps += fmt::format("{}{:02X} -> {:02X}", steps.empty() ? "" : ", ", byte, value);
    };
    step(static_cast<std::uint8_t>(frame.id));
    step(static_cast<std::uint8_t>(frame.id >> 8));
    for (std::uint8_t i = 1; i < frame.size; ++i) step(frame.data[i]);
    std::string bytes;
    for (std::uint8_t i = 1; i < frame.size; ++i) bytes += fmt::format(" {:02X}", frame.data[i]);
    out_ += fmt::format(
        "CRC of a Heartbeat with identifier 0x{:03X} and{} as bytes 1 to {}, byte by byte:\n{}. So byte 0 is "
        "{:02X}.\n",
        frame.id, bytes, frame.size - 1, steps, frame.data[0]);
    const std::uint8_t zeros[8] = {}, one[8] = {0, 1};
    out_ += fmt::format(
        "With identifier 0x123 and eight bytes, all others 0, it is {:02X} for counter 0 and {:02X} for "
        "counter 1.\n",
        can::crc_of(0x123, zeros, 8), can::crc_of(0x123, one, 8));
  }

  template <class M>
  void row(const std::string& what, const M& m, std::uint8_t node, std::uint8_t counter = 0) {
    const hal::CanFrame frame = can::encode(m, node, counter);
    std::string line = fmt::format("t{:03X}{}", frame.id, frame.size);
    for (std::uint8_t i = 0; i < frame.size; ++i) line += fmt::format("{:02X}", frame.data[i]);
    out_ += fmt::format("| {} {} | `{}` |\n", can::message_of(M::kKind).name, what, line);
  }

  void handshake() {
    can::Heartbeat beat;
    beat.state = can::NodeState::waiting;
    beat.boot = kBoot;
    row("of the base: waiting, Boot 0x1234", beat, kBase);
    row("of the base: part 0", can::Info{can::InfoPart::table_hash, kBoot, can::kTableHash}, kBase);
    row("of the controller", can::InfoRequest{}, kController);
    row("of the base", can::InfoRequest{}, kBase);
  }

  void mission() {
    const can::Mission mission{{}, {{3_m, Length::from_raw(-500000)}, 100_mm}};
    const can::MissionValues values = can::values_of(mission);
    const char* const names[] = {"StartX 0",  "StartY 0",     "StartHeading 0",
                                 "GoalX 3 m", "GoalY -0.5 m", "GoalTolerance 0.1 m"};
    std::uint8_t counter = 0;
    for (int i = 0; i < can::kMissionValues; ++i) {
      const auto part = static_cast<can::MissionPart>(i + 1);
      row(fmt::format("1, part {}: {}", i + 1, names[i]), can::MissionValue{part, 1, values.of[i]}, kBase,
          counter++);
    }
    const std::uint16_t digest = can::digest_of(values);
    row(fmt::format("1, part 0: start, Digest 0x{:04X}", digest),
        can::MissionOrder{can::MissionPart::order, 1, can::Order::start, digest}, kBase, counter);
    row("1: accepted", can::MissionReply{can::MissionStatus::accepted, 1}, kController);
  }

  void ticks() {
    using can::MessageKind;
    using hal::RangeStatus;
    using Left = can::Range<MessageKind::range_left>;
    row("clear, Age 0.02 s, Sequence 1, Tick 1", Left{{Left::kClear, RangeStatus::clear, 20, 1}, 1}, kBase);
    row("ok, 1.234 m", can::Range<MessageKind::range_front>{{1234, RangeStatus::ok, 20, 1}, 1}, kBase);
    row("stale", can::Range<MessageKind::range_right>{{Left::kNone, RangeStatus::stale, 255, 0}, 1}, kBase);
    row("100 left, -1 right", can::WheelState{1, 1, {100, hal::kEncoderModulus - 1}}, kBase);
    row("Sum -1, 5 samples, Tick 1; only with a gyro", can::GyroState{1, 1, {UINT32_MAX, 5, 0}}, kBase);
    row("lockstep, Tick 1, Period 10 ms, Mission 1", can::Sync{can::SyncMode::lockstep, 1, 10, 1}, kBase);
    row("drive, 0.3 m/s left, -0.3 m/s right, Tick 1",
        can::WheelCommand{can::DriveMode::drive, {3000, -3000}, 1}, kController);
    can::NavStatus status;
    status.outcome = planning::Outcome::running;
    status.tick = 1;
    row("running, Tick 1", status, kController);
  }

  void others() {
    row("write index 0: 80000", can::ParamRequest{can::ParamAction::write, 0, 80000}, kBase);
    row("ok, index 0: 80000", can::ParamReply{can::ParamStatus::ok, 0, 80000}, kController);
    row("of the operator: read index 0", can::ParamRequest{can::ParamAction::read, 0, 0}, kOperator);
    row("ok, index 0: 80000, to the operator", can::ParamReply{can::ParamStatus::ok, 0, 80000, 1},
        kController, 1);
    const std::uint16_t digest = can::digest_of(can::values_of({{}, {{}, 1_mm}}));
    row(fmt::format("9 of the operator, part 0: cancel, Digest 0x{:04X}", digest),
        can::MissionOrder{can::MissionPart::order, 9, can::Order::cancel, digest}, kOperator);
    row("9: accepted, to the operator", can::MissionReply{can::MissionStatus::accepted, 9, 1}, kController,
        1);
    row("part 0: X 1 m, Tick 2", can::FixValue{can::FixPart::x, 2, 1000000}, kBase);
    row("accepted, Tick 2", can::FixReply{can::FixStatus::accepted, 2, 0, 0}, kController);
    row("of the operator: 0.25 m/s ahead, -1 rad/s", can::VelocityCommand{2500, -1000}, kOperator);
    row("1 of the operator: 0.35 m", can::VouchRequest{1, 350}, kOperator);
    can::GuardReport guard;
    guard.reason = 5;
    guard.asked_forward = 2500;
    guard.asked_turning = -1000;
    guard.granted_forward = 40;
    guard.granted_turning = 100;
    guard.armed = 1;
    row("obstacle: 40 % of that, armed", guard, kController);
    row("1: activate the table with the hash 0x18749DCC",
        can::RulesOrder{1, can::RulesAction::activate, 0x18749DCC}, kBase);
    row("1: node 7, Turn 0, Step 0.3", can::RulesPart{1, 7, {0, 4915}}, kBase);
    row("1: receiving, next is node 8", can::RulesReply{can::RulesStatus::receiving, 1, 0, 8}, kController);
    row("gyro_scale 1.014295 +- 0.0075 %, saved; of order 4",
        can::CalibrationReport{calibration::Quantity::gyro_scale, planning::Trouble::none,
                               storage::Stored::ok, 4, 1014295, 75},
        kController);
    row("of the base: clear; its counter is not judged", can::EStop{can::kClearCommand}, kBase);
  }

  std::string out_;
};

/// Frames of robot 1 encoded by the codec: a section of docs/protocol.md.
std::string examples() { return Section().text(); }

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

  void derived_row(const char* name) { put("| {} | {} | derived | | |\n", index_++, name); }

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
  void derived(const char* key) { writer_.derived_row(key); }

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
