/// Drives a square and comes back to its start, for the test of Borenstein and Feng (UMBmark, 1996).
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/planning/calibration/calibration_planner.hpp"
#include "firmware/planning/calibration/course_drive.hpp"

namespace whisker::planning {

/// Four sides, each with a quarter turn after it. The robot believes that it is back at the end; a person
/// measures where it is. Squares to both sides tell unequal wheels from a wrong track
/// (host/lab/calibration/umbmark.hpp).
///
/// Any goal starts it; the ground must be free, a side to the left or to the right of the start and ahead.
/// Outcome::reached: it is back; Outcome::gave_up: see trouble().
class SquarePlanner final : public CalibrationPlanner {
 public:
  enum class Side : uint8_t { left, right };  ///< of the turns
  SquarePlanner(Length length, Side side) noexcept
      : length_(length), quarter_(side == Side::left ? 90_deg : -(90_deg)) {}

  /// By how much it believes to have missed its start, in the frame of the start: x ahead, y to the left.
  Vec missed() const noexcept { return missed_; }

 protected:
  void start(const View& view) noexcept override;
  void advance(const View& view) noexcept override;

 private:
  Length length_;
  Angle quarter_;
  Angle course_;
  Pose begin_;
  Vec missed_;
  int32_t rested_ms_ = 0;
  CourseDrive drive_;
  Vec corner_;        // where the next side begins, as it should be
  uint8_t step_ = 0;  // 0: rests; then a side, a turn, a side, ...
};

}  // namespace whisker::planning
