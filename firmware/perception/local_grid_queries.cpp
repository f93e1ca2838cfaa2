#include "firmware/perception/local_grid.hpp"

namespace whisker::perception {
namespace {

constexpr int32_t kWindow = kCells * kUnitsPerCell;

constexpr int32_t kRootOfTwo = 181;  // 2^-7
constexpr int32_t least(int32_t a, int32_t b) noexcept { return a < b ? a : b; }

/// Of a point in the first quadrant; up to 8 % too short.
constexpr int32_t distance_of(int32_t x, int32_t y) noexcept {
  const int32_t longer = x < y ? y : x;
  const int32_t diagonal = (x + y) * (kRootOfTwo / 2) / Q7::kOne;
  return longer < diagonal ? diagonal : longer;
}

/// Half the chord of a circle at this distance from its centre; zero outside.
int32_t chord(int32_t radius, int32_t beside) noexcept {
  const int32_t squared = (radius - beside) * (radius + beside);
  return squared > 0 ? static_cast<int32_t>(square_root_32(static_cast<uint32_t>(squared))) : 0;
}

/// Directions from the course; 2^-14: ahead, 30 and 60 degrees to the left, the same to the right.
constexpr int kWays = 5;
struct WayAhead {
  int32_t x, y;
};
constexpr WayAhead kWay[kWays] = {{16384, 0}, {14189, 8192}, {8192, 14189}, {14189, -8192}, {8192, -14189}};

}  // namespace

Length LocalGrid::length_of(int32_t units) const noexcept {
  return Length::from_raw(multiply_divide(units, scale_.cell_um, kUnitsPerCell));
}

bool LocalGrid::in_window(Point p, int32_t reach) noexcept {
  return p.x >= reach && p.y >= reach && p.x <= kWindow - reach && p.y <= kWindow - reach;
}

Obstacles LocalGrid::along(const Vec& from, Angle heading, Length length, Length radius,
                           int32_t enough) const noexcept {
  Obstacles found;
  const Point start = local(from);
  const Stadium stadium({start.x, start.y, heading, units(length), units(radius), abeam()});
  const Row box = to_torus(stadium.box());
  int32_t nearest = INT32_MAX;
  work_.add(kPathUnits);
  for (Rows rows = stadium.rows(); rows.more(); rows.next()) {
    const int s = slot(rows.row());
    const Row unclear = box & ~clear(s);
    if (unclear == 0) continue;
    work_.add(kPathRowUnits);
    const Row blocked = to_window(unclear) & stadium.columns(rows.row());
    const Row solid = blocked & solid_row(rows.row());
    found.suspect += bits(solid);
    if (found.suspect >= enough) break;
    const int32_t dy = rows.offset(start.y);
    int32_t dx = kHalfCell - start.x;
    for (Row open = blocked & ~solid; open != 0; open >>= 1, dx += kUnitsPerCell) {
      if ((open & 1U) == 0) continue;
      ++found.unknown;
      const int32_t squared = dx * dx + dy * dy;
      if (squared < nearest) {
        nearest = squared;
        found.nearest_unknown = {length_of(dx), length_of(dy)};
      }
    }
  }
  return found;
}

int32_t LocalGrid::suspects_along(const Vec& from, Angle heading, Length length, Length radius,
                                  int32_t enough) const noexcept {
  const Point start = local(from);
  const Stadium stadium({start.x, start.y, heading, units(length), units(radius), abeam()});
  const Row box = to_torus(stadium.box());
  int32_t found = 0;
  work_.add(kPathUnits);
  for (Rows rows = stadium.rows(); rows.more() && found < enough; rows.next()) {
    const int s = slot(rows.row());
    const Row solid = box & solid_at(s) & ~clear(s);
    if (solid == 0) continue;
    work_.add(kPathRowUnits);
    found += bits(to_window(solid) & stadium.columns(rows.row()));
  }
  return found;
}

Ways LocalGrid::ways(const Vec& from, Angle course, Length horizon, Length radius) const noexcept {
  const Point start = local(from);
  const int32_t most = units(horizon);
  const int32_t wide = units(radius);
  const int32_t aside = (wide + kCellCover) * 6 / 5;
  const int32_t c = q14(cos(course));
  const int32_t s = q14(sin(course));
  int32_t free[kWays] = {most, most, most, most, most};
  int32_t nearest = INT32_MAX;
  const Row box = Span::around(start.x, most + wide).columns();
  for (Rows rows(start.y, most + wide); rows.more(); rows.next()) {
    Row solid = box & solid_row(rows.row()) & to_window(~clear_row(rows.row()));
    const int32_t dy = rows.offset(start.y);
    for (int32_t dx = kHalfCell - start.x; solid != 0; solid >>= 1, dx += kUnitsPerCell) {
      if ((solid & 1U) == 0) continue;
      const int32_t x = (dx * c + dy * s) / Q14::kOne;
      const int32_t y = (dy * c - dx * s) / Q14::kOne;
      if (x >= 0) nearest = least(nearest, distance_of(x, y < 0 ? -y : y));
      // From there on, no way to the other side meets it: 1.2 is more than the secant of 30 degrees.
      const int first = y > aside ? 1 : y < -aside ? 3 : 0;
      const int end = y > aside ? 3 : kWays;
      for (int i = first; i < end; ++i) {
        const int32_t along = (x * kWay[i].x + y * kWay[i].y) / Q14::kOne;
        const int32_t across = (y * kWay[i].x - x * kWay[i].y) / Q14::kOne;
        const int32_t beside = across < 0 ? -across : across;
        if (along <= abeam() || beside >= wide + kCellCover || along >= free[i] + wide) continue;
        const int32_t rest = along - chord(wide, beside);
        free[i] = least(free[i], rest < 0 ? 0 : rest);
      }
    }
  }
  return {length_of(free[1] > free[2] ? free[1] : free[2]), length_of(free[0]),
          length_of(free[3] > free[4] ? free[3] : free[4]), nearest == INT32_MAX ? 60_m : length_of(nearest)};
}

bool LocalGrid::approaches(const Vec& from, const Vec& way, Length radius, Avoid avoid) const noexcept {
  if (!farther(way, kShortestStep - micrometres(1))) return false;
  work_.add(kWayUnits);
  const Point there = local(from + way);
  const int32_t reach = units(radius);
  // Beyond the window nothing is known.
  if (!in_window(there, reach + kHalfSquare)) return true;
  const int32_t widest = reach > body_ ? reach : body_;
  const Row box = to_torus(Span::around(there.x, widest).columns());
  for (Rows rows(there.y, reach + kHalfSquare); rows.more(); rows.next()) {
    const int s = slot(rows.row());
    Row unclear = box & ~clear(s);
    if (avoid == Avoid::suspect) unclear &= solid_at(s);
    if (unclear == 0) continue;
    Span any;
    any.touched_by_disc(there.x, rows.offset(there.y), widest);
    if ((any.columns() & to_window(unclear)) != 0) {
      return nears({from, way, reach, rows.row(), avoid}) && !(has_lane() && lane_.holds(from, way, radius));
    }
  }
  return false;
}

/// From this row on. Only now is it worth to know which cells lie ahead.
bool LocalGrid::nears(const Approach& to) const noexcept {
  const Length step = norm(to.way);
  const Point here = local(to.from);
  const Point there = local(to.from + to.way);
  const int32_t half = units(step / 2);
  const HalfPlane ahead = HalfPlane::facing(to.way, step);
  const int32_t strict = half - kCellCover > passes_ ? half - kCellCover : passes_;
  const int32_t abeam = half > kAbeam ? half : kAbeam;
  const int32_t passed = abeam < strict ? abeam : strict;
  const int32_t least = passed < half - kCellCover ? passed : half - kCellCover;
  const Row box = Span::around(there.x, to.reach).columns();
  for (Rows rows(there.y, to.reach + kHalfSquare); rows.more(); rows.next()) {
    if (rows.row() < to.row) continue;
    Row unclear = box & to_window(~clear_row(rows.row()));
    if (to.avoid == Avoid::suspect) unclear &= solid_row(rows.row());
    if (unclear == 0) continue;
    work_.add(kWayRowUnits);
    // Most of them lie behind.
    Span any = Span::around(there.x, to.reach);
    ahead.clip(any, here.x, rows.offset(here.y), least);
    if ((any.columns() & unclear) == 0) continue;
    Span span;
    span.touched_by_disc(there.x, rows.offset(there.y), to.reach);
    ahead.clip(span, here.x, rows.offset(here.y), passed);
    if ((span.columns() & unclear) != 0) return true;
    const Row solid = unclear & solid_row(rows.row());
    if (solid == 0) continue;
    // The point of an unclear cell that the body would reach first may lie half a diagonal ahead of its
    // centre.
    Span rim;
    rim.touched_by_disc(there.x, rows.offset(there.y), body_);
    ahead.clip(rim, here.x, rows.offset(here.y), half - kCellCover);
    if ((rim.columns() & solid) != 0) return true;
  }
  return false;
}

bool LocalGrid::all_clear(Vec centre, Length radius) const noexcept {
  work_.add(kDiscUnits);
  const Point at = local(centre);
  const int32_t reach = units(radius);
  if (!in_window(at, reach + kHalfSquare)) return false;
  const Row box = to_torus(Span::around(at.x, reach).columns());
  for (Rows rows(at.y, reach + kHalfSquare); rows.more(); rows.next()) {
    const Row unclear = box & ~clear(slot(rows.row()));
    if (unclear == 0) continue;
    work_.add(kDiscRowUnits);
    Span span;
    span.touched_by_disc(at.x, rows.offset(at.y), reach);
    if ((span.columns() & to_window(unclear)) != 0) return false;
  }
  return true;
}

void LocalGrid::vouch(Vec centre, Length radius, const Beam (&beams)[3], const Length (&free)[3]) noexcept {
  const Point at = local(centre);
  const int32_t reach = units(radius);
  for (Rows rows(at.y, reach); rows.more(); rows.next()) {
    Span inside;
    inside.inside_disc(at.x, rows.offset(at.y), reach);
    Row vouched = inside.columns();
    for (int i = 0; i < 3; ++i) {
      const Point apex = local(beams[i].apex);
      const int32_t dy = rows.offset(apex.y);
      const Wedge cone(beams[i].axis, beams[i].half_cone);
      Span covered, touched, nearer;
      cone.hold(covered, apex.x, dy);
      cone.clip(touched, apex.x, dy, -kCellCover);
      nearer.inside_disc(apex.x, dy, units(free[i] - kReadingRounding));
      vouched &= ~(covered.columns() | (touched.columns() & ~nearer.columns()));
    }
    const int s = slot(rows.row());
    young_[s] |= to_torus(vouched) & ~suspect_[s];
  }
}

void LocalGrid::take_back(const Beam& beam, Length nearest, Length farthest) noexcept {
  if (nearby(local(beam.apex))) echo_arc(beam, nearest, farthest, true);
}

bool LocalGrid::is_clear(Vec at) const noexcept {
  const Point p = local(at);
  if (p.x < 0 || p.y < 0 || p.x >= kWindow || p.y >= kWindow) return false;
  return (to_window(clear_row(static_cast<int>(p.y / kUnitsPerCell))) >> (p.x / kUnitsPerCell) & 1U) != 0;
}

}  // namespace whisker::perception
