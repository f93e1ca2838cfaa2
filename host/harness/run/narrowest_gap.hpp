/// The gaps that the planners with a local grid take.
#pragma once

#include "firmware/params.hpp"

namespace whisker {

/// m; the planners take every gap at least this wide, as far as the grid is concerned: wherever the cells
/// lie, it leaves a path of the width that is planned. See docs/navigation.md.
double narrowest_gap_m(const Params& params);

}  // namespace whisker
