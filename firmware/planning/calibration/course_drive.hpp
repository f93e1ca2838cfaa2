/// A straight drive of a given length under the guard.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Where the guard cuts the drive because ground ahead is unknown, the body turns to both sides, so that the
/// beams clear it, and drives the rest.
class CourseDrive {
 public:
  enum class Result : uint8_t { driving, done, blocked };

  /// From this place along this course; the body faces it.
  void begin(Vec from, Angle course, Length length) noexcept;
  /// Once per tick, after begin(). blocked: four times in a row, looking around did not help.
  Result step(const View& view, Manoeuvre& manoeuvre) noexcept;

 private:
  Vec from_;
  Angle course_;
  Length length_;
  Length last_;       // way at the last look
  uint8_t turn_ = 0;  // of the look: 0 none, then left, right, ahead
  uint8_t looks_ = 0;
  bool drives_ = false;
};

}  // namespace whisker::planning
