// The guard in open ground, at its limits, before a wall and where nobody has looked.
#include "firmware/safety/warning.hpp"
#include "host/lab/hunt/parts/guard_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

/// In open ground a command is granted once the ground was seen, up to what the wheels can do.
std::string judge_open(Dice& dice) {
  GuardBench b(dice, draw_guarded(dice), {});
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

/// Sensors that lose walls leave a doubt, which costs speed and no more.
std::string judge_doubt(Dice& dice) {
  Params p = draw_guarded(dice);
  p.guard.nods = p.guard.assist = Fitted::no;
  p.rangefinders.incidence = Angle::turns(50 + dice.index(24), 360);
  if (check(p) != ParamFault::none) return "";
  GuardBench b(dice, p, {});
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

/// More than the wheels can do is scaled, and said.
std::string judge_limits(Dice& dice) {
  Params p = draw_guarded(dice);
  p.guard.nods = p.guard.assist = Fitted::no;
  GuardBench b(dice, p, {});
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

/// A wall ahead: it stops before it, and not far from it.
std::string judge_wall(Dice& dice) {
  Params p = draw_guarded(dice);
  const double heading = dice.uniform(-3, 3), distance = dice.uniform(0.35, 1.2);
  GuardBench b(dice, p, {});
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
  Params p = draw_guarded(dice, false);
  const bool vouched = dice.chance(0.4);
  GuardBench b(dice, p, {});
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
  if (way < 0.6) return "it does not get on by nods";
  return off < 0.06 ? b.wrong : "it does not come back from its nods";
}

}  // namespace

std::string judge_guarded(Dice& dice) {
  for (const JudgePart judge : {judge_open, judge_doubt, judge_limits, judge_wall, judge_unseen}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
