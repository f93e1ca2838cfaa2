/// The guard on a body that does what the parameters say.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "firmware/guard.hpp"
#include "host/lab/hunt/parts/body.hpp"

namespace whisker::hunt {

/// The guard on a body, and what holds of both at every tick.
struct GuardBench {
  Params p;
  Body body;
  Guard guard;
  std::uint32_t now, commanded = 0;
  bool any_command = false;
  std::string wrong;
  hal::WheelSpeeds last{};
  double reached[2] = {0, 0};

  GuardBench(Dice& dice, const Params& params, Clutter world)
      : p(params), body(p, std::move(world), {{0, 0}, dice.uniform(-3, 3)}), guard(body, body, p) {
    now = dice.chance(0.3) ? 0xFFFFF800U : static_cast<std::uint32_t>(dice.index(100000));
  }
  GuardBench(const GuardBench&) = delete;
  GuardBench& operator=(const GuardBench&) = delete;

  Time time() const { return Time::from_raw(now); }
  void ask(double forward, double turning) {
    guard.command({Speed::from_raw(static_cast<std::int32_t>(forward * 1e6)),
                   AngularRate::from_raw(static_cast<std::int32_t>(turning * 1e6))},
                  time());
  }
  const GuardStatus& tick(int gap_ms = 10) {
    body.pass(gap_ms);
    now += static_cast<std::uint32_t>(gap_ms);
    const GuardStatus& s = guard.tick(time());
    judge(s, gap_ms);
    return s;
  }
  /// What holds at every tick, whatever happens.
  void judge(const GuardStatus& s, int gap_ms) {
    const double top = p.wheels.max_speed.raw() * 1e-2,
                 step =
                     p.wheels.max_acceleration.raw() * 1e-5 * std::max(gap_ms, p.safety.period.raw()) + 1.01;
    if (std::max(std::abs(s.command.left), std::abs(s.command.right)) > top + 0.51)
      wrong = "faster than the wheels may turn";
    const auto far = [&](double left, double right, double most) {
      return std::fabs(s.command.left - left) > most || std::fabs(s.command.right - right) > most;
    };
    const double off[] = {last.left - reached[0], last.right - reached[1]};
    const double share =
        std::min(1.0, (step - 1.01) / std::max({1e-9, std::fabs(off[0]), std::fabs(off[1])}));
    for (int i = 0; i < 2; ++i) reached[i] += off[i] * share;
    const bool refused = body.refuses_commands;
    if (!refused && far(last.left, last.right, step) && far(reached[0], reached[1], step + 10))
      wrong = "a step of the wheels beyond their acceleration";
    if (refused) reached[0] = reached[1] = 0;
    last = s.command;
    const bool faulted = s.health.fault != Fault::none;
    if (faulted != (s.reason == GuardReason::fault)) wrong = "a fault without its reason";
    const bool silent =
        !any_command || now - commanded > static_cast<std::uint32_t>(p.guard.command_timeout.raw());
    if (silent && (s.asked.forward != Speed{} || s.asked.turning != AngularRate{}))
      wrong = "an old command is asked";
    if (!faulted && silent && s.reason != GuardReason::command_timeout &&
        s.reason != GuardReason::stale_ranges)
      wrong = "a time-out without its reason";
    if (s.forward < Q14{} || s.forward > Q14::ratio(1, 1) || s.turning > Q14::ratio(1, 1))
      wrong = "a share that is none";
    const bool full = s.forward >= Q14::ratio(999, 1000) && s.turning >= Q14::ratio(999, 1000);
    if (guard.local_grid().doubting()) wrong = "a world at rest moves";
    if (s.health.ranges.level != RangeLevel::trusted) wrong = "true readings are not trusted";
    if (s.reason == GuardReason::clear && !full) wrong = "clear and not granted in full";
    const sim::Pose& truth = body.pose();
    static_cast<void>(truth);
  }
  /// Asks anew each tick.
  const GuardStatus& drive(double forward, double turning, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      ask(forward, turning);
      commanded = now;
      any_command = true;
      tick();
    }
    return guard.status();
  }
  double fastest_turn() const {
    return std::min(turn_rate(p).raw() * 1e-6, speed() / (metres(p.body.track) / 2));
  }
  /// A whole turn and a part of one.
  void survey() {
    const double rate = 0.9 * fastest_turn();
    drive(0, rate, static_cast<int>(100 * 2 * sim::kPi * 1.3 / rate));
  }
  double speed() const { return p.wheels.max_speed.raw() * 1e-6; }
  double rim_share() const {
    const double forward = (guard.status().command.left + guard.status().command.right) / 2e4;
    return forward / speed();
  }
};

/// With cones that overlap, if it is to see all around.
inline Params draw_guarded(Dice& dice, bool overlaps = true) {
  while (true) {
    Params p;
    // They overlap.
    if (overlaps) {
      p.rangefinders.cone = 60_deg;
      p.rangefinders.side_angle = 55_deg;
    }
    p.guard.assist = dice.chance(0.5) ? Fitted::yes : Fitted::no;
    p.guard.nods = dice.chance(0.7) ? Fitted::yes : Fitted::no;
    p.guard.command_timeout = milliseconds(100 + dice.index(400));
    if (dice.chance(0.5)) {
      p.wheels.max_speed = Speed::from_raw(1000 * (150 + dice.index(200)));
      p.wheels.max_acceleration = Acceleration::from_raw(1000 * (700 + dice.index(1300)));
      p.wheels.motor_lag = milliseconds(10 + dice.index(50));
      p.rangefinders.latency = milliseconds(dice.index(60));
      p.rangefinders.rate_hz = 20 + dice.index(40);
    }
    if (check(p) == ParamFault::none) return p;
  }
}

}  // namespace whisker::hunt
