#include "host/lab/guard/operators.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "host/harness/scenario/scenario.hpp"
#include "host/harness/scenario/world.hpp"
#include "host/harness/worlds/random.hpp"
#include "host/lab/guard/operator.hpp"
#include "host/lab/paths/shortest.hpp"

namespace whisker::guard {
namespace {

struct Limits {
  double speed_mps;
  double turn_radps;
};

/// Drives towards the point one body radius ahead on the path, and stops at its end.
class PathFollower : public Operator {
 public:
  PathFollower(std::vector<sim::Vec2> path, double radius_m, Limits limits);
  Twist ask(const Sight& sight) override;

 protected:
  /// Moves the point that it drives to.
  virtual sim::Vec2 off(sim::Vec2 target, const Sight&) { return target; }

 private:
  std::vector<sim::Vec2> path_;
  double ahead_m_;
  Limits limits_;
  std::size_t at_ = 0;  // nearest point so far
};

constexpr double kStep_m = 0.01;
constexpr double kGain = 4;  // 1/s

double distance(sim::Vec2 a, sim::Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

sim::Vec2 point_of(const paths::Leg& leg, double share) {
  if (leg.turn_rad == 0) return leg.from + (leg.to - leg.from) * share;
  const double angle =
      std::atan2(leg.from.y - leg.around.center.y, leg.from.x - leg.around.center.x) + leg.turn_rad * share;
  return leg.around.center + sim::Vec2{std::cos(angle), std::sin(angle)} * leg.around.radius;
}

/// The shortest path from start to goal that keeps this distance from all obstacles, as points 1 cm apart.
/// None if there is no such path.
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

constexpr double kPerfectMargin_m = 0.1;
constexpr double kSloppyMargin_m = 0.03;
constexpr double kHandError_m = 0.06;

/// About a standard normal deviate.
double deviate(worlds::Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform(0, 1);
  return sum;
}

/// Looks two radii ahead, and its target wanders: the correlation time of the error is three seconds.
class Sloppy final : public PathFollower {
 public:
  Sloppy(std::vector<sim::Vec2> path, const Scenario& s, std::uint64_t seed)
      : PathFollower(std::move(path), s.robot.body.radius.raw() * 2e-6, limits_of(s)), random_(seed) {}

 private:
  sim::Vec2 off(sim::Vec2 target, const Sight& sight) override {
    const double decay = std::exp(-(sight.t_s - last_s_) / 3);
    last_s_ = sight.t_s;
    const double fresh = std::sqrt(1 - decay * decay);
    error_ = {error_.x * decay + fresh * deviate(random_), error_.y * decay + fresh * deviate(random_)};
    return target + error_ * kHandError_m;
  }

  worlds::Random random_;
  sim::Vec2 error_;
  double last_s_ = -10;
};

class Joystick final : public Operator {
 public:
  Joystick(const Scenario& s, std::uint64_t seed) : limits_(limits_of(s)), random_(seed) {}
  Twist ask(const Sight& sight) override {
    if (sight.t_s >= until_s_) {
      until_s_ = sight.t_s + random_.uniform(0.3, 2);
      const bool turns = random_.chance(0.6);
      twist_ = {limits_.speed_mps * (random_.chance(0.8) ? 1 : random_.uniform(-0.5, 0.5)),
                turns ? random_.uniform(-1, 1) : 0};
    }
    return twist_;
  }

 private:
  Limits limits_;
  worlds::Random random_;
  double until_s_ = 0;
  Twist twist_;
};

class Hostile final : public Operator {
 public:
  Hostile(const Scenario& s, std::uint64_t seed) : limits_(limits_of(s)), random_(seed) {}

  Twist ask(const Sight& sight) override {
    if (sight.t_s >= until_s_) plot(sight.t_s);
    switch (plot_) {
      case Plot::steady: break;
      case Plot::zigzag: twist_.turning_radps = -twist_.turning_radps; break;
      case Plot::shake: twist_.forward_mps = -twist_.forward_mps; break;
      case Plot::noise: draw(); break;
      case Plot::beyond: twist_ = {random_.uniform(-2000, 2000), random_.uniform(-2000, 2000)}; break;
      case Plot::pirouette: twist_.forward_mps = random_.chance(0.5) ? 0 : twist_.forward_mps; break;
    }
    return twist_;
  }
  double pause_s() override { return random_.uniform(shortest_s_, longest_s_); }

 private:
  enum class Plot { steady, zigzag, shake, noise, beyond, pirouette };

  void draw() {
    const double forward[] = {1, 1, 1, 0.5, 0.05, 0.003, -1, random_.uniform(-1.5, 1.5)};
    twist_.forward_mps = limits_.speed_mps * forward[random_.index(8)];
    twist_.turning_radps = random_.chance(0.4) ? 0 : limits_.turn_radps * random_.uniform(-1.2, 1.2);
    if (random_.chance(0.3)) twist_.turning_radps *= 0.2;
  }
  void plot(double t_s) {
    until_s_ = t_s + random_.uniform(0.02, random_.chance(0.3) ? 6 : 1.5);
    plot_ = static_cast<Plot>(random_.chance(0.5) ? 0 : random_.index(6));
    draw();
    shortest_s_ = random_.uniform(0.001, 0.05);
    longest_s_ = shortest_s_ + (random_.chance(0.2) ? random_.uniform(0, 0.6) : random_.uniform(0, 0.05));
  }

  Limits limits_;
  worlds::Random random_;
  Plot plot_ = Plot::steady;
  double until_s_ = 0;
  double shortest_s_ = 0.02, longest_s_ = 0.02;
  Twist twist_;
};

/// A bow to one side whose height is a share of the distance.
std::vector<sim::Vec2> bow(const Scenario& s, worlds::Random& random) {
  const double height = random.uniform(-0.25, 0.25);
  const sim::Vec2 way = s.goal.at - s.start.at, side{-way.y, way.x};
  const int steps = static_cast<int>(std::hypot(way.x, way.y) * 100) + 1;
  std::vector<sim::Vec2> path;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    path.push_back(s.start.at + way * t + side * (height * 4 * t * (1 - t)));
  }
  return path;
}

}  // namespace

const char* name(Hand hand) {
  switch (hand) {
    case Hand::perfect: return "perfect";
    case Hand::sloppy: return "sloppy";
    case Hand::blind: return "blind";
    case Hand::joystick: return "joystick";
    case Hand::hostile: return "hostile";
  }
  return "?";
}

std::optional<Hand> hand_named(std::string_view text) {
  for (const Hand hand : kHands) {
    if (text == name(hand)) return hand;
  }
  return std::nullopt;
}

std::unique_ptr<Operator> make_operator(Hand hand, const Scenario& s, std::uint64_t seed) {
  worlds::Random random(seed);
  const double radius = s.robot.body.radius.raw() * 1e-6;
  switch (hand) {
    case Hand::perfect:
    case Hand::sloppy: {
      auto path = path_with_margin(s, hand == Hand::perfect ? kPerfectMargin_m : kSloppyMargin_m);
      if (!path) return nullptr;
      if (hand == Hand::perfect) {
        return std::make_unique<PathFollower>(std::move(*path), radius, limits_of(s));
      }
      return std::make_unique<Sloppy>(std::move(*path), s, random.bits());
    }
    case Hand::blind: return std::make_unique<PathFollower>(bow(s, random), radius, limits_of(s));
    case Hand::joystick: return std::make_unique<Joystick>(s, random.bits());
    case Hand::hostile: return std::make_unique<Hostile>(s, random.bits());
  }
  return nullptr;
}

}  // namespace whisker::guard
