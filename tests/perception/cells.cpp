#include "tests/perception/cells.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::test {

Square square(int column, int row, double cell_m, double slack) {
  return {{column * cell_m + slack, row * cell_m + slack},
          {(column + 1) * cell_m - slack, (row + 1) * cell_m - slack}};
}

bool touches(const Square& s, const sim::Disc& disc) {
  if (s.max.x < s.min.x || s.max.y < s.min.y) return false;
  const double dx = disc.center.x - std::clamp(disc.center.x, s.min.x, s.max.x);
  const double dy = disc.center.y - std::clamp(disc.center.y, s.min.y, s.max.y);
  return dx * dx + dy * dy <= disc.radius * disc.radius;
}

bool touches(const Square& s, const sim::Segment& segment) {
  if (s.max.x < s.min.x || s.max.y < s.min.y) return false;
  double low = 0;
  double high = 1;
  const auto cut = [&](double from, double way, double min, double max) {
    if (way == 0) return min <= from && from <= max;
    const double a = (min - from) / way;
    const double b = (max - from) / way;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
    return low <= high;
  };
  return cut(segment.a.x, segment.b.x - segment.a.x, s.min.x, s.max.x) &&
         cut(segment.a.y, segment.b.y - segment.a.y, s.min.y, s.max.y);
}

sim::Vec2 Shift::operator()(sim::Vec2 p) const {
  const sim::Vec2 d = p - truth.at;
  const double turn = believed.heading - truth.heading;
  return believed.at +
         sim::Vec2{d.x * std::cos(turn) - d.y * std::sin(turn), d.x * std::sin(turn) + d.y * std::cos(turn)};
}

bool occupied(const Square& s, const sim::WorldView& world, const Shift& shift) {
  for (size_t i = 0; i < world.disc_count; ++i) {
    if (touches(s, sim::Disc{shift(world.discs[i].center), world.discs[i].radius})) return true;
  }
  for (size_t i = 0; i < world.segment_count; ++i) {
    if (touches(s, sim::Segment{shift(world.segments[i].a), shift(world.segments[i].b)})) return true;
  }
  return false;
}

}  // namespace whisker::test
