/// The map of a planner in a run picture: cells, plan and way points.
#pragma once

#include <vector>

#include "host/harness/run/map_picture.hpp"
#include "host/lab/report/axes.hpp"
#include "host/lab/report/encounters.hpp"
#include "host/lab/report/svg.hpp"

namespace whisker::report {

/// Cells, window and planned path, in the frame of the estimate at this record.
void draw_map(Svg& svg, const View& view, const MapPicture& map, const TickRecord& believer);

/// The way points, each once.
void draw_way_points(Svg& svg, const View& view, const std::vector<TickRecord>& records);

/// A ring where boundary following took over, and one where the map resumed.
void draw_hand_overs(Svg& svg, const View& view, const std::vector<HandOver>& all);

void draw_to_edges(Svg& svg, Point at);
void draw_to_map(Svg& svg, Point at);

}  // namespace whisker::report
