/// Estimates the scatter of a rangefinder's readings.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/perception/range_conditioner.hpp"

namespace whisker::perception {

/// One beam. Tracks the median distance of a measurement from the line through its neighbours in time, times
/// two. A steady approach does not change it, nor does one outlier in thirty. For normal noise of standard
/// deviation sigma, it is 1.65 sigma.
class RangeScatter {
 public:
  /// Call once per fresh reading.
  void add(const RecentReadings& sight) noexcept;
  /// The allowance before a nearest-of-four that does not count as empty: 1.24 sigma. Rounding to a
  /// millimetre does not count as scatter.
  Length allowance() const noexcept { return bend_ <= kRounding ? Length{} : bend_ * 3 / 4; }

 private:
  static constexpr Length kRounding = 2_mm;
  static constexpr Length kMost = 50_mm;
  static constexpr Length kStep = micrometres(250);
  static constexpr Length kDoubted = 16_mm;  // initial value: 1 cm of noise

  Length bend_ = kDoubted;
};

}  // namespace whisker::perception
