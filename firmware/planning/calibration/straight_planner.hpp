/// Drives straight ahead and, if wanted, back: compares the wheels with the gyro, and measures the way.
#pragma once

#include <stdint.h>

#include "firmware/planning/arrows.hpp"
#include "firmware/planning/calibration/calibration_planner.hpp"
#include "firmware/planning/calibration/course_drive.hpp"

namespace whisker::planning {

/// On each way, from rest to rest, the difference of the counts that does not turn the body is the wheels'.
/// Without a gyro, or one way, it serves the tape: a person measures the way, and way() is what the robot
/// believes.
///
/// Any goal starts it; the ground must be free. Outcome::reached: values() and way() are valid;
/// Outcome::gave_up: see trouble().
class StraightPlanner final : public CalibrationPlanner {
 public:
  enum class Way : uint8_t { there, there_and_back };
  static constexpr Length kShortest = 500_mm;
  /// The parameters must outlive it. length: kShortest at least.
  StraightPlanner(const Params& params, Length length, Way way) noexcept
      : params_(params), length_(length), legs_(way == Way::there ? 1 : 2) {}
  /// Of the next drive.
  void set_course(Length length, Way way) noexcept {
    length_ = length;
    legs_ = way == Way::there ? 1 : 2;
  }

  /// Along the first way, by the wheels.
  Length way() const noexcept { return way_; }

 protected:
  void start(const View& view) noexcept override;
  void advance(const View& view) noexcept override;

 private:
  enum class Phase : uint8_t { resting, driving, turning };
  static constexpr Arrow<Phase> kArrows[] = {
      {Phase::resting, Phase::driving},
      {Phase::driving, Phase::turning},
      {Phase::turning, Phase::resting},
  };
  /// Of the skew, 1e-7, on a sixth of a way each: how much the floor changes it.
  struct Parts {
    int32_t turned = 0;
    int32_t difference = 0;
    int32_t sum = 0;
    int64_t total = 0;
    uint64_t squares = 0;
    int32_t count = 0;
  };
  static constexpr int32_t kPartsOfAWay = 6;

  void add(const View& view) noexcept;
  void end_of_part() noexcept;
  int64_t turning(int32_t turned, int32_t difference) const noexcept;
  int32_t counts_of_way() const noexcept;
  void end_of_way(const View& view) noexcept;
  void conclude() noexcept;

  const Params& params_;
  Length length_;
  int32_t legs_;
  CourseDrive drive_;
  Phase phase_ = Phase::resting;
  int32_t leg_ = 0;
  Vec from_;
  Angle course_;
  Angle heading_;
  int32_t turned_ = 0;      // 2^-32 turn, on this way
  int32_t difference_ = 0;  // counts, right minus left, on this way
  int32_t sum_ = 0;         // counts of both, on this way
  int64_t turning_ = 0;     // of all ways, 1/256 count
  int64_t travel_ = 0;      // the same
  Parts parts_;
  Length way_;
  int32_t phase_ms_ = 0;
  bool by_gyro_ = false;
};

}  // namespace whisker::planning
