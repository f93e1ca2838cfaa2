#include "firmware/perception/contradiction.hpp"

#include "firmware/math/trig.hpp"

namespace whisker::perception {
namespace {

constexpr Duration kCompared = 600_ms;
constexpr Angle kSameAxis = 5_deg;
constexpr Length kNearer = 25_mm;  // more than noise and the edge of a wall

}  // namespace

bool Contradiction::approaches(const ConeObservation& echo) noexcept {
  const bool comparable =
      any_ && echo.taken - since_ <= kCompared && magnitude(echo.beam.axis - axis_) <= kSameAxis.raw();
  if (comparable) return distance_ - echo.free > norm(echo.beam.apex - apex_) + kNearer;
  any_ = true;
  apex_ = echo.beam.apex;
  axis_ = echo.beam.axis;
  distance_ = echo.free;
  since_ = echo.taken;
  return false;
}

}  // namespace whisker::perception
