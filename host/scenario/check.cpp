#include "host/scenario/check.hpp"

#include <fmt/format.h>

#include "host/scenario/contact.hpp"
#include "host/scenario/shapes.hpp"

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

void check_places(const TableReader& start, const Scenario& s) {
  if (s.bounds && !is_within(s.start.at, *s.bounds)) start.fail("the start lies outside the bounds");
  const std::string fault = start_fault(s);
  if (!fault.empty()) start.fail(fault);
}

}  // namespace whisker
