#include "host/lab/hunt/judge.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/sim/elementary.hpp"
#include "host/lab/hunt/geometry.hpp"

namespace whisker::hunt {
namespace {

constexpr double kRounding_m = 1e-7;
constexpr double kRest_s = 30;
constexpr double kTurned = 0.05;  // rad
constexpr int kSamples = 4;       // of the arc between two places

/// A share of the arc that begins with this heading; its chord ends at `to`.
sim::Vec2 along(const sim::Pose& from, const sim::Pose& to, double share) {
  const sim::Vec2 chord = to.at - from.at;
  const double turn = to.heading - from.heading;
  if (std::fabs(turn) < 1e-6) return from.at + chord * share;
  // The chord of a share of the arc, relative to the whole: sin(s t / 2) / sin(t / 2), turned by (s - 1) t
  // / 2.
  const double scale = sim::sin_cos(share * turn / 2).sin / sim::sin_cos(turn / 2).sin;
  const sim::SinCos by = sim::sin_cos((share - 1) * turn / 2);
  return from.at +
         sim::Vec2{chord.x * by.cos - chord.y * by.sin, chord.x * by.sin + chord.y * by.cos} * scale;
}

}  // namespace

Judge::Judge(const Scenario& scenario)
    : scenario_(scenario),
      radius_m_(scenario.robot.body.radius.raw() * 1e-6),
      last_(scenario.start.at),
      before_(scenario.start),
      rest_(scenario.start) {
  least_m_ = last_gap_m_ = nearest(scenario, scenario.start.at).distance_m - radius_m_;
  // A robot that creeps touches with its bumper.
  const bool creeps = scenario.robot.bumper.creep_speed != Speed{};
  margin_m_ = creeps ? 0 : std::min(least_m_, scenario.robot.boundary.guard_margin.raw() * 1e-6);
}

void Judge::see(const sim::Pose& pose, double t_s) {
  const double chord = length(pose.at - before_.at), turn = std::fabs(pose.heading - before_.heading);
  if (chord > 0 && turn < 3) {
    const double slack = kRounding_m + 0.1 * chord * turn;
    for (int i = 1; i < kSamples; ++i) look(along(before_, pose, static_cast<double>(i) / kSamples), slack);
  }
  look(pose.at, kRounding_m);
  before_ = pose;
  note_rest(pose, t_s);
}

void Judge::look(sim::Vec2 at, double slack_m) {
  // A gap changes by no more than the way.
  if (last_gap_m_ - length(at - last_) > std::max(least_m_, 0.0) + slack_m) return;
  last_ = at;
  last_gap_m_ = nearest(scenario_, at).distance_m - radius_m_;
  least_m_ = std::min(least_m_, last_gap_m_ + slack_m);
  touched_ = touched_ || last_gap_m_ < -slack_m;
}

void Judge::note_rest(const sim::Pose& pose, double t_s) {
  const bool moved = length(pose.at - rest_.at) > 0.02 * radius_m_;
  if (!moved && std::fabs(pose.heading - rest_.heading) < kTurned) return;
  rest_ = pose;
  rests_since_s_ = t_s;
}

bool Judge::rests(double t_s) const { return t_s - rests_since_s_ > kRest_s; }

}  // namespace whisker::hunt
