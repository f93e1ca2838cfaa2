/// Checks of shapes and positions that depend on several numbers; each throws at the offending key.
#pragma once

#include <string>
#include <vector>

#include "host/harness/scenario/reader.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker {

void check_bounds(const TableReader& table, const Bounds& bounds);
void check_polygon(const TableReader& table, const std::vector<sim::Vec2>& points);
void check_mover(const TableReader& table, const Mover& mover);
/// Nothing is in contact at the start.
void check_start(const TableReader& start, const Scenario& scenario);
void check_goal(const TableReader& goal, const Scenario& scenario);
/// Why this robot cannot keep the goal's tolerance; "" if it can.
std::string tolerance_fault(const Scenario& scenario);

}  // namespace whisker
