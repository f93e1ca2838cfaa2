/// Turns on the spot and compares the last turn's profile of the surroundings with the first one's.
#pragma once

#include <stdint.h>

#include "firmware/planning/arrows.hpp"
#include "firmware/planning/calibration/calibration_planner.hpp"
#include "firmware/planning/calibration/profile_match.hpp"
#include "firmware/planning/calibration/range_profile.hpp"

namespace whisker::planning {

/// Where the last turn sees what the first one saw, the body has turned by whole turns, whatever the gyro and
/// the wheels say. With a gyro that gives its scale and the track; without one, the track. It turns to the
/// left, with all beams, for about kTurns and a half, then stands and searches the match for about two
/// seconds.
///
/// Any goal starts it. Outcome::reached: values() are valid; Outcome::gave_up: see trouble(). About 10 KB.
class SpinPlanner final : public CalibrationPlanner {
 public:
  /// Of the profiles, from the first to the last.
  static constexpr int kTurns = 3;

  /// Must outlive it.
  explicit SpinPlanner(const Params& params) noexcept : params_(params), match_(first_, last_) {}

  /// The gyro turned the pose.
  bool by_gyro() const noexcept { return by_gyro_; }
  const RangeProfile& first() const noexcept { return first_; }
  const RangeProfile& last() const noexcept { return last_; }
  const ProfileMatch& match() const noexcept { return match_; }
  /// The rate of the spin.
  AngularRate rate() const noexcept;

 protected:
  void start(const View& view) noexcept override;
  void advance(const View& view) noexcept override;

 private:
  enum class Phase : uint8_t { resting, running_up, spinning, stopping, matching };
  static constexpr Arrow<Phase> kArrows[] = {
      {Phase::resting, Phase::running_up},
      {Phase::running_up, Phase::spinning},
      {Phase::spinning, Phase::stopping},
      {Phase::stopping, Phase::matching},
  };
  struct Past {
    int32_t ms;
    int32_t heading;  // 1/256 unit of a profile
  };
  static constexpr int32_t kPasts = 64;

  void follow(const View& view) noexcept;
  void sample(const hal::RangeReadings& ranges) noexcept;
  bool heading_at(int32_t ms, int32_t& heading) const noexcept;
  void watch(const View& view) noexcept;
  void conclude() noexcept;
  Ratio heading_sigma(Duration over) const noexcept;

  const Params& params_;
  RangeProfile first_;
  RangeProfile last_;
  ProfileMatch match_;
  Past past_[kPasts] = {};
  uint8_t sequence_[hal::kBeams] = {};
  Phase phase_ = Phase::resting;
  bool by_gyro_ = false;
  Vec place_;
  Angle heading_;
  int64_t turned_ = 0;  // 2^-32 turn, since the run-up
  int32_t counts_ = 0;  // right minus left, over the same time
  int32_t pasts_ = 0;
  int32_t ms_ = 0;
  int32_t phase_ms_ = 0;
  int32_t held_ms_ = 0;
  int32_t spun_ms_ = 0;
};

}  // namespace whisker::planning
