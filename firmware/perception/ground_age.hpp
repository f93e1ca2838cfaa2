/// How long clear ground counts as clear.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/params.hpp"

namespace whisker::perception {

/// Clear cells expire after one to two of these distances or turns, whichever comes first.
struct GroundAge {
  Length travel;
  Angle turn;
};

/// By BoundaryParams. If PoseErrorParams declare an error of the wheels, sooner where the heading becomes
/// uncertain sooner: while the ground ages, an error of the heading of two standard deviations moves it by at
/// most half a cell at the distance that the guard looks at. But never sooner than BoundaryParams may say:
/// above 1.8 % of each wheel, the ground of the reference robot moves farther.
GroundAge ground_age(const Params& params) noexcept;

}  // namespace whisker::perception
