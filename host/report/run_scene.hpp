/// The parts of a run picture that lie inside its frame.
#pragma once

#include <vector>

#include "host/report/axes.hpp"
#include "host/report/run_svg.hpp"
#include "host/report/svg.hpp"

namespace whisker::report {

/// What the frame must hold: the whole way, start and goal, and of the world what lies no farther from their
/// box than that box is long, or 4 m.
Box scene_box(const Scenario& scenario, const std::vector<TickRecord>& records);

/// Bounds, discs, polygons, walls; movers with their paths and where they are at `time_s`.
void draw_world(Svg& svg, const View& view, const Scenario& scenario, double time_s);

/// The straight line from the start to the goal.
void draw_straight_way(Svg& svg, const View& view, const Scenario& scenario);

/// The goal with its tolerance circle.
void draw_goal(Svg& svg, const View& view, const Goal& goal);

/// The path, one element per class that was driven.
void draw_path(Svg& svg, const View& view, const std::vector<TickRecord>& records, double tolerance_m);

/// A dot wherever it looked; dots nearer than a pixel or two are one.
void draw_looks(Svg& svg, const View& view, const std::vector<TickRecord>& records);

/// The records at which the danger area was entered, at most `count` of them, none twice at one place.
std::vector<const TickRecord*> danger_entries(const std::vector<TickRecord>& records, int count);

/// What the three beams measured at this tick: a sector as long as the reading, none for a lost one.
void draw_cones(Svg& svg, const View& view, const RangefinderParams& sensor, const TickRecord& record);

/// The body's outline with a tick ahead; a ring helps the eye where the outline is only a few pixels.
void draw_body(Svg& svg, const View& view, double radius_m, const sim::Pose& pose, const char* group);

/// The cross on the body that marks a contact.
void draw_contact(Svg& svg, const View& view, double radius_m, const sim::Pose& pose);

/// "start", "goal", "end" or "contact" beside the places; words that would lie on each other are left out.
void draw_labels(Svg& svg, const View& view, const Scenario& scenario, const TickRecord* end,
                 Verdict verdict);

}  // namespace whisker::report
