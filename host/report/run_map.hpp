/// The map of a planner in a run picture: its cells, its plan, and where it led.
#pragma once

#include <vector>

#include "host/report/axes.hpp"
#include "host/report/hand_overs.hpp"
#include "host/report/svg.hpp"
#include "host/run/map_picture.hpp"

namespace whisker::report {

/// Cells, window and the plan's way, as the robot at this record believes them to lie.
void draw_map(Svg& svg, const View& view, const MapPicture& map, const TickRecord& believer);

/// The places that the map led to, each once.
void draw_way_points(Svg& svg, const View& view, const std::vector<TickRecord>& records);

/// A ring where the map handed over to the edges, and one where it took over again.
void draw_hand_overs(Svg& svg, const View& view, const std::vector<HandOver>& all);

void draw_to_edges(Svg& svg, Point at);
void draw_to_map(Svg& svg, Point at);

}  // namespace whisker::report
