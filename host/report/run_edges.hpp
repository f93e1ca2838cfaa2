/// Marks where the robot met an obstacle's edge and where it left it, in pictures and their legend.
#pragma once

#include <vector>

#include "host/report/axes.hpp"
#include "host/report/encounters.hpp"
#include "host/report/svg.hpp"

namespace whisker::report {

void draw_hit(Svg& svg, Point at);
void draw_turned(Svg& svg, Point at);
void draw_left(Svg& svg, Point at);
void draw_wall_lost(Svg& svg, Point at);

/// All marks, hits and leaves with the number of their encounter, from 1. Where it found the goal unreachable
/// stands the robot itself.
void draw_encounters(Svg& svg, const View& view, const std::vector<Encounter>& all);

}  // namespace whisker::report
