/// A hostile operator who knows the true world.
#pragma once

#include <vector>

#include "host/harness/scenario/scenario.hpp"
#include "host/lab/guard/operator.hpp"
#include "host/lab/guard/recorded.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

/// Surveys the ground so that the guard grants something, charges or creeps at the nearest obstacle, grazes
/// it, spins and reverses beside it, and gives commands of every size at every rate. It records what it
/// commanded.
class Attacker final : public guard::Operator {
 public:
  /// The scenario must outlive it.
  Attacker(const Scenario& scenario, std::uint64_t seed);
  guard::Twist ask(const guard::Sight& sight) override;
  double pause_s() override { return pause_s_; }
  const std::vector<guard::Command>& commands() const { return commands_; }

 private:
  enum class Plot { survey, steady, charge, graze, spin, zigzag, reverse, noise, beyond, ambush, creep };

  void plot(double t_s);
  void draw();
  /// Turns towards this direction in the world and drives.
  void steer(const sim::Pose& pose, sim::Vec2 way, double speed_mps);
  void act(const guard::Sight& sight);

  const Scenario& scenario_;
  Dice dice_;
  double radius_m_, speed_mps_, turn_radps_, survey_radps_;
  Plot plot_ = Plot::steady;
  double until_s_ = 0;
  double creep_mps_ = 0;
  double pause_s_ = 0.02;
  guard::Twist twist_;
  std::vector<guard::Command> commands_;
};

}  // namespace whisker::hunt
