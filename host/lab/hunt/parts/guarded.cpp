// The guard on a body that does what it says, in open ground and before a wall, and with one thing broken.
#include "firmware/guard.hpp"
#include "firmware/safety/warning.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/body.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

struct Bench {
  Params p;
  Body body;
  Guard guard;
  std::uint32_t now, commanded = 0;
  bool any_command = false;
  std::string wrong;
  hal::WheelSpeeds last{};
  double reached[2] = {0, 0};

  Bench(Dice& dice, const Params& params, Clutter world)
      : p(params), body(p, std::move(world), {{0, 0}, dice.uniform(-3, 3)}), guard(body, body, p) {
    now = dice.chance(0.3) ? 0xFFFFF800U : static_cast<std::uint32_t>(dice.index(100000));
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

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

Params draw_params(Dice& dice, bool overlaps = true) {
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

/// In open ground a command is granted once the ground was seen, up to what the wheels can do.
std::string judge_open(Dice& dice) {
  Bench b(dice, draw_params(dice), {});
  b.survey();
  if (b.guard.status().reason != GuardReason::clear) return "a turn on the spot is not granted";
  const double v = b.speed() * dice.uniform(0.3, 1), w = dice.chance(0.4) ? 0 : dice.uniform(-0.4, 0.4);
  const double straight = std::min(v, b.speed() - std::fabs(w) * metres(b.p.body.track) / 2);
  b.drive(straight, w, 100);
  const sim::Pose before = b.body.pose();
  b.drive(straight, w, 100);
  const GuardStatus& s = b.guard.status();
  if (s.reason != GuardReason::clear && s.reason != GuardReason::nodding) return "open ground is not granted";
  const double rim = w * metres(b.p.body.track) / 2;
  if (s.reason == GuardReason::clear && (std::fabs(s.command.left * 1e-4 - straight + rim) > 2e-3 ||
                                         std::fabs(s.command.right * 1e-4 - straight - rim) > 2e-3))
    return "another speed than asked";
  const double turned = b.body.pose().heading - before.heading;
  if (b.p.guard.nods == Fitted::no && std::fabs(turned - w) > 0.02 + 0.02 * std::fabs(w))
    return "the asked turning is not followed";
  if (length_of(b.body.pose().at - before.at) < straight * 0.6) return "slowed without cause";
  // Odometry, against the truth: within the counts.
  const Pose& pose = b.guard.status().pose;
  const double counts = 4.0 / b.p.wheels.counts_per_metre;
  const double heading = before.heading;
  static_cast<void>(heading);
  if (std::hypot(metres(pose.at.x), metres(pose.at.y)) > length_of(b.body.pose().at) + 0.05 + counts)
    return "the estimate runs away";
  return b.wrong;
}

/// More than the wheels can do is scaled, and said.
std::string judge_limits(Dice& dice) {
  Params p = draw_params(dice);
  p.guard.nods = p.guard.assist = Fitted::no;
  Bench b(dice, p, {});
  b.survey();
  const double track = metres(p.body.track), fastest = turn_rate(p).raw() * 1e-6;
  const double much = fastest * dice.uniform(1.2, 50) * (dice.chance(0.5) ? 1 : -1);
  b.drive(0, much, 120);
  const double rim = (b.last.right - b.last.left) / 2e4, most = std::min(fastest * track / 2, b.speed());
  if (std::fabs(std::fabs(rim) - most) > 2e-3 || rim * much < 0) return "another fastest turn";
  if (b.guard.status().reason != GuardReason::limits) return "a limit is not said";
  if (std::fabs(b.guard.status().turning.raw() / 16384.0 - most / (std::fabs(much) * track / 2)) > 0.01)
    return "another share of turning";
  const double v = b.speed() * dice.uniform(1.2, 5);
  b.drive(v, 0, 100);
  if (std::fabs(b.last.left * 1e-4 - b.speed()) > 1e-3 || b.last.left != b.last.right)
    return "another full speed";
  if (b.guard.status().reason != GuardReason::limits) return "a speed beyond the limit is not said";
  if (std::fabs(b.guard.status().forward.raw() / 16384.0 - b.speed() / v) > 0.01)
    return "another share of speed";
  // Both at once keep their curvature.
  const double w = dice.uniform(0.5, 2);
  b.drive(b.speed(), w, 100);
  const double left = b.last.left * 1e-4, right = b.last.right * 1e-4,
               curvature = (right - left) / track / ((left + right) / 2);
  if (b.guard.status().reason == GuardReason::limits &&
      std::fabs(curvature - w / b.speed()) > 0.05 + 0.02 * w / b.speed())
    return "another curvature";
  return b.wrong;
}

/// Sensors that lose walls leave a doubt, which costs speed and no more.
std::string judge_doubt(Dice& dice) {
  Params p = draw_params(dice);
  p.guard.nods = p.guard.assist = Fitted::no;
  p.rangefinders.incidence = Angle::turns(50 + dice.index(24), 360);
  if (check(p) != ParamFault::none) return "";
  Bench b(dice, p, {});
  b.survey();
  b.drive(b.speed(), 0, 60);
  const double most = std::min(b.speed(), safety::warned_speed(p, false).raw() * 1e-6),
               v = b.rim_share() * b.speed();
  if (v > most + 2e-3) return "faster than a late warning allows";
  const GuardReason reason = b.guard.status().reason;
  if (reason == GuardReason::unseen || reason == GuardReason::obstacle) return "";
  if (v < most - 2e-3) return "slower than a late warning asks for";
  if (most < b.speed() - 2e-3 && reason != GuardReason::doubt) return "a doubt is not said";
  return b.wrong;
}

/// A wall ahead: it stops before it, and not far from it.
std::string judge_wall(Dice& dice) {
  Params p = draw_params(dice);
  const double heading = dice.uniform(-3, 3), distance = dice.uniform(0.35, 1.2);
  Bench b(dice, p, {});
  const double h = b.body.pose().heading;
  static_cast<void>(heading);
  const sim::Vec2 ahead{std::cos(h), std::sin(h)}, left{-ahead.y, ahead.x};
  const bool post = dice.chance(0.4);
  if (post) {
    b.body.world.discs = {{ahead * (distance + 0.03), 0.03}};
  } else {
    b.body.world.segments = {{ahead * distance + left * 3, ahead * distance - left * 3}};
  }
  b.survey();
  // Back to the heading of the wall.
  for (int i = 0; i < 500 && std::fabs(std::remainder(b.body.pose().heading - h, 2 * sim::kPi)) > 0.01; ++i) {
    b.drive(0, -3 * std::remainder(b.body.pose().heading - h, 2 * sim::kPi), 1);
  }
  Params straight = b.p;
  static_cast<void>(straight);
  double nearest = 1e9;
  bool obstacle = false;
  for (int i = 0; i < 900; ++i) {
    b.drive(b.speed(), 0, 1);
    nearest = std::min(nearest, b.body.gap_m());
    const GuardReason reason = b.guard.status().reason;
    obstacle = obstacle || reason == GuardReason::obstacle || reason == GuardReason::assisted;
  }
  if (nearest < 0) return "it touches what it has seen";
  if (!obstacle) return "an obstacle is not said";
  const double cell = metres(grid_cell(b.p)), margin = metres(reach(b.p).guard - b.p.body.radius);
  if (b.p.guard.assist == Fitted::no && !post && nearest > margin + 3.2 * cell)
    return "it stops too far from a wall";
  return b.wrong;
}

/// Straight from where it was put down: a beam turns to the unseen ground, or somebody vouches for it.
std::string judge_unseen(Dice& dice) {
  Params p = draw_params(dice, false);
  const bool vouched = dice.chance(0.4);
  Bench b(dice, p, {});
  const double h = b.body.pose().heading;
  if (vouched) b.guard.vouch(350_mm);
  b.drive(0, 0, 40);
  bool nodded = false, unseen = false;
  for (int i = 0; i < 1000; ++i) {
    b.drive(b.speed() * 0.7, 0, 1);
    nodded = nodded || b.guard.status().reason == GuardReason::nodding;
    unseen = unseen || b.guard.status().reason == GuardReason::unseen;
  }
  const double way = length_of(b.body.pose().at),
               off = std::fabs(std::remainder(b.body.pose().heading - h, 2 * sim::kPi));
  if (p.guard.nods == Fitted::no) {
    if (nodded || off > 0.02) return "it nods although it may not";
    if (!vouched && (way > 0.2 || !unseen)) return "unseen ground is granted";
    return vouched && way < 0.05 ? "vouched ground is not granted" : b.wrong;
  }
  if (!vouched && !nodded) return "it does not nod";
  if (way < 0.7) return "it does not get on by nods";
  return off < 0.5 ? b.wrong : "it does not come back from its nods";
}

/// One thing breaks: the fault has the right name and comes in its time.
std::string judge_broken(Dice& dice) {
  Params p = draw_params(dice);
  p.guard.nods = p.guard.assist = Fitted::no;
  p.safety.lost_after = milliseconds(400 + dice.index(1000));
  p.safety.stalled_after = milliseconds(500 + dice.index(2000));
  p.conditioning.stale_after = milliseconds(150 + dice.index(150));
  if (check(p) != ParamFault::none) return "";
  Bench b(dice, p, {});
  b.survey();
  const double v = b.speed() * 0.8;
  b.drive(v, 0, 100);
  if (b.guard.status().health.fault != Fault::none) return "a fault without cause";
  const int what = dice.index(9);
  Fault due = Fault::none;
  int least = 0, most = 0, gap = 10;
  bool stale = false;
  switch (what) {
    case 0:
      b.body.refuses_ranges = true;
      due = Fault::range_lost;
      least = p.safety.lost_after.raw() - 80;
      most = p.safety.lost_after.raw() + 30;
      stale = true;
      break;
    case 1:
      b.body.lost_beam = dice.index(3);
      due = Fault::range_lost;
      least = p.safety.lost_after.raw() - 80;
      most = p.safety.lost_after.raw() + 30;
      stale = true;
      break;
    case 2:
      b.body.refuses_counts = true;
      due = Fault::drive_refused;
      least = 10 * (p.safety.max_refusals - 1);
      most = 10 * (p.safety.max_refusals + 1);
      break;
    case 3:
      b.body.refuses_commands = true;
      due = Fault::drive_refused;
      least = 10 * (p.safety.max_refusals - 1);
      most = 10 * (p.safety.max_refusals + 1);
      break;
    case 4:
      b.body.jump[dice.chance(0.5) ? 0 : 1] +=
          static_cast<std::uint32_t>(dice.chance(0.5) ? 3000 : hal::kEncoderModulus - 3000);
      due = Fault::encoder_jump;
      most = 11;
      break;
    case 5:
      b.body.counted = {0, 0};
      due = Fault::wheels_stalled;
      least = p.safety.stalled_after.raw() - 80;
      most = p.safety.stalled_after.raw() + 200;
      break;
    case 6:
      b.body.counted[dice.chance(0.5) ? 0 : 1] = 0;
      due = Fault::wheels_stalled;
      most = 2500;
      break;
    case 7:
      b.body.counted[dice.chance(0.5) ? 0 : 1] = -1;
      due = Fault::wheel_runaway;
      most = 2500;
      break;
    default:
      gap = dice.chance(0.5) ? longest_gap(p).raw() + 1 : 0;
      due = Fault::clock_jump;
      most = gap + 1;
      break;
  }
  int ms = 0;
  for (; ms <= most + 2000 && b.guard.status().health.fault == Fault::none; ms += gap > 0 ? gap : 1) {
    b.ask(v, 0);
    b.commanded = b.now;
    b.any_command = true;
    b.tick(gap);
    gap = 10;
    if (stale && ms > p.conditioning.stale_after.raw() + 60 && b.guard.status().health.fault == Fault::none) {
      if (b.guard.status().reason != GuardReason::stale_ranges) return "a stale beam is not said";
    }
  }
  const Fault fault = b.guard.status().health.fault;
  if (fault != due) return fault == Fault::none ? "a fault is not noticed" : "a fault has another name";
  if (ms < least || ms > most + 10) return "a fault at another time";
  b.body.refuses_commands = false;
  b.drive(v, 0, 150);
  if (b.guard.status().health.fault != due || !b.body.stands()) return "a fault does not hold";
  // And ends.
  b.body.refuses_ranges = b.body.refuses_counts = false;
  b.body.lost_beam = -1;
  b.body.counted = {1, 1};
  b.guard.reset();
  b.any_command = false;
  b.tick();
  const GuardStatus& s = b.guard.status();
  if (s.health.fault != Fault::none) return "a reset does not end a fault";
  if (!(s.pose.at == Vec{}) || s.pose.heading.raw() != 0) return "a reset does not begin at zero";
  if (s.command.left != 0) return "a command from before a reset";
  b.survey();
  b.drive(v, 0, 100);
  return b.guard.status().health.fault == Fault::none && b.rim_share() > 0.7
             ? b.wrong
             : "it does not drive after a reset";
}

/// The time-out of a command, to the tick.
std::string judge_timeout(Dice& dice) {
  Params p = draw_params(dice);
  p.guard.nods = p.guard.assist = Fitted::no;
  Bench b(dice, p, {});
  if (b.tick().reason != GuardReason::stale_ranges && b.guard.status().reason != GuardReason::command_timeout)
    return "a reason without a command";
  b.survey();
  b.drive(b.speed() * 0.5, 0, 80);
  for (int ms = 10; ms < p.guard.command_timeout.raw() + 400; ms += 10) {
    b.tick();
    const bool over = static_cast<int>(b.now - b.commanded) > p.guard.command_timeout.raw();
    if (over != (b.guard.status().reason == GuardReason::command_timeout))
      return "a time-out at another time";
    if (!over && b.rim_share() < 0.4) return "it brakes before the time-out";
  }
  b.tick();
  for (int i = 0; i < 150; ++i) b.tick();
  return b.body.stands() ? b.wrong : "it does not stand after a time-out";
}

}  // namespace

std::string judge_guarded(Dice& dice) {
  for (const JudgePart judge : {judge_open, judge_doubt, judge_limits, judge_wall, judge_unseen, judge_broken,
                                judge_broken, judge_timeout}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
