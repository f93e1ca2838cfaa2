/// Marks hit and leave points in pictures and their legend.
#pragma once

#include <vector>

#include "host/lab/report/axes.hpp"
#include "host/lab/report/encounters.hpp"
#include "host/lab/report/svg.hpp"

namespace whisker::report {

void draw_hit(Svg& svg, Point at);
void draw_turned(Svg& svg, Point at);
void draw_left(Svg& svg, Point at);
void draw_wall_lost(Svg& svg, Point at);

/// All marks: hit and leave points with the number of their encounter, from 1. If the robot found the goal
/// unreachable, the robot itself is the mark.
void draw_encounters(Svg& svg, const View& view, const std::vector<Encounter>& all);

}  // namespace whisker::report
