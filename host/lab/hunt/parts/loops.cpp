// What a planner remembers of its way round an obstacle, on circles and pieces of them.
#include <algorithm>
#include <cmath>

#include "firmware/planning/boundary/breadcrumbs.hpp"
#include "firmware/planning/boundary/loop_detector.hpp"
#include "firmware/planning/boundary/progress_checker.hpp"
#include "firmware/planning/boundary/stuck_detector.hpp"
#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using planning::LoopDetector;
using planning::View;
using Evidence = LoopDetector::Evidence;

/// Drives on a circle, to the left or to the right.
class Round {
 public:
  Round(Dice& dice, double radius_m)
      : radius_(micrometres(static_cast<std::int32_t>(radius_m * 1e6))), left_(dice.chance(0.5)) {
    params_.body.radius = dice.chance(0.5) ? 90_mm : millimetres(40 + dice.index(200));
    deg_ = dice.index(360);
    view_.travelled_um = static_cast<std::uint32_t>(dice.bits());
    centre_ = {millimetres(dice.index(4000) - 2000), millimetres(dice.index(4000) - 2000)};
    place();
  }
  void begin(LoopDetector& loop) { loop.begin(view_, params_); }
  void drive(LoopDetector& loop, Vec drift = {}) {
    const Vec before = view_.pose.at;
    centre_ = centre_ + drift;
    deg_ += left_ ? 1 : -1;
    place();
    view_.travelled_um += static_cast<std::uint32_t>(norm(view_.pose.at - before).raw());
    loop.move(view_);
  }
  void jump(Vec by) {
    centre_ = centre_ + by;
    place();
  }
  View& view() { return view_; }
  bool left() const { return left_; }
  double scale() const { return metres(params_.body.radius) / 0.09 * 0.1; }
  Vec centre() const { return centre_; }

 private:
  void place() {
    const Angle heading = Angle::turns(((deg_ % 360) + 360) % 360, 360);
    view_.pose = {centre_ + polar(heading + (left_ ? -(90_deg) : 90_deg), radius_), heading};
  }
  Params params_;
  Length radius_;
  bool left_;
  int deg_ = 0;
  Vec centre_;
  View view_;
};

/// A loop closes where it began, after a whole turn, and not before; the turn into it is none of it.
std::string judge_closing(Dice& dice) {
  const double radius = dice.log_uniform(0.3, 3);
  Round round(dice, radius);
  if (radius < 3.5 * round.scale()) return "";
  LoopDetector loop;
  const Angle along = round.view().pose.heading;
  round.view().pose.heading = along + Angle::turns(dice.index(300) - 150, 360);
  round.begin(loop);
  round.view().pose.heading = along;
  loop.move(round.view());
  if (loop.closed(round.view())) return "a loop closes where it begins";
  const double circumference = 2 * sim::kPi * radius;
  const double near = std::min(3.5 * round.scale(), 1.5 * round.scale() + circumference / 50);
  for (int deg = 1; deg <= 365; ++deg) {
    round.drive(loop);
    const bool closed = loop.closed(round.view());
    const double off = 2 * radius * std::fabs(std::sin(deg * sim::kPi / 360));
    if (closed && (deg < 298 || off > near * 1.02 + 0.002)) return "a loop closes too soon";
    if (closed) return "";
    if (deg > 302 && off < near * 0.97 - 0.003) return "a loop does not close";
  }
  return "a loop never closes";
}

/// What the pose may be off widens the place, but not beyond half of the loop.
std::string judge_bound(Dice& dice) {
  const double radius = dice.uniform(0.8, 3), grown = dice.uniform(0, 1.5) * radius;
  Round round(dice, radius);
  if (radius < 4 * round.scale()) return "";
  LoopDetector loop;
  round.view().bound = 1_m;
  round.begin(loop);
  loop.closed(round.view());
  const double off = dice.uniform(0, 1.4) * radius;
  const Vec drift = polar(draw_angle(dice), micrometres(static_cast<std::int32_t>(off / 360 * 1e6)));
  bool closed = false;
  double reached = 0;
  const Vec from = round.view().pose.at;
  for (int deg = 1; deg <= 360; ++deg) {
    round.drive(loop, drift);
    reached = std::max(reached, metres(norm(round.view().pose.at - from)));
  }
  round.view().bound = 1_m + micrometres(static_cast<std::int32_t>(grown * 1e6));
  closed = loop.closed(round.view());
  const double apart = metres(norm(round.view().pose.at - from));
  const double way = (round.view().travelled_um) * 0.0;
  static_cast<void>(way);
  const double small = 1.5 * round.scale(), large = 3.5 * round.scale();
  if (grown > reached / 2 * 1.01 && closed) return "a loop closes within its own error";
  if (grown < reached / 2 * 0.99 && apart < std::max(small, grown) * 0.99 && !closed)
    return "a bound does not close it";
  return apart > std::max(large, grown) * 1.02 && closed ? "a loop closes beside its beginning" : "";
}

/// Away and back without a turn, so often.
std::string judge_returns(Dice& dice) {
  const bool place = dice.chance(0.5);
  const Evidence evidence = place ? Evidence::place : Evidence::turning;
  Round round(dice, 1);
  LoopDetector loop;
  const Pose here = round.view().pose;
  const double scale = round.scale(), far = dice.uniform(2, 20) * scale;
  if (std::fabs(far - 3 * scale) < 0.1 * scale || std::fabs(far - 15 * scale) < 0.2 * scale) return "";
  round.begin(loop);
  loop.closed(round.view(), evidence);
  const bool back = dice.chance(0.1);
  const bool counts = far > 3 * scale, at_once = place && far > 15 * scale;
  for (int i = 1; i <= 5; ++i) {
    for (const double off : {far, 1.4 * scale, 0.0, 0.0}) {
      round.view().pose.at =
          here.at + polar(draw_angle(dice), micrometres(static_cast<std::int32_t>(off * 1e6)));
      round.view().pose.heading = back && off < far ? here.heading + 180_deg : here.heading;
      round.view().travelled_um += 100000;
      loop.move(round.view());
      const bool closed = loop.closed(round.view(), evidence);
      const bool due = !back && off < far &&
                       ((at_once && off <= 1.5 * scale) || (counts && !at_once && i >= 3 && off > 0));
      if (closed && back) return "a loop closes the other way round";
      if (closed && !due) return "a return closes too soon";
      if (!closed && due) return "a return does not close";
      if (closed && !at_once) return "";
    }
  }
  return "";
}

/// Laps elsewhere are round something else.
std::string judge_strays(Dice& dice) {
  const double radius = dice.uniform(0.4, 1.5);
  Round round(dice, radius);
  LoopDetector loop;
  round.begin(loop);
  loop.closed(round.view());
  const double scale = round.scale();
  if (2 * sim::kPi * radius < 11 * scale) return "";
  round.jump({10_m, 5_m});
  const bool drifts = dice.chance(0.5);
  const Evidence evidence = dice.chance(0.5) ? Evidence::place : Evidence::turning;
  // Farther than a lap may end beside the place where it began.
  const double lap = drifts ? 6 * scale + radius : 0;
  const Vec drift{micrometres(static_cast<std::int32_t>(lap / 360 * 1e6)), Length{}};
  loop.move(round.view());
  int strays = 0;
  for (int deg = 1; deg <= 1500 && strays == 0; ++deg) {
    round.drive(loop, drift);
    if (loop.closed(round.view(), evidence) && !drifts) return "a loop closes elsewhere";
    if (loop.strays(round.view(), evidence)) strays = deg;
  }
  // The second lap ends near the end of the first one, but not before the heading is about the same.
  const double near = std::min(15.0, 360 / sim::kPi * std::asin(0.75 * scale / radius));
  if (!drifts) return std::fabs(strays - (720 - near)) < 3 ? "" : "two laps in one place are none";
  const bool by_turns = evidence == Evidence::turning;
  return std::abs(strays - (by_turns ? 1455 : 0)) < 4 ? "" : "laps that get on stray";
}

std::string judge_sides(Dice& dice) {
  Round round(dice, 1);
  LoopDetector loop;
  round.begin(loop);
  loop.closed(round.view());
  for (int deg = 0; deg < 360; ++deg) round.drive(loop);
  const Vec in = round.centre() + polar(draw_angle(dice), millimetres(dice.index(800)));
  const Vec out = round.centre() + polar(draw_angle(dice), 4_m + millimetres(dice.index(3000)));
  // With the wall inside the loop it encloses the goal; else it encloses the start.
  const bool wall_left = dice.chance(0.5), inside = wall_left == round.left();
  const planning::Side wall = wall_left ? planning::Side::left : planning::Side::right;
  if (!loop.may_part(inside ? out : in, inside ? in : out, wall)) return "a loop parts nothing";
  if (loop.may_part(out, out, wall)) return "a loop parts what lies outside";
  return loop.may_part(inside ? in : out, inside ? out : in, wall) ? "a loop parts the wrong way" : "";
}

std::string judge_breadcrumbs(Dice& dice) {
  planning::Breadcrumbs crumbs;
  const Length apart = millimetres(20 + dice.index(60));
  Pose pose = draw_pose(dice);
  pose.at = {millimetres(dice.index(1000)), millimetres(dice.index(1000))};
  crumbs.reset(pose.at, apart);
  if (crumbs.way_back(pose).raw() != (pose.heading + 180_deg).raw()) return "another way back at first";
  std::vector<Vec> kept(4, pose.at);
  for (int i = 0; i < 200; ++i) {
    pose.heading += Angle::turns(dice.index(21) - 10, 360);
    pose.at = pose.at + polar(pose.heading, millimetres(dice.index(15)));
    const double off = metres(norm(pose.at - kept.back()));
    const bool added = crumbs.add(pose.at);
    if (std::fabs(off - metres(apart)) > 2e-6 && added != (off >= metres(apart)))
      return "a breadcrumb at another place";
    if (added) kept.push_back(pose.at);
    for (int n = 0; n < planning::Breadcrumbs::kPlaces; ++n) {
      if (!(crumbs.back(n) == kept[kept.size() - 1 - static_cast<std::size_t>(n)]))
        return "another breadcrumb";
    }
    const Vec from = kept[kept.size() - 4];
    if (norm(from - pose.at) < apart * 2) continue;
    if (std::fabs(radians(crumbs.way_back(pose) - bearing(from - pose.at))) > 1e-3) return "another way back";
  }
  return "";
}

std::string judge_progress(Dice& dice) {
  planning::ProgressChecker progress;
  View view;
  view.travelled_um = static_cast<std::uint32_t>(dice.bits());
  const Params p;
  progress.start(view);
  const int pauses = dice.index(60);
  for (int i = 0; i < pauses; ++i) progress.pause();
  if (progress.rests() != (pauses >= 24)) return "rests at another time";
  const std::int32_t travel_mm = dice.index(500000);
  view.travelled_um += static_cast<std::uint32_t>(travel_mm) * 1000U;
  const bool leaves = dice.chance(0.5);
  view.pose.at = polar(draw_angle(dice), leaves ? 31_mm : 29_mm);
  progress.move(view, p);
  if (progress.travel_mm() != travel_mm) return "another travel";
  if (leaves ? progress.rests() : progress.rests() != (pauses >= 24)) return "rests although it got on";
  const Length budget = micrometres(1000 * (travel_mm + (dice.chance(0.5) ? 1 : -1)));
  if (travel_mm > 0 &&
      (progress.exhausted(budget) == planning::Why::length_budget) != (travel_mm > budget.raw() / 1000))
    return "another budget";
  progress.start(view);
  for (int i = 0; i < 1000; ++i) progress.pause();
  if (progress.exhausted(2000_m) != planning::Why::none) return "gives up too soon";
  progress.pause();
  return progress.exhausted(2000_m) == planning::Why::no_exit ? "" : "never gives up";
}

std::string judge_stuck(Dice& dice) {
  planning::StuckDetector stuck;
  Params p;
  p.wheels.motor_lag = milliseconds(dice.index(100));
  p.rangefinders.latency = milliseconds(dice.index(100));
  p.rangefinders.rate_hz = 5 + dice.index(90);
  const double starts_ms =
      2.0 * p.wheels.motor_lag.raw() + p.rangefinders.latency.raw() + 4000 / p.rangefinders.rate_hz;
  const Duration patience = planning::patience(p);
  if (std::abs(patience.raw() - 4 * starts_ms) > 4) return "another patience";
  View view;
  const bool held = dice.chance(0.5), turns = dice.chance(0.5);
  view.granted = held ? Q14::ratio(1, 2) : Q14::ratio(1, 1);
  const double limit = 0.3 * metres(p.body.track) / 2;
  view.turning = Speed::from_raw(static_cast<std::int32_t>(limit * (turns ? 1.1 : 0.9) * 1e6)) *
                 (dice.chance(0.5) ? 1 : -1);
  view.elapsed = 5_ms;
  const int rate = held && !turns ? 4 : 1;
  const double slow = p.wheels.max_speed.raw() / 15.0;
  view.forward = Speed::from_raw(static_cast<std::int32_t>(slow * 1.1));
  for (int i = 0; i < 1000; ++i) {
    if (stuck.stalled(view, patience, p)) return "a body that gets on is stuck";
  }
  view.forward = Speed::from_raw(static_cast<std::int32_t>(slow * 0.9));
  const double step_ms = std::min(5, patience.raw() / 16) * rate;
  for (int i = 1; i < 5000; ++i) {
    const bool found = stuck.stalled(view, patience, p), due = i * step_ms >= patience.raw();
    if (found != due) return found ? "stuck too soon" : "stuck unnoticed";
    if (found) return "";
  }
  return "never stuck";
}

}  // namespace

std::string judge_loops(Dice& dice) {
  for (int i = 0; i < 12; ++i) {
    for (const JudgePart judge : {judge_closing, judge_bound, judge_returns, judge_strays, judge_sides,
                                  judge_breadcrumbs, judge_progress, judge_stuck}) {
      std::string wrong = judge(dice);
      if (!wrong.empty()) return wrong;
    }
  }
  return "";
}

}  // namespace whisker::hunt
