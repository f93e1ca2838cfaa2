// When the node that decides steps, holds and stops, and what it answers.
#include "host/lab/hunt/parts/controller_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

std::string judge_steps(Dice& dice) {
  ControllerBench b(dice);
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
  ControllerBench b(dice);
  std::string wrong = b.start();
  if (!wrong.empty()) return wrong;
  const int what = dice.index(6);  // a beam, the counts, the sync, the heartbeat
  if (what < 5) b.sends[what] = false;
  if (what == 5) b.beats = false;
  const std::uint32_t beat = b.now - b.now % 100;
  b.peer.forget();
  bool held = false;
  const int ms = b.until([&] {
    held = held || (b.peer.heard<WheelCommand>() > 0 && b.mode() == DriveMode::stop);
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
  if (b.mode() != DriveMode::stop || std::abs(b.peer.heard<WheelCommand>() - 3) > 1)
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

/// In lockstep the same set gets the same answer, and the next one a step, whatever the time.
std::string judge_lockstep(Dice& dice) {
  ControllerBench b(dice);
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

std::string judge_reports(Dice& dice) {
  ControllerBench b(dice);
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
    if ((b.peer.heard<RangeTrustReport>() > 0) != (ends || changes)) return "trust at another time";
    if ((b.peer.heard<PoseSigmaReport>() > 0) != sigma_ends) return "sigma at another time";
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

}  // namespace

std::string judge_controller(Dice& dice) {
  for (const JudgePart judge : {judge_steps, judge_silence, judge_silence, judge_reports, judge_lockstep}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
