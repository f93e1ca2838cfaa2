// When the node with the wheels drives and when it stops, and what it says of itself.
#include "host/lab/hunt/parts/base_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

std::string judge_stop(Dice& dice) {
  BaseBench b(dice);
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
      bus::ScriptedNode twin(b.wire, 9);
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
  const std::uint32_t stops = b.base.health().stops, e_stops = b.base.health().e_stops;
  const int ms = b.until([&] { return b.base.state() != NodeState::running; });
  if (ms < least || ms > most) return "it stops at another time";
  if (cause == 3) b.peer.greet(b.peer_boot, NodeState::ready);
  if (b.base.health().stops != stops + 1) return "a stop is not counted once";
  if (b.base.health().e_stops != e_stops + (cause == 4 ? 1 : 0))
    return "an emergency stop is not counted once";
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
  BaseBench b(dice);
  std::string wrong = b.start(dice);
  if (!wrong.empty()) return wrong;
  const std::uint16_t standing = dice.chance(0.5) ? Error::drive_refused : 0;
  b.base.report(standing, 3);
  b.pass(10);
  b.peer.forget();
  b.pass(3000);
  if (std::abs(b.peer.heard<Heartbeat>() - 30) > 1) return "heartbeats of another period";
  if (std::abs(b.peer.heard<FaultReport>() - (standing != 0 ? 3 : 0)) > 1)
    return "reports of faults of another period";
  if (std::abs(b.peer.heard<Diagnostics>() - 6) > 1) return "diagnostics of another period";
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
  BaseBench b(dice);
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

}  // namespace

std::string judge_base(Dice& dice) {
  for (const JudgePart judge : {judge_stop, judge_stop, judge_periods, judge_counters}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
