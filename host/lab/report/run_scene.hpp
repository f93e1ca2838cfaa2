/// The parts of a run picture inside its frame.
#pragma once

#include <vector>

#include "host/lab/report/axes.hpp"
#include "host/lab/report/run_svg.hpp"
#include "host/lab/report/svg.hpp"

namespace whisker::report {

/// The extent of the frame: the whole path, start and goal, and of the world everything no farther from their
/// box than the length of that box, or 4 m.
Box scene_box(const Scenario& scenario, const std::vector<TickRecord>& records);

/// Bounds, discs, polygons, walls; movers with their paths and their positions at `time_s`.
void draw_world(Svg& svg, const View& view, const Scenario& scenario, double time_s);

/// The straight line from the start to the goal.
void draw_straight_way(Svg& svg, const View& view, const Scenario& scenario);

/// The goal with its tolerance circle.
void draw_goal(Svg& svg, const View& view, const Goal& goal);

/// The path, one element per class.
void draw_path(Svg& svg, const View& view, const std::vector<TickRecord>& records, double tolerance_m);

/// A dot at every static scan; dots within a pixel or two are merged.
void draw_looks(Svg& svg, const View& view, const std::vector<TickRecord>& records);

/// The records that enter the danger area, at most `count`, at different places.
std::vector<const TickRecord*> danger_entries(const std::vector<TickRecord>& records, int count);

/// The ranges of the three beams at this tick: a sector as long as the reading, none for a lost one.
void draw_cones(Svg& svg, const View& view, const RangefinderParams& sensor, const TickRecord& record);

/// The outline of the body with a mark ahead, and a ring if the outline is only a few pixels.
void draw_body(Svg& svg, const View& view, double radius_m, const sim::Pose& pose, const char* group);

/// The cross on the body that marks a contact.
void draw_contact(Svg& svg, const View& view, double radius_m, const sim::Pose& pose);

/// "start", "goal", "end" or "contact" beside the places; overlapping labels are omitted.
void draw_labels(Svg& svg, const View& view, const Scenario& scenario, const TickRecord* end,
                 Verdict verdict);

}  // namespace whisker::report
