#include "host/harness/scenario/check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "firmware/planning/goal_planner.hpp"
#include "host/harness/scenario/contact.hpp"
#include "host/harness/scenario/shapes.hpp"

namespace whisker {

void check_bounds(const TableReader& table, const Bounds& b) {
  if (is_sound(b)) return;
  table.fail_at("max", "'max' must be greater than 'min' in x and in y");
}

void check_polygon(const TableReader& table, const std::vector<sim::Vec2>& points) {
  const bool flat = !has_area(points);
  // A bow tie with equal halves has no area, but it must be reported as self-intersecting.
  const auto crossing = flat ? passing_edges(points) : crossing_edges(points);
  if (crossing) {
    table.fail_at("points", fmt::format("the polygon intersects itself: edges {} and {}", crossing->first + 1,
                                        crossing->second + 1));
  }
  if (flat) table.fail_at("points", "the polygon has no area");
}

void check_mover(const TableReader& table, const Mover& mover) {
  if (is_on_path(mover)) return;
  table.fail_at("center",
                fmt::format("'center' must lie on the mover's path, but is {:.4f} m off", off_path(mover)));
}

void check_start(const TableReader& start, const Scenario& s) {
  const std::string fault = start_fault(s);
  if (!fault.empty()) start.fail(fault);
}

std::string tolerance_fault(const Scenario& s) {
  const std::int32_t least_um = planning::smallest_tolerance(s.robot).raw();
  if (std::lround(s.goal.tolerance_m * 1e6) >= least_um) return "";
  return fmt::format("'tolerance_m' must be at least {:.6f} m, the smallest that this robot keeps, but is {}",
                     least_um * 1e-6, s.goal.tolerance_m);
}

void check_goal(const TableReader& goal, const Scenario& s) {
  const std::string fault = tolerance_fault(s);
  if (!fault.empty()) goal.fail_at("tolerance_m", fault);
}

}  // namespace whisker
