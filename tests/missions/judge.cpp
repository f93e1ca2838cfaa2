#include "tests/missions/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

namespace whisker::test {
namespace {

double to_segment(double x, double y, sim::Vec2 a, sim::Vec2 b) {
  const double ux = b.x - a.x, uy = b.y - a.y;
  const double length2 = ux * ux + uy * uy;
  const double t = length2 > 0 ? std::clamp(((x - a.x) * ux + (y - a.y) * uy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - a.x - t * ux, y - a.y - t * uy);
}

double to_chain(double x, double y, const std::vector<sim::Vec2>& points, bool closed) {
  double d = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) d = std::min(d, to_segment(x, y, points[i - 1], points[i]));
  if (closed) d = std::min(d, to_segment(x, y, points.back(), points.front()));
  return d;
}

double clearance(const Scenario& s, double x, double y) {
  double d = std::numeric_limits<double>::infinity();
  for (const sim::Disc& disc : s.discs) {
    d = std::min(d, std::hypot(x - disc.center.x, y - disc.center.y) - disc.radius);
  }
  for (const auto& p : s.polygons) d = std::min(d, to_chain(x, y, p, true));
  for (const auto& w : s.walls) d = std::min(d, to_chain(x, y, w, false));
  if (s.bounds) {
    d = std::min({d, x - s.bounds->min.x, s.bounds->max.x - x, y - s.bounds->min.y, s.bounds->max.y - y});
  }
  return d - s.robot.body.radius.raw() * 1e-6;
}

}  // namespace

Ruling judge(const Scenario& scenario, const std::vector<TickRecord>& records, const RunResult& result) {
  constexpr double kRounding = 1e-9;
  const double top = scenario.robot.wheels.max_speed.raw() * 1e-6;
  const double accel = scenario.robot.wheels.max_acceleration.raw() * 1e-6;
  const double track = scenario.robot.body.track.raw() * 1e-6;
  const double period = scenario.robot.safety.period.raw() * 1e-3;
  const bool contact = result.verdict == Verdict::contact;
  Ruling ruling;
  ruling.min_clearance_m = std::numeric_limits<double>::infinity();
  const auto object = [&](std::size_t i, const std::string& what) {
    if (ruling.complaint.empty())
      ruling.complaint = fmt::format("row {} ({} s): {}", i, records[i].t_s, what);
  };
  for (std::size_t i = 0; i < records.size(); ++i) {
    const TickRecord& r = records[i];
    const double gap = clearance(scenario, r.x_m, r.y_m);
    ruling.min_clearance_m = std::min(ruling.min_clearance_m, gap);
    if (gap < -1e-6) object(i, fmt::format("the body lies {} m inside an obstacle", -gap));
    if (std::max(std::fabs(r.v_left_mps), std::fabs(r.v_right_mps)) > top + kRounding) object(i, "too fast");
    if (i == 0) continue;
    const TickRecord& before = records[i - 1];
    const bool impact = contact && i + 1 == records.size();
    if (std::fabs(r.t_s - before.t_s - period) > kRounding) object(i, "not one row per tick");
    const double change =
        std::max(std::fabs(r.v_left_mps - before.v_left_mps), std::fabs(r.v_right_mps - before.v_right_mps));
    if (!impact && change > accel * period + kRounding) object(i, "a wheel changed its speed too quickly");
    const double dx = r.x_m - before.x_m, dy = r.y_m - before.y_m;
    const double middle = (r.heading_rad + before.heading_rad) / 2;
    const double sideways = -dx * std::sin(middle) + dy * std::cos(middle);
    // The mean heading is inexact within a tick: the error is of second order in turn and acceleration.
    if (std::fabs(sideways) >
        2e-6 + 0.02 * std::hypot(dx, dy) * std::fabs(r.heading_rad - before.heading_rad)) {
      object(i, fmt::format("slid {} m sideways", sideways));
    }
    if (std::hypot(dx, dy) > top * period + kRounding) object(i, "moved further than full speed allows");
    if (std::fabs(r.heading_rad - before.heading_rad) > 2 * top * period / track + kRounding) {
      object(i, "turned further than full speed allows");
    }
  }
  if (records.empty()) return ruling;
  const std::size_t last = records.size() - 1;
  if (contact && std::fabs(clearance(scenario, records[last].x_m, records[last].y_m)) > 1e-6) {
    object(last, "a contact is claimed where there is a gap");
  }
  const double left =
      std::hypot(records[last].x_m - scenario.goal.at.x, records[last].y_m - scenario.goal.at.y);
  if (std::fabs(left - result.final_distance_m) > 1e-6) object(last, "the final distance is another one");
  const double beyond = left - scenario.goal.tolerance_m;
  if (result.verdict == Verdict::reached && beyond > 1e-6) object(last, "reached is claimed from afar");
  if (result.verdict == Verdict::off_goal && beyond < -1e-6) object(last, "at the goal, and called off it");
  if (result.min_clearance_m > ruling.min_clearance_m + 2e-4)
    object(last, "the clearance claimed is too large");
  return ruling;
}

}  // namespace whisker::test
