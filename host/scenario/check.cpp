#include "host/scenario/check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/scenario/contact.hpp"
#include "host/scenario/shapes.hpp"

namespace whisker {
namespace {

constexpr double kSmallestArea = 1e-9;  // m^2
constexpr double kOffPath = 1e-3;       // m: what rounding a coordinate by hand may cost

bool within(sim::Vec2 p, const Bounds& b) {
  return b.min.x <= p.x && p.x <= b.max.x && b.min.y <= p.y && p.y <= b.max.y;
}

}  // namespace

void check_bounds(const TableReader& table, const Bounds& b) {
  if (b.min.x < b.max.x && b.min.y < b.max.y) return;
  table.fail_at("max", "'max' must be greater than 'min' in x and in y");
}

void check_polygon(const TableReader& table, const std::vector<sim::Vec2>& points) {
  if (std::fabs(signed_area(points)) < kSmallestArea) table.fail_at("points", "the polygon has no area");
  if (const auto crossing = crossing_edges(points)) {
    table.fail_at("points", fmt::format("the polygon intersects itself: edges {} and {}", crossing->first + 1,
                                        crossing->second + 1));
  }
}

void check_mover(const TableReader& table, const Mover& mover) {
  const double off = distance(mover.center, mover.path);
  if (off <= kOffPath) return;
  table.fail_at("center", fmt::format("'center' must lie on the mover's path, but is {:.4f} m off", off));
}

void check_places(const TableReader& start, const Scenario& s) {
  if (s.bounds && !within(s.start.at, *s.bounds)) start.fail("the start lies outside the bounds");
  const std::string fault = start_fault(s);
  if (!fault.empty()) start.fail(fault);
}

}  // namespace whisker
