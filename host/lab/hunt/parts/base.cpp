// The node with the wheels, beside a controller that this judge plays.
#include "firmware/can/base_node.hpp"

#include <algorithm>
#include <cstdlib>

#include "firmware/can/limits.hpp"
#include "host/lab/hunt/parts/parts.hpp"
#include "host/lab/hunt/parts/voice.hpp"

namespace whisker::hunt {
namespace {

using namespace can;

constexpr std::uint16_t kBoot = 500;
constexpr std::int16_t kRamp = 100;

struct Bench {
  bus::MemoryBus wire;
  BaseNode base{wire.attach(), {1, kBoot, 0x000100}, kRamp};
  Voice peer{wire, 1};
  Voice stranger{wire, 3};
  std::uint32_t began, now, tick = 0;
  std::uint16_t peer_boot = 600;
  bool beats = true, answers = true;
  NodeState peer_state = NodeState::running;
  hal::WheelSpeeds asked{2000, 1500}, speeds{};
  InputSet set;

  explicit Bench(Dice& dice)
      : began(dice.chance(0.3) ? 0xFFFFF000U : static_cast<std::uint32_t>(dice.index(100000))) {
    now = began;
    peer.poll(now);
    base.poll(now);
  }
  void pass() {
    ++now;
    peer.poll(now);
    if (beats && now % 100 == 0) {
      Heartbeat beat;
      beat.boot = peer_boot;
      beat.state = peer_state;
      peer.say(beat);
    }
    base.poll(now);
    if (now % 10 != 0) return;
    speeds = base.control();
    set.tick = ++tick;
    base.send_set(set, SyncMode::real_time);
    if (answers) peer.say(WheelCommand{DriveMode::drive, asked, static_cast<std::uint16_t>(tick)});
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
  std::string start(Dice& dice) {
    if (base.state() != NodeState::waiting) return "not waiting at first";
    pass(dice.index(50));
    if (base.state() != NodeState::waiting || speeds.left != 0) return "it does not wait for a controller";
    peer.greet(peer_boot, NodeState::ready);
    pass(2);
    if (base.state() != NodeState::ready || !base.matched()) return "no handshake";
    return order(dice);
  }
  std::string order(Dice& dice) {
    const auto length = [&] { return micrometres(dice.index(2000000) - 1000000); };
    const Mission mission{{{length(), length()}, Angle::turns(dice.index(360), 360)},
                          {{length(), length()}, millimetres(1 + dice.index(200))}};
    peer.forget();
    base.give(Order::start, mission, SyncMode::real_time);
    const int silent_ms = 2 + dice.index(300);
    pass(silent_ms);
    MissionOrder said;
    if (!peer.last(said) || said.order != Order::start || base.order_state() != OrderState::waiting)
      return "no order";
    const MissionValues values = values_of(mission);
    if (said.digest != digest_of(values)) return "another digest of the order";
    int parts = 0;
    bool right = true;
    peer.each<MissionValue>([&](const MissionValue& m) {
      if (m.part == MissionPart::order) return;
      ++parts;
      right = right && m.mission == said.mission && m.value == values.of[static_cast<int>(m.part) - 1];
    });
    if (!right) return "other parts of the order";
    const int repeats = 1 + (silent_ms - 2) / static_cast<int>(kOrderRepeat_ms);
    if (std::abs(parts / kMissionValues - repeats) > 1) return "an order is not repeated in its time";
    // Of another order, to the operator, or incomplete: it waits on.
    peer.say(MissionReply{MissionStatus::accepted, static_cast<std::uint8_t>(said.mission + 1)});
    peer.say(MissionReply{MissionStatus::accepted, said.mission, 1});
    pass(2);
    if (base.order_state() != OrderState::waiting || base.state() == NodeState::running)
      return "a strange answer counts";
    if (dice.chance(0.3)) {
      const int before = peer.count<MissionOrder>();
      peer.say(MissionReply{MissionStatus::incomplete, said.mission});
      pass(3);
      if (peer.count<MissionOrder>() == before) return "an incomplete order is not repeated at once";
    }
    peer.say(MissionReply{MissionStatus::accepted, said.mission});
    pass(2);
    if (base.order_state() != OrderState::accepted || base.order_status() != MissionStatus::accepted)
      return "not accepted";
    const int orders = peer.count<MissionOrder>();
    pass(60);
    if (peer.count<MissionOrder>() != orders) return "an accepted order is repeated";
    if (base.state() != NodeState::running) return "it does not run";
    return speeds.left == asked.left && speeds.right == asked.right ? "" : "another speed than commanded";
  }
  /// Scaled down together, the faster wheel by the ramp a period.
  std::string brakes() {
    while (now % 10 != 9) pass();
    for (int i = 0; i < 40; ++i) {
      const hal::WheelSpeeds before = speeds;
      pass(10);
      const int fastest = std::max(std::abs(before.left), std::abs(before.right));
      const double share = fastest > kRamp ? static_cast<double>(fastest - kRamp) / fastest : 0;
      if (std::abs(speeds.left - before.left * share) > 1.01 ||
          std::abs(speeds.right - before.right * share) > 1.01) {
        return "it brakes otherwise";
      }
    }
    return speeds.left == 0 && speeds.right == 0 ? "" : "it does not stand";
  }
};

std::string judge_stop(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start(dice);
  if (!wrong.empty()) return wrong;
  const int cause = dice.index(6);
  if (dice.chance(0.3)) b.asked = {-1800, 900};
  b.pass(20 + dice.index(200));
  while (b.now % 10 != 1) b.pass();
  b.peer.forget();
  int least = 0, most = 3;
  std::uint16_t error = 0;
  NodeState due = NodeState::safe_stop;
  const std::uint32_t said = b.now - b.now % 100;
  switch (cause) {
    case 0:
      b.answers = false;
      error = Error::command_late;
      least = 46;
      most = 51;
      break;
    case 1:
      b.beats = false;
      error = Error::peer_lost;
      least = static_cast<int>(said + kPeerLost_ms - b.now) - 2;
      most = least + 4;
      break;
    case 2:
      b.peer_state = dice.chance(0.5) ? NodeState::safe_stop : NodeState::e_stopped;
      error = Error::peer_stopped;
      most = 101;
      break;
    case 3:
      ++b.peer_boot;
      error = Error::peer_restarted;
      most = 101;
      break;
    case 4:
      b.peer.send({0x010, false, false, 1, {0}});
      error = Error::e_stop;
      due = NodeState::e_stopped;
      break;
    default: {
      Voice twin(b.wire, 9);
      twin.send(twin.frame(Sync{}));
      error = Error::duplicate_node;
      most = 4;
      const int ms = b.until([&] { return b.base.state() != NodeState::running; });
      if (ms > most || (b.base.permanent_errors() & error) == 0) return "a twin does not stop it";
      b.base.give(Order::start, {}, SyncMode::real_time);
      b.pass(5);
      if (b.base.order_state() != OrderState::refused) return "an order beside a twin waits";
      return b.brakes();
    }
  }
  const std::uint32_t stops = b.base.health().stops;
  const int ms = b.until([&] { return b.base.state() != NodeState::running; });
  if (ms < least || ms > most) return "it stops at another time";
  if (cause == 3) b.peer.greet(b.peer_boot, NodeState::ready);
  if (b.base.health().stops != stops + 1) return "a stop is not counted once";
  if (b.base.state() != due && cause != 1) return "another state after a stop";
  if (cause == 0) {
    b.pass(2);
    Heartbeat beat;
    FaultReport fault;
    if (!b.peer.last(beat) || beat.state != due || beat.errors != error || beat.boot != kBoot)
      return "no heartbeat of the stop";
    if (!b.peer.last(fault) || fault.errors != error || fault.severity != Severity::latched ||
        fault.stops != stops + 1)
      return "no report of the stop";
  }
  if ((b.base.errors() & error) == 0) return "another error";
  wrong = b.brakes();
  if (!wrong.empty()) return wrong;
  if (due == NodeState::e_stopped) {
    b.peer.say(EStop{kClearCommand});
    b.pass(3);
    if (b.base.state() == NodeState::e_stopped) return "a clear does not clear";
  }
  if (cause == 1 || cause == 2) b.peer_state = NodeState::ready;
  b.beats = b.answers = true;
  b.pass(250);
  if (b.base.state() == NodeState::running || b.speeds.left != 0) return "it runs on by itself";
  return b.order(dice);
}

std::string judge_periods(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start(dice);
  if (!wrong.empty()) return wrong;
  const std::uint16_t standing = dice.chance(0.5) ? Error::drive_refused : 0;
  b.base.report(standing, 3);
  b.pass(10);
  b.peer.forget();
  b.pass(3000);
  if (std::abs(b.peer.count<Heartbeat>() - 30) > 1) return "heartbeats of another period";
  if (std::abs(b.peer.count<FaultReport>() - (standing != 0 ? 3 : 0)) > 1)
    return "reports of faults of another period";
  if (std::abs(b.peer.count<Diagnostics>() - 6) > 1) return "diagnostics of another period";
  int part = -1;
  bool in_turn = true;
  b.peer.each<Diagnostics>([&](const Diagnostics& d) {
    in_turn = in_turn && (part < 0 || d.part == (part + 1) % 4);
    part = d.part;
  });
  if (!in_turn) return "diagnostics out of turn";
  Heartbeat beat;
  b.peer.last(beat);
  const int seconds = static_cast<int>((b.now - b.began) / 1000);
  if (std::abs(beat.uptime_s - seconds) > 1 || beat.state != NodeState::running || beat.errors != standing)
    return "another heartbeat";
  FaultReport fault;
  if (standing != 0 && b.peer.last(fault) && (fault.core_fault != 3 || fault.severity != Severity::stopped))
    return "another report of a fault";
  b.peer.forget();
  b.peer.say(InfoRequest{});
  b.pass(3);
  bool table = false, version = false;
  b.peer.each<Info>([&](const Info& i) {
    table = table || (i.part == InfoPart::table_hash && i.value == kTableHash && i.boot == kBoot);
    version = version || (i.part == InfoPart::version && i.value == 0x000100);
  });
  return table && version ? "" : "no information on request";
}

/// Each frame that is not to be obeyed is counted once, and told.
std::string judge_counters(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start(dice);
  if (!wrong.empty()) return wrong;
  b.pass(20);
  const BusHealth before = b.base.health();
  int n[6] = {};
  for (int i = 0; i < 12; ++i) {
    const int kind = dice.index(6);
    ++n[kind];
    hal::CanFrame f = b.peer.frame(NavStatus{});
    if (kind == 0) f.data[0] ^= static_cast<std::uint8_t>(1 + dice.index(255));
    if (kind == 1) f.size = static_cast<std::uint8_t>(f.size - 1);
    if (kind == 2) {
      b.peer.send(f);  // twice
      b.pass();
    }
    if (kind == 3) f = b.peer.frame(MissionReply{static_cast<MissionStatus>(7), 0});
    if (kind == 4) f = b.stranger.frame(NavStatus{});
    if (kind == 5) f = b.peer.frame(Sync{});  // a base's
    b.peer.send(f);
    b.pass(2);
  }
  const BusHealth& now = b.base.health();
  const bool same = now.crc - before.crc == static_cast<std::uint32_t>(n[0]) &&
                    now.malformed - before.malformed == static_cast<std::uint32_t>(n[1] + n[5]) &&
                    now.repeated - before.repeated == static_cast<std::uint32_t>(n[2]) &&
                    now.out_of_range - before.out_of_range == static_cast<std::uint32_t>(n[3]) &&
                    now.foreign - before.foreign >= static_cast<std::uint32_t>(n[4]);
  if (!same) return "other counters of frames";
  b.peer.forget();
  b.pass(2100);
  bool told = false, other = false;
  b.peer.each<Diagnostics>([&](const Diagnostics& d) {
    const std::uint32_t values[4][3] = {{now.crc, now.lost, now.repeated},
                                        {now.malformed, now.out_of_range, now.out_of_sequence},
                                        {0, 0, 0},
                                        {0, now.skipped, now.stops}};
    told = told || d.part == 0;
    for (int i = 0; i < 3; ++i) other = other || d.value[i] != values[d.part][i];
  });
  return told && !other ? "" : "diagnostics tell other counters";
}

/// What the controller reports is handed on, and forgotten with the controller.
std::string judge_reports(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start(dice);
  if (!wrong.empty()) return wrong;
  const auto word = [&] { return static_cast<std::uint16_t>(dice.index(16000)); };
  const RangeTrustReport trust{RangeLevel::doubtful, word(), 5, 6, static_cast<std::uint8_t>(dice.index(91))};
  const PoseSigmaReport sigma{1, word(), word(), word()};
  const FixReply fix{FixStatus::accepted, word(), word(), word()};
  const ParamReply param{ParamStatus::ok, static_cast<std::uint8_t>(dice.index(200)),
                         static_cast<std::uint32_t>(dice.bits())};
  const RulesReply rules{};
  NavStatus nav;
  nav.danger = 9;
  nav.fault = 2;
  RangeTrustReport t;
  PoseSigmaReport s;
  FixReply f;
  ParamReply p;
  RulesReply r;
  if (b.base.reported(t) || b.base.reported(s) || b.base.replied(f) || b.base.replied(p) || b.base.take(r))
    return "a report from nowhere";
  b.peer.say(ParamReply{ParamStatus::ok, 1, 2, 1});
  b.pass(2);
  if (b.base.replied(p)) return "an answer to the operator counts";
  const std::uint32_t at = b.tick;
  nav.tick = static_cast<std::uint16_t>(at);
  b.answers = false;
  b.peer.say(WheelCommand{DriveMode::drive, {100, 200}, static_cast<std::uint16_t>(at)});
  b.pass();
  if (b.base.answered(at)) return "half an answer";
  b.peer.say(trust);
  b.peer.say(sigma);
  b.peer.say(fix);
  b.peer.say(param);
  b.peer.say(rules);
  b.peer.say(nav);
  b.pass(2);
  b.answers = true;
  if (!b.base.reported(t) || t.contradictions != trust.contradictions || t.level != trust.level ||
      t.incidence != trust.incidence)
    return "another trust";
  if (!b.base.reported(s) || s.along != sigma.along || s.across != sigma.across || s.heading != sigma.heading)
    return "another sigma";
  if (!b.base.replied(f) || f.tick != fix.tick || f.jumps != fix.jumps || f.refused != fix.refused)
    return "another answer to a fix";
  if (!b.base.replied(p) || p.index != param.index || p.value != param.value)
    return "another answer to a parameter";
  if (!b.base.take(r) || b.base.take(r)) return "an answer to rules is not taken once";
  if (b.base.status().danger != 9 || b.base.status().fault != 2 || b.base.status().tick != nav.tick)
    return "another status";
  if (!b.base.answered(at) || b.base.answered(at + 1)) return "another tick is answered";
  if (b.base.command().speeds.left != 100 || b.base.command().speeds.right != 200) return "another command";
  b.base.request(ParamRequest{ParamAction::read, 3, 0});
  if (b.base.replied(p)) return "an answer before its request";
  // Too old.
  const std::uint32_t stale = b.base.health().stale;
  b.peer.say(WheelCommand{DriveMode::drive, {77, 77}, static_cast<std::uint16_t>(b.tick - 7)});
  b.pass();
  if (b.base.command().speeds.left == 77 || b.base.health().stale != stale + 1)
    return "an old command counts";
  ++b.peer_boot;
  b.peer.greet(b.peer_boot, NodeState::ready);
  b.pass(2);
  if (b.base.reported(t) || b.base.reported(s) || b.base.replied(f) || b.base.replied(p) ||
      b.base.answered(at))
    return "reports of an earlier life";
  return "";
}

std::string judge_sets(Dice& dice) {
  Bench b(dice);
  std::string wrong = b.start(dice);
  if (!wrong.empty()) return wrong;
  for (int i = 0; i < 10; ++i) {
    InputSet& set = b.set;
    for (hal::RangeReading& r : set.ranges.beam) {
      r = {static_cast<std::uint16_t>(dice.index(65536)), static_cast<hal::RangeStatus>(dice.index(5)),
           static_cast<std::uint8_t>(dice.index(256)), static_cast<std::uint8_t>(dice.index(256))};
    }
    set.counts = {static_cast<std::uint32_t>(dice.index(1 << 24)),
                  static_cast<std::uint32_t>(dice.index(1 << 24))};
    set.counts_valid = dice.chance(0.5);
    for (BumpState& s : set.bumps) s = static_cast<BumpState>(dice.index(4));
    set.has_gyro = dice.chance(0.5);
    set.gyro_valid = dice.chance(0.5);
    set.gyro.sum = static_cast<std::uint32_t>(dice.index(1 << 24));
    set.gyro.samples = static_cast<std::uint16_t>(dice.index(65536));
    set.has_fix = dice.chance(0.5);
    set.fix.pose.at = {millimetres(dice.index(100000)), millimetres(dice.index(1000))};
    while (b.now % 10 != 9) b.pass();
    b.peer.forget();
    b.pass(2);
    Sync sync;
    WheelState wheels;
    GyroState gyro;
    Range<MessageKind::range_left> left;
    Range<MessageKind::range_front> front;
    Range<MessageKind::range_right> right;
    if (!b.peer.last(sync) || sync.tick != b.tick || sync.period_ms != 10 ||
        (sync.gyro != 0) != set.has_gyro || (sync.fix != 0) != set.has_fix)
      return "another sync";
    if (!b.peer.last(wheels) || wheels.counts.left != set.counts.left ||
        wheels.counts.right != set.counts.right || (wheels.valid != 0) != set.counts_valid ||
        wheels.tick != b.tick % 8)
      return "other counts are sent";
    if (!b.peer.last(left) || !b.peer.last(front) || !b.peer.last(right)) return "no ranges";
    const hal::RangeReading* const sent[] = {&left.reading, &front.reading, &right.reading};
    const std::uint16_t ticks[] = {left.tick, front.tick, right.tick};
    const BumpState bumps[] = {left.bump, front.bump, right.bump};
    for (int k = 0; k < 3; ++k) {
      const hal::RangeReading& r = set.ranges.beam[k];
      const bool ok = r.status == hal::RangeStatus::ok && r.mm < 65534;
      if (ok && (sent[k]->mm != r.mm || sent[k]->status != r.status)) return "another distance is sent";
      if (!ok && sent[k]->mm < 65534) return "a distance that there is not is sent";
      if (sent[k]->age_ms != r.age_ms || sent[k]->sequence != r.sequence % 16) return "another age is sent";
      if (ticks[k] != static_cast<std::uint16_t>(b.tick) || bumps[k] != set.bumps[k])
        return "another bump is sent";
    }
    const bool any = b.peer.last(gyro);
    if (any != set.has_gyro) return "a gyro or none";
    if (any && (gyro.reading.sum != set.gyro.sum || gyro.reading.samples != set.gyro.samples ||
                (gyro.valid != 0) != set.gyro_valid || gyro.tick != b.tick % 8))
      return "another gyro is sent";
    int parts = 0;
    bool fits = true;
    b.peer.each<FixValue>([&](const FixValue& v) {
      ++parts;
      if (v.part == FixPart::x) fits = fits && v.value == static_cast<std::uint32_t>(set.fix.pose.at.x.raw());
      fits = fits && v.tick == static_cast<std::uint16_t>(b.tick);
    });
    if (parts != (set.has_fix ? kFixValues : 0) || !fits) return "another fix is sent";
  }
  return "";
}

}  // namespace

std::string judge_base(Dice& dice) {
  for (const JudgePart judge :
       {judge_stop, judge_stop, judge_periods, judge_counters, judge_reports, judge_sets}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
