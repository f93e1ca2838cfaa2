/// Checks of shapes and positions that depend on several numbers; each throws at the offending key.
#pragma once

#include "host/scenario/reader.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker {

void check_bounds(const TableReader& table, const Bounds& bounds);
void check_polygon(const TableReader& table, const std::vector<sim::Vec2>& points);
void check_mover(const TableReader& table, const Mover& mover);
/// The start lies within the bounds, and nothing is in contact there.
void check_places(const TableReader& start, const Scenario& scenario);

}  // namespace whisker
