/// How much a rangefinder's readings scatter, learned from them.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/perception/range_conditioner.hpp"

namespace whisker::perception {

/// One beam. Follows the median of how far a measurement lies off the line through its neighbours in time,
/// twice: a steady approach does not move it, nor does one outlier in thirty. In normal noise of standard
/// deviation sigma that is 1.65 sigma.
class RangeScatter {
 public:
  /// Once for each fresh sight.
  void add(const RecentReadings& sight) noexcept;
  /// How much of a nearest-of-four is not proved to be empty: 1.24 sigma. Rounding to a millimetre is no
  /// scatter.
  Length allowance() const noexcept { return bend_ <= kRounding ? Length{} : bend_ * 3 / 4; }

 private:
  static constexpr Length kRounding = 2_mm;
  static constexpr Length kMost = 50_mm;
  static constexpr Length kStep = micrometres(250);
  static constexpr Length kDoubted = 16_mm;  // until it is known: 1 cm of noise

  Length bend_ = kDoubted;
};

}  // namespace whisker::perception
