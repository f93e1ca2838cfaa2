#include "host/lab/hunt/attacker.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/bearing.hpp"
#include "host/lab/hunt/geometry.hpp"

namespace whisker::hunt {
namespace {

constexpr int kPlots = 11;
/// A command that is recorded a little earlier than its tick comes at that tick however times are rounded.
constexpr double kEarlier_s = 0.0005;

double wrapped(double angle) { return std::remainder(angle, 2 * sim::kPi); }

}  // namespace

Attacker::Attacker(const Scenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      dice_(seed),
      radius_m_(scenario.robot.body.radius.raw() * 1e-6),
      speed_mps_(scenario.robot.wheels.max_speed.raw() * 1e-6),
      turn_radps_(scenario.robot.wheels.max_turn_rate.raw() * 1e-6),
      survey_radps_(turn_rate(scenario.robot).raw() * 1e-6) {}

guard::Twist Attacker::ask(const guard::Sight& sight) {
  if (sight.t_s >= until_s_) plot(sight.t_s);
  act(sight);
  commands_.push_back({std::max(0.0, sight.t_s - kEarlier_s), twist_});
  return twist_;
}

void Attacker::plot(double t_s) {
  const bool begins = t_s == 0 && dice_.chance(0.6);
  plot_ = begins || dice_.chance(0.15) ? Plot::survey : static_cast<Plot>(dice_.index(kPlots));
  // A whole turn and more, or a part of one.
  const double turn_s = 7 / survey_radps_;
  until_s_ = t_s + (plot_ == Plot::survey ? std::min(15.0, turn_s * dice_.log_uniform(0.2, 2))
                                          : dice_.log_uniform(0.02, 3));
  pause_s_ = dice_.chance(0.1) ? dice_.log_uniform(0.05, 0.6) : dice_.log_uniform(0.005, 0.1);
  draw();
  if (plot_ == Plot::creep) {
    until_s_ = t_s + dice_.uniform(5, 30);
    creep_mps_ = dice_.log_uniform(1e-5, 5e-3);
  }
}

void Attacker::draw() {
  const double forward[] = {1, 1, 1, 0.5, 0.05, 0.003, -1, dice_.uniform(-1.5, 1.5)};
  twist_.forward_mps = speed_mps_ * forward[dice_.index(8)];
  twist_.turning_radps = dice_.chance(0.4) ? 0 : turn_radps_ * dice_.uniform(-1.2, 1.2);
  if (dice_.chance(0.3)) twist_.turning_radps *= 0.2;
}

void Attacker::steer(const sim::Pose& pose, sim::Vec2 way, double speed_mps) {
  const double off = wrapped(bearing({}, way) - pose.heading);
  twist_.turning_radps = std::clamp(off * 10, -turn_radps_, turn_radps_);
  twist_.forward_mps = std::fabs(off) < 0.5 ? speed_mps : 0;
}

void Attacker::act(const guard::Sight& sight) {
  const bool hunts =
      plot_ == Plot::charge || plot_ == Plot::graze || plot_ == Plot::ambush || plot_ == Plot::creep;
  const Near near = hunts ? nearest(scenario_, sight.pose.at) : Near{0, {}};
  const sim::Vec2 way = hunts && std::isfinite(near.distance_m) ? near.at - sight.pose.at : sim::Vec2{1, 0};
  switch (plot_) {
    case Plot::survey: twist_ = {0, std::copysign(survey_radps_ * 0.9, twist_.turning_radps)}; break;
    case Plot::steady: break;
    case Plot::charge: steer(sight.pose, way, speed_mps_); break;
    case Plot::creep: steer(sight.pose, way, creep_mps_); break;
    case Plot::graze: steer(sight.pose, {way.y + way.x * 0.3, way.y * 0.3 - way.x}, speed_mps_); break;
    case Plot::spin: twist_ = {0, std::copysign(turn_radps_, twist_.turning_radps)}; break;
    case Plot::zigzag: twist_.turning_radps = -twist_.turning_radps; break;
    case Plot::reverse: twist_.forward_mps = -twist_.forward_mps; break;
    case Plot::noise: draw(); break;
    case Plot::beyond: twist_ = {dice_.uniform(-2000, 2000), dice_.uniform(-2000, 2000)}; break;
    // Full speed until an obstacle is a third of a radius away, then the hardest turn.
    case Plot::ambush:
      steer(sight.pose, way, speed_mps_);
      if (near.distance_m < radius_m_ * 1.3)
        twist_ = {speed_mps_, dice_.chance(0.5) ? turn_radps_ : -turn_radps_};
      break;
  }
}

}  // namespace whisker::hunt
