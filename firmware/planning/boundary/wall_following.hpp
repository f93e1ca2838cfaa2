/// Wall following by the side beam.
#pragma once

#include "firmware/params.hpp"
#include "firmware/perception/echo.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {

/// Keeps the wall at 0.15 m from the centre of a body of 0.09 m, in proportion for others, or drives in the
/// middle of a narrower passage.
///
/// The side beam gives the wall's distance: along a straight wall its nearest echo comes from the cone's
/// outer rim, so w = range x sin(side angle + cone / 2), plus the distance of the apex from the axis. An
/// obstacle ahead nearer than 0.30 m turns the body away. Where the wall ends, it drives an arc of 0.18 m
/// around the end.
Twist along_edge(const perception::Echoes& sight, Side wall, const Params& params) noexcept;

}  // namespace whisker::planning
