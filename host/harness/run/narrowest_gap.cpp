#include "host/harness/run/narrowest_gap.hpp"

#include <cmath>

#include "firmware/params/reach.hpp"

namespace whisker {

double narrowest_gap_m(const Params& params) {
  // On each side, an obstacle takes the cell that holds its edge, at most a diagonal, and the band of one
  // cell behind an echo.
  const double cell = grid_cell(params).raw() * 1e-6;
  const double beside = reach(params).planning.raw() * 1e-6 + cell * (std::sqrt(2.0) + 1);
  return 2 * beside;
}

}  // namespace whisker
