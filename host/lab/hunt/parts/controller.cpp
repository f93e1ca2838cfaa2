// The node that decides, beside a base and an operator that this judge plays.
#include "firmware/can/controller_node.hpp"

#include <algorithm>
#include <cstdlib>

#include "firmware/can/limits.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/lab/hunt/parts/parts.hpp"
#include "host/lab/hunt/parts/voice.hpp"

namespace whisker::hunt {
namespace {

using namespace can;

constexpr std::uint16_t kBoot = 500;

struct Bench {
  bus::MemoryBus wire;
  ControllerNode node{wire.attach(), {1, kBoot, 0x000100, 0x1234}};
  Voice peer{wire, 9};
  Voice hand{wire, 1};  // the operator's frames have the node's number
  Dice& dice;
  std::uint32_t now, tick;
  std::uint16_t boot = 600;
  std::uint8_t mission = 7;
  SyncMode sync = SyncMode::real_time;
  bool beats = true, sends[5] = {true, true, true, true, true};
  int steps = 0, orders = 0;
  Order ordered = Order::cancel;
  Mission got;
  hal::RangeReading ranges[3] = {};
  hal::EncoderCounts counts{};
  hal::WheelSpeeds speeds{1000, 900};
  NavStatus status;
  std::string wrong;

  explicit Bench(Dice& d) : dice(d) {
    now = dice.chance(0.3) ? 0xFFFFF800U : static_cast<std::uint32_t>(dice.index(100000));
    tick = dice.chance(0.3) ? 0xFFFFFFF0U : static_cast<std::uint32_t>(dice.index(100000));
    status.why = planning::Why::target_free;
    status.danger = static_cast<std::uint8_t>(dice.index(200));
    for (hal::RangeReading& r : ranges)
      r = {static_cast<std::uint16_t>(dice.index(2000)), hal::RangeStatus::ok,
           static_cast<std::uint8_t>(dice.index(200)), static_cast<std::uint8_t>(dice.index(16))};
    peer.poll(now);
    node.poll(now);
    hand.poll(now);
  }
  /// In any order; the last one is the sync.
  void send_set(std::uint32_t t) {
    const auto t16 = static_cast<std::uint16_t>(t);
    const int first = dice.index(4);
    for (int i = 0; i < 4; ++i) {
      const int k = (first + i) % 4;
      if (!sends[k]) continue;
      if (k == 0) peer.say(Range<MessageKind::range_left>{ranges[0], t16});
      if (k == 1) peer.say(Range<MessageKind::range_front>{ranges[1], t16});
      if (k == 2) peer.say(Range<MessageKind::range_right>{ranges[2], t16});
      if (k == 3) peer.say(WheelState{1, static_cast<std::uint8_t>(t % 8), counts});
    }
    if (sends[4]) peer.say(Sync{sync, t, 10, mission});
  }
  void pass() {
    ++now;
    if (beats && now % 100 == 0) {
      Heartbeat beat;
      beat.boot = boot;
      beat.state = NodeState::running;
      peer.say(beat);
    }
    if (now % 10 == 0 && sync == SyncMode::real_time) send_set(++tick);
    peer.poll(now);
    node.poll(now);
    hand.poll(now);
    if (node.take_order(ordered, got)) ++orders;
    InputSet set;
    if (node.take_set(set)) take(set);
    peer.poll(now);
  }
  void take(const InputSet& set) {
    ++steps;
    if (set.tick != tick) wrong = "a set of another tick";
    if (!set.counts_valid || set.counts.left != counts.left || set.counts.right != counts.right ||
        set.period_ms != 10)
      wrong = "other counts in a set";
    for (int i = 0; i < 3; ++i) {
      const hal::RangeReading& r = set.ranges.beam[i];
      if (r.mm != ranges[i].mm || r.age_ms != ranges[i].age_ms || r.sequence != ranges[i].sequence)
        wrong = "other ranges in a set";
    }
    node.answer(speeds, status);
  }
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) pass();
  }
  template <class F>
  int until(const F& holds) {
    int ms = 0;
    while (ms < 1000 && !holds()) {
      pass();
      ++ms;
    }
    return ms;
  }
  void order(Voice& voice, Order what, const Mission& m) {
    const MissionValues values = values_of(m);
    for (int i = 0; i < kMissionValues; ++i)
      voice.say(MissionValue{static_cast<MissionPart>(i + 1), mission, values.of[i]});
    voice.say(MissionOrder{MissionPart::order, mission, what, digest_of(values)});
    pass(2);
  }
  Mission draw_mission() {
    const auto length = [&] { return micrometres(dice.index(2000000) - 1000000); };
    return {{{length(), length()}, Angle::turns(dice.index(360), 360)},
            {{length() + 3_m, length()}, millimetres(1 + dice.index(200))}};
  }
  /// Also that the answer is to this order, and to the base.
  bool replied(MissionStatus due) const {
    MissionReply reply;
    return peer.last(reply) && reply.mission == mission && reply.status == due && reply.to_operator == 0;
  }
  DriveMode mode() const {
    WheelCommand command;
    peer.last(command);
    return command.mode;
  }
  std::string start() {
    if (node.state() != NodeState::waiting) return "not waiting at first";
    peer.greet(boot, NodeState::ready);
    pass(2);
    if (node.state() != NodeState::ready) return "no handshake";
    bool rules = false;
    peer.each<Info>(
        [&](const Info& i) { rules = rules || (i.part == InfoPart::rules_hash && i.value == 0x1234); });
    if (!rules) return "it does not tell its rules";
    pass(50);
    if (steps != 0 || mode() != DriveMode::stop) return "it drives without a mission";
    if (std::abs(peer.count<WheelCommand>() - 5) > 1) return "stops of another period";
    const Mission m = draw_mission();
    const int before = orders;
    order(peer, Order::start, m);
    if (!replied(MissionStatus::accepted) || orders != before + 1 || ordered != Order::start)
      return "a start is not accepted once";
    if (!(got.start.at == m.start.at) || !(got.goal == m.goal)) return "another mission";
    order(peer, Order::start, m);
    if (!replied(MissionStatus::accepted) || orders != before + 1) return "a repeated order is another one";
    pass(60);
    if (node.state() != NodeState::running || steps < 4) return "it does not step";
    while (now % 10 != 1) pass();
    return wrong;
  }
};

std::string judge_steps(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start();
  if (!wrong.empty()) return wrong;
  for (int i = 0; i < 10; ++i) {
    for (hal::RangeReading& r : b.ranges) r.mm = static_cast<std::uint16_t>(dice.index(2000));
    b.counts = {static_cast<std::uint32_t>(dice.index(1 << 24)),
                static_cast<std::uint32_t>(dice.index(1 << 24))};
    b.speeds = {static_cast<std::int16_t>(dice.index(6000) - 3000),
                static_cast<std::int16_t>(dice.index(6000) - 3000)};
    const bool stands = dice.chance(0.2);
    if (stands) b.speeds = {};
    const int missing = dice.chance(0.3) ? dice.index(5) : -1;
    if (missing >= 0) b.sends[missing] = false;
    const int before = b.steps;
    const std::uint32_t skipped = b.node.health().skipped;
    b.peer.forget();
    b.pass(10);
    if (b.steps != before + (missing < 0 ? 1 : 0)) return "a set is not taken once";
    if (missing >= 0) {
      b.sends[missing] = true;
      b.pass(10);
      if (b.steps != before + 1 || b.node.health().skipped != skipped + 1)
        return "a missing set is not skipped";
    }
    WheelCommand command;
    NavStatus nav;
    const auto t = static_cast<std::uint16_t>(b.tick);
    if (!b.peer.last(command) || command.mode != DriveMode::drive || command.tick != t ||
        command.speeds.left != b.speeds.left || command.speeds.right != b.speeds.right)
      return "another answer";
    if (!b.peer.last(nav) || nav.tick != t || nav.danger != b.status.danger || nav.why != b.status.why)
      return "another status is sent";
    // An older set, and one of another mission.
    b.peer.say(Sync{b.sync, b.tick - 1, 10, b.mission});
    const std::uint32_t stale = b.node.health().stale;
    b.peer.say(Sync{b.sync, b.tick, 10, static_cast<std::uint8_t>(b.mission + 1)});
    const int steps = b.steps;
    b.pass();
    if (b.steps != steps || b.node.health().stale != stale + 1) return "a strange set counts";
    while (b.now % 10 != 1) b.pass();
  }
  return b.wrong;
}

/// A part of the measurements is missing.
std::string judge_silence(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start();
  if (!wrong.empty()) return wrong;
  const int what = dice.index(6);  // a beam, the counts, the sync, the heartbeat
  if (what < 5) b.sends[what] = false;
  if (what == 5) b.beats = false;
  const std::uint32_t beat = b.now - b.now % 100;
  b.peer.forget();
  bool held = false;
  const int ms = b.until([&] {
    held = held || (b.peer.count<WheelCommand>() > 0 && b.mode() == DriveMode::stop);
    return b.node.state() != NodeState::running;
  });
  const int due[] = {91, 91, 91, 41, 91};
  const std::uint16_t errors[] = {Error::range_late,    Error::range_late,    Error::range_late,
                                  Error::odometry_late, Error::odometry_late, Error::peer_lost};
  const int least = what == 5 ? static_cast<int>(beat + 300 - b.now) + ms - 2 : due[what] - 1;
  if (ms < least || ms > least + 13) return "it stops at another time";
  if ((b.node.errors() & errors[what]) == 0) return "another error";
  if (what < 3 && !held) return "it does not hold before it stops";
  if (what == 5) return "";
  b.sends[what] = true;
  b.pass(100);
  if (b.node.state() != NodeState::safe_stop) return "it goes on by itself";
  b.peer.forget();
  b.pass(30);
  if (b.mode() != DriveMode::stop || std::abs(b.peer.count<WheelCommand>() - 3) > 1)
    return "it does not brake on";
  ++b.mission;
  const bool resumes = dice.chance(0.5);
  b.order(b.peer, resumes ? Order::resume : Order::start, b.draw_mission());
  if (!b.replied(MissionStatus::accepted)) return "no order ends a stop";
  b.pass(30);
  if (b.node.state() != NodeState::running) return "it does not run again";
  // A short gap is only held.
  b.sends[0] = false;
  b.pass(40 + dice.index(25));
  b.sends[0] = true;
  b.pass(20);
  b.peer.forget();
  b.pass(20);
  return b.node.state() == NodeState::running && b.mode() == DriveMode::drive ? b.wrong
                                                                              : "a short gap ends it";
}

std::string judge_orders(Dice& dice) {
  Bench b(dice);
  b.peer.greet(b.boot, NodeState::ready);
  b.pass(2);
  const bool calibrates = dice.chance(0.5);
  if (calibrates) b.node.accept_calibrations();
  bool has_mission = false, stopped = false;
  for (int i = 0; i < 14; ++i) {
    ++b.mission;
    const int kind = dice.index(8);
    Mission m = b.draw_mission();
    if (kind == 0) {
      b.peer.say(MissionOrder{MissionPart::order, b.mission, Order::start, 0});
      b.pass(2);
      if (!b.replied(MissionStatus::incomplete)) return "half an order is complete";
      continue;
    }
    if (kind == 1) {
      b.peer.send({0x010, false, false, 1, {0}});
      b.pass(2);
      stopped = true;
      if (b.node.state() != NodeState::e_stopped) return "no emergency stop";
      continue;
    }
    if (kind == 2 && stopped) {
      b.peer.say(EStop{kClearCommand});
      b.pass(2);
      stopped = false;
      if (b.node.state() == NodeState::e_stopped) return "a clear does not clear";
      continue;
    }
    const auto what = static_cast<Order>(dice.index(kOrders));
    const bool beyond = dice.chance(0.2);
    if (beyond)
      (dice.chance(0.5) ? m.goal.at.x : m.start.at.y) =
          (kPlaceLimit + micrometres(1)) * (dice.chance(0.5) ? 1 : -1);
    const bool is_short = dice.chance(0.3);
    if (is_short && !beyond) m.goal.at = m.start.at + Vec{dice.chance(0.5) ? 499_mm : 500_mm, 0_mm};
    const bool too_short = is_short && !beyond && m.goal.at.x - m.start.at.x == 499_mm;
    b.order(b.peer, what, m);
    const bool calibration = can::calibrates(what);
    MissionStatus due = MissionStatus::accepted;
    if (beyond)
      due = MissionStatus::out_of_range;
    else if (what == Order::resume && !has_mission)
      due = MissionStatus::unknown;
    else if (calibration && !calibrates)
      due = MissionStatus::unsupported;
    else if (calibration && what != Order::spin && too_short)
      due = MissionStatus::out_of_range;
    else if (can::drives(what) && stopped)
      due = MissionStatus::refused;
    if (!b.replied(due)) return "another answer to an order";
    if (due != MissionStatus::accepted) continue;
    has_mission = can::drives(what);
    if ((b.node.state() == NodeState::running) != (has_mission && !stopped))
      return "another state after an order";
    if (b.ordered != what) return "another order is taken";
    b.pass(30);
    if (!b.wrong.empty()) return b.wrong;
  }
  ++b.boot;
  b.peer.greet(b.boot, NodeState::ready);
  b.pass(5);
  ++b.mission;
  b.order(b.peer, Order::resume, b.draw_mission());
  return b.replied(MissionStatus::unknown) ? "" : "a mission of another base goes on";
}

/// Every parameter reads back as written, and nothing else changes before a commit.
std::string judge_params(Dice& dice) {
  Bench b(dice);
  b.peer.greet(b.boot, NodeState::ready);
  b.pass(2);
  const bool by_hand = dice.chance(0.3);
  Voice& voice = by_hand ? b.hand : b.peer;
  const auto ask = [&](ParamAction action, std::size_t index, std::int64_t raw, ParamReply& reply) {
    b.peer.forget();
    voice.say(ParamRequest{action, static_cast<std::uint8_t>(index), static_cast<std::uint32_t>(raw)});
    b.pass(2);
    return b.peer.last(reply) && reply.index == index && (reply.to_operator != 0) == by_hand;
  };
  const std::vector<ParamEntry> usual = param_list(Params{});
  ParamReply reply;
  for (int i = 0; i < 12; ++i) {
    const auto k = static_cast<std::size_t>(dice.index(static_cast<int>(usual.size())));
    const ParamEntry now = param_list(b.node.params())[k];
    if (!ask(ParamAction::read, k, 0, reply) ||
        static_cast<std::int32_t>(reply.value) != static_cast<std::int32_t>(now.raw))
      return "a parameter reads otherwise";
    const int how = dice.index(3);
    const std::int64_t raw =
        how == 0   ? now.low - 1
        : how == 1 ? now.high + 1
                   : now.low + static_cast<std::int64_t>(dice.uniform(0, 1) *
                                                         static_cast<double>(now.high - now.low));
    if (raw != static_cast<std::int64_t>(static_cast<std::int32_t>(raw)) && now.low >= 0 && how == 0)
      continue;
    if (!ask(ParamAction::write, k, raw, reply)) return "a write is not answered";
    const bool in = how == 2;
    if (now.high < INT32_MAX && now.low > INT32_MIN && (reply.status == ParamStatus::ok) != in)
      return "another range of a parameter";
    if (param_list(b.node.params())[k].raw != now.raw) return "a write takes effect before its commit";
    if (reply.status != ParamStatus::ok) continue;
    Params wanted = b.node.params();
    set_param(wanted, k, raw);
    const bool fits = check(wanted) == ParamFault::none && outlasts_hold(wanted);
    if (!ask(ParamAction::commit, kCommitIndex, 0, reply)) return "a commit is not answered";
    if ((reply.status == ParamStatus::ok) != fits) return "another commit";
    if (param_list(b.node.params())[k].raw != (fits ? raw : now.raw))
      return "a commit that changes otherwise";
    if (!fits && !ask(ParamAction::write, k, now.raw, reply)) return "no way back";
  }
  if (!ask(ParamAction::read, usual.size(), 0, reply) || reply.status != ParamStatus::no_such)
    return "a parameter too many";
  b.order(b.peer, Order::start, b.draw_mission());
  if (!b.replied(MissionStatus::accepted)) return "no start after parameters";
  const auto first = static_cast<std::uint32_t>(usual[0].raw);
  if (!ask(ParamAction::write, 0, first, reply) || reply.status != ParamStatus::busy)
    return "a write while it drives";
  if (!ask(ParamAction::commit, kCommitIndex, 0, reply) || reply.status != ParamStatus::busy)
    return "a commit while it drives";
  return ask(ParamAction::read, 0, 0, reply) && reply.status == ParamStatus::ok ? ""
                                                                                : "no read while it drives";
}

std::string judge_reports(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start();
  if (!wrong.empty()) return wrong;
  RangeTrustReport trust{RangeLevel::trusted, 77, 1, 2, 3};
  b.node.publish_trust(trust, true);  // the first level is known
  for (int i = 0; i < 120; ++i) {
    b.pass(10);
    const bool ends = dice.chance(0.05), changes = dice.chance(0.05), sigma_ends = dice.chance(0.05);
    if (changes) trust.level = static_cast<RangeLevel>((static_cast<int>(trust.level) + 1) % 3);
    b.peer.forget();
    b.node.publish_trust(trust, ends);
    b.node.publish_sigma({1, 2, 3, 4}, sigma_ends);
    b.pass();
    while (b.now % 10 != 1) b.pass();
    const bool due = ends || changes || (b.tick - 1) % 50 == 0;
    static_cast<void>(due);
    const bool periodic = b.tick % 50 == 0 || (b.tick - 1) % 50 == 0;
    if (periodic) continue;
    if ((b.peer.count<RangeTrustReport>() > 0) != (ends || changes)) return "trust at another time";
    if ((b.peer.count<PoseSigmaReport>() > 0) != sigma_ends) return "sigma at another time";
  }
  while (b.tick % 50 != 0) {
    b.pass();
  }
  b.peer.forget();
  b.node.publish_trust(trust, false);
  b.node.publish_sigma({1, 2, 3, 4}, false);
  b.pass();
  PoseSigmaReport sigma;
  RangeTrustReport told;
  if (!b.peer.last(told) || told.contradictions != 77 || told.level != trust.level)
    return "no periodic trust";
  if (!b.peer.last(sigma) || sigma.heading != 4) return "no periodic sigma";
  CalibrationReport report{};
  b.peer.forget();
  b.node.publish_calibration(report);
  b.pass();
  CalibrationReport heard{};
  return b.peer.last(heard) && heard.mission == b.mission ? "" : "a calibration of another mission";
}

/// In lockstep the same set gets the same answer, and the next one a step, whatever the time.
std::string judge_lockstep(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start();
  if (!wrong.empty()) return wrong;
  b.sync = SyncMode::lockstep;
  for (int i = 0; i < 6; ++i) {
    b.speeds = {static_cast<std::int16_t>(dice.index(2000)), 5};
    const int before = b.steps;
    b.send_set(++b.tick);
    b.pass(2);
    if (b.steps != before + 1) return "no step in lockstep";
    b.pass(dice.index(200));
    b.peer.forget();
    b.send_set(b.tick);
    b.pass(2);
    WheelCommand again;
    NavStatus nav;
    if (b.steps != before + 1) return "a second step on one set";
    if (!b.peer.last(again) || again.speeds.left != b.speeds.left || again.mode != DriveMode::drive)
      return "another answer to the same set";
    if (!b.peer.last(nav) || nav.tick != static_cast<std::uint16_t>(b.tick)) return "no status again";
    b.send_set(b.tick + 2);
    b.pass(2);
    if (b.steps != before + 1) return "a step too far";
  }
  b.beats = false;
  b.pass(600);
  return b.node.state() == NodeState::safe_stop || !b.node.lockstep() ? "it does not wait in lockstep" : "";
}

/// An operator may give orders where the program says so, while the base's own mission stands.
std::string judge_operator(Dice& dice) {
  Bench b(dice);
  const bool takes = dice.chance(0.7);
  if (takes) b.node.accept_operator_orders();
  std::string wrong = b.start();
  if (!wrong.empty()) return wrong;
  const auto order = [&](Order what, const Mission& m) {
    b.peer.forget();
    const MissionValues values = values_of(m);
    for (int i = 0; i < kMissionValues; ++i)
      b.hand.say(MissionValue{static_cast<MissionPart>(i + 1), 99, values.of[i]});
    b.hand.say(MissionOrder{MissionPart::order, 99, what, digest_of(values)});
    b.pass(2);
    MissionReply reply;
    return b.peer.last(reply) && reply.mission == 99 && reply.to_operator == 1
               ? static_cast<int>(reply.status)
               : -1;
  };
  const int busy = order(Order::start, b.draw_mission());
  const MissionStatus due = !takes ? MissionStatus::unsupported : MissionStatus::refused;
  if (busy != static_cast<int>(due)) return "an operator interrupts a drive";
  if (!takes) return "";
  b.speeds = {};
  b.status.outcome = planning::Outcome::none;
  b.pass(1500);
  const Mission m = b.draw_mission();
  if (order(Order::start, m) != static_cast<int>(MissionStatus::accepted))
    return "an operator's order is refused";
  Order what = Order::cancel;
  planning::Goal goal{};
  if (!b.node.take_operator_order(what, goal) || what != Order::start || !(goal == m.goal))
    return "another order of the operator";
  if (b.node.take_operator_order(what, goal)) return "an operator's order comes twice";
  return b.orders == 1 ? "" : "an operator's order is one of the base";
}

}  // namespace

std::string judge_controller(Dice& dice) {
  for (const JudgePart judge : {judge_steps, judge_silence, judge_silence, judge_orders, judge_params,
                                judge_reports, judge_lockstep, judge_operator}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
