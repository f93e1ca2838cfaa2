/// A hostile planner: whatever it requests, the guard must prevent contact with static obstacles.
#pragma once

#include <cstdint>

#include "firmware/planning/planner.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::test {

/// Requests every kind of manoeuvre: for one tick, or for up to 150, repeated each tick or continued with
/// ManoeuvreKind::keep.
class Adversary final : public planning::Planner {
 public:
  /// Its speeds and lengths are in proportion to the robot's.
  explicit Adversary(std::uint64_t seed, const Params& robot = {});
  void set_goal(const planning::Goal&) noexcept override {}
  void move_goal(Vec) noexcept override {}
  void cancel() noexcept override {}
  planning::Decision step(const planning::View& view) noexcept override;

 private:
  /// Its next cruise.
  enum class Plot { steady, nearest, zigzag, shake, noise, survey };

  /// A speed of the reference robot, for this one.
  Speed speed(std::int64_t um_per_s) const {
    return Speed::from_raw(static_cast<std::int32_t>(um_per_s * full_speed_.raw() / 300000));
  }
  Speed draw(int mm_per_s) { return speed((random_.index(2 * mm_per_s + 1) - mm_per_s) * 1000); }
  Angle draw_angle() { return Angle::from_raw(static_cast<std::uint32_t>(random_.bits())); }
  void plot(const planning::View& view);
  void change_cruise(const planning::View& view);

  worlds::Random random_;
  const Speed full_speed_;
  const Length radius_;
  const Speed survey_;  // of the rims
  const int survey_ticks_;
  planning::Manoeuvre wish_;
  Plot plot_ = Plot::steady;
  int rest_ = 0;         // ticks until the next choice
  bool keeps_ = false;   // requests once, then keeps
  bool fickle_ = false;  // chooses anew every tick
};

}  // namespace whisker::test
