/// From the ground near the body to the inputs of the response table, for all that drives.
#pragma once

#include "firmware/fuzzy/variables.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"

namespace whisker::planning {

/// The table sees so far, in radii of the body.
constexpr int32_t kSight = 10;

/// D: ten times the distance to the nearest thing, as a share of ten radii of the body, so that D counts
/// radii. It is `nearest`, what a beam shows now, or a suspect cell of the local grid that is not behind. R:
/// eight times the way to the right less that to the left of the course, as the same share, each to at most
/// four radii.
fuzzy::Inputs ground_inputs(Length nearest, const perception::LocalGrid& grid, Vec at, Angle course,
                            const Params& params) noexcept;

/// For a command that shall be changed only where it meets something: D and R of the ways along the heading,
/// as shares of the body's diameter.
fuzzy::Inputs near_inputs(const perception::LocalGrid& grid, const Pose& pose, const Params& params) noexcept;

}  // namespace whisker::planning
