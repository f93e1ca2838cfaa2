/// A hostile planner: whatever it requests, the guard must prevent contact with static obstacles.
#pragma once

#include <cstdint>

#include "firmware/planning/planner.hpp"
#include "host/scenario/scenario.hpp"
#include "host/worlds/random.hpp"

namespace whisker::test {

/// Requests every kind of manoeuvre: for one tick, or for up to 150, repeated each tick or continued with
/// ManoeuvreKind::keep.
class Adversary final : public planning::Planner {
 public:
  explicit Adversary(std::uint64_t seed) : random_(seed) {}
  void set_goal(const planning::Goal&) noexcept override {}
  void move_goal(Vec) noexcept override {}
  void cancel() noexcept override {}
  planning::Decision step(const planning::View& view) noexcept override;

 private:
  /// Its next cruise.
  enum class Plot { steady, nearest, zigzag, shake, noise, survey };

  Speed draw(int mm_per_s) { return Speed::from_raw((random_.index(2 * mm_per_s + 1) - mm_per_s) * 1000); }
  Angle draw_angle() { return Angle::from_raw(static_cast<std::uint32_t>(random_.bits())); }
  void plot(const planning::View& view);
  void change_cruise(const planning::View& view);

  worlds::Random random_;
  planning::Manoeuvre wish_;
  Plot plot_ = Plot::steady;
  int rest_ = 0;         // ticks until the next choice
  bool keeps_ = false;   // requests once, then keeps
  bool fickle_ = false;  // chooses anew every tick
};

/// A world of any class of scripts/bars, with the body placed among the obstacles.
Scenario thick_of_it(worlds::Random& random, bool noise);

}  // namespace whisker::test
