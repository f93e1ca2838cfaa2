#include "host/guard/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/paths/shortest.hpp"
#include "host/scenario/world.hpp"

namespace whisker::guard {
namespace {

constexpr double kStep_m = 0.01;
constexpr double kGain = 4;  // 1/s

double distance(sim::Vec2 a, sim::Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

sim::Vec2 point_of(const paths::Leg& leg, double share) {
  if (leg.turn_rad == 0) return leg.from + (leg.to - leg.from) * share;
  const double angle =
      std::atan2(leg.from.y - leg.around.center.y, leg.from.x - leg.around.center.x) + leg.turn_rad * share;
  return leg.around.center + sim::Vec2{std::cos(angle), std::sin(angle)} * leg.around.radius;
}

}  // namespace

std::optional<std::vector<sim::Vec2>> path_with_margin(const Scenario& scenario, double margin_m) {
  const double radius = scenario.robot.body.radius.raw() * 1e-6 + margin_m;
  const auto way = paths::shortest_way(make_world(scenario), scenario.start.at, scenario.goal.at, radius);
  if (!way) return std::nullopt;
  std::vector<sim::Vec2> points{scenario.start.at};
  for (const paths::Leg& leg : way->legs) {
    const int steps = std::max(1, static_cast<int>(std::ceil(paths::length_m(leg) / kStep_m)));
    for (int i = 1; i <= steps; ++i) points.push_back(point_of(leg, static_cast<double>(i) / steps));
  }
  return points;
}

Limits limits_of(const Scenario& scenario) {
  return {scenario.robot.wheels.max_speed.raw() * 1e-6, scenario.robot.wheels.max_turn_rate.raw() * 1e-6};
}

PathFollower::PathFollower(std::vector<sim::Vec2> path, double radius_m, Limits limits)
    : path_(std::move(path)), ahead_m_(radius_m), limits_(limits) {}

Twist PathFollower::ask(const Sight& sight) {
  const sim::Pose& pose = sight.pose;
  while (at_ + 1 < path_.size() && distance(path_[at_ + 1], pose.at) <= distance(path_[at_], pose.at)) ++at_;
  // Past a bend that it cut.
  const std::size_t last = std::min(path_.size() - 1, at_ + 20);
  for (std::size_t i = at_; i <= last; ++i) {
    if (distance(path_[i], pose.at) < distance(path_[at_], pose.at)) at_ = i;
  }
  std::size_t target = at_;
  while (target + 1 < path_.size() && distance(path_[target], pose.at) < ahead_m_) ++target;
  const sim::Vec2 to = off(path_[target], sight) - pose.at;
  const double error = std::remainder(std::atan2(to.y, to.x) - pose.heading, 2 * M_PI);
  const double turning = std::clamp(kGain * error, -limits_.turn_radps, limits_.turn_radps);
  const double straight = std::max(0.0, 1 - std::fabs(error) * 1.2);
  return {limits_.speed_mps * straight, turning};
}

}  // namespace whisker::guard
