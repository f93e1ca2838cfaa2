#include "firmware/perception/local_grid.hpp"

namespace whisker::perception {
namespace {

// Passing a corner at lateral distance d: the body comes x^2 / 2d nearer than x before it (docs/ground.md).
constexpr int32_t kAbeam = 80;
constexpr int32_t kFineAbeam = kAbeam * FineGrid::kParts;
constexpr int32_t kWindow = kCells * kUnitsPerCell;

}  // namespace

template <class Touched>
Row LocalGrid::with_unclear_parts(int row, Row cells, const Touched& touched) const noexcept {
  Row unclear = 0;
  for (int part = row * FineGrid::kParts; part < (row + 1) * FineGrid::kParts; ++part) {
    unclear |= fine_.unclear(part, touched(part));
  }
  return cells & unclear;
}

bool LocalGrid::in_window(Point p, int32_t reach) noexcept {
  return p.x >= reach && p.y >= reach && p.x <= kWindow - reach && p.y <= kWindow - reach;
}

Obstacles LocalGrid::along(const Vec& from, Angle heading, Length length, Length radius,
                           int32_t enough) const noexcept {
  Obstacles found;
  const Point start = local(from);
  const Stadium stadium({start.x, start.y, heading, units(length), units(radius), kAbeam});
  const Row box = stadium.box();
  const GridFrame& frame = fine_.frame();
  const Point fine_start = frame.local(from);
  const Stadium fine(
      {fine_start.x, fine_start.y, heading, frame.units(length), frame.units(radius), kFineAbeam});
  int32_t nearest = INT32_MAX;
  for (Rows rows = stadium.rows(); rows.more(); rows.next()) {
    Row blocked = box & to_window(~clear_row(rows.row()));
    if (blocked == 0) continue;
    blocked &= stadium.columns(rows.row());
    if (blocked == 0) continue;
    blocked = with_unclear_parts(rows.row(), blocked, [&](int part) { return fine.span(part); });
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
        found.nearest_unknown = {frame_.length_of(dx), frame_.length_of(dy)};
      }
    }
  }
  return found;
}

bool LocalGrid::approaches(const Vec& from, Angle heading, Length step, Length radius,
                           Avoid avoid) const noexcept {
  if (step < kShortestStep) return false;
  const Point here = local(from);
  const Vec end = from + polar(heading, step);
  const Point there = local(end);
  const int32_t reach = units(radius);
  const int32_t half = units(step / 2);
  // Beyond the window nothing is known.
  if (!in_window(there, reach + kHalfSquare)) return true;
  const HalfPlane ahead = HalfPlane::facing(heading);
  const GridFrame& fine = fine_.frame();
  const Point fine_here = fine.local(from);
  const Point fine_there = fine.local(end);
  const int32_t fine_reach = fine.units(radius);
  const int32_t fine_half = fine.units(step / 2);
  const auto touched = [&](int part) {
    const int32_t centre = part * kUnitsPerCell + kHalfCell;
    Span span = Span::around(fine_there.x, fine_reach);
    span.touched_by_disc(fine_there.x, centre - fine_there.y, fine_reach);
    ahead.clip(span, fine_here.x, centre - fine_here.y, fine_half > kFineAbeam ? fine_half : kFineAbeam);
    return span;
  };
  const Row box = Span::around(there.x, reach).columns();
  for (Rows rows(there.y, reach + kHalfSquare); rows.more(); rows.next()) {
    Row unclear = box & to_window(~clear_row(rows.row()));
    if (avoid == Avoid::suspect) unclear &= solid_row(rows.row());
    if (unclear == 0) continue;
    Span span;
    span.touched_by_disc(there.x, rows.offset(there.y), reach);
    ahead.clip(span, here.x, rows.offset(here.y), half > kAbeam ? half : kAbeam);
    unclear &= span.columns();
    if (unclear != 0 && with_unclear_parts(rows.row(), unclear, touched) != 0) return true;
  }
  return false;
}

bool LocalGrid::all_clear(Vec centre, Length radius) const noexcept {
  const Point at = local(centre);
  const int32_t reach = units(radius);
  if (!in_window(at, reach + kHalfSquare)) return false;
  const Row box = Span::around(at.x, reach).columns();
  for (Rows rows(at.y, reach + kHalfSquare); rows.more(); rows.next()) {
    const Row unclear = box & to_window(~clear_row(rows.row()));
    if (unclear == 0) continue;
    Span span;
    span.touched_by_disc(at.x, rows.offset(at.y), reach);
    if ((span.columns() & unclear) != 0) return false;
  }
  return true;
}

bool LocalGrid::is_clear(Vec at) const noexcept {
  const Point p = local(at);
  if (p.x < 0 || p.y < 0 || p.x >= kWindow || p.y >= kWindow) return false;
  return (to_window(clear_row(static_cast<int>(p.y / kUnitsPerCell))) >> (p.x / kUnitsPerCell) & 1U) != 0;
}

bool LocalGrid::is_part_clear(Vec at) const noexcept {
  constexpr int32_t kFineWindow = FineGrid::kFineCells * kUnitsPerCell;
  const Point p = fine_.frame().local(at);
  if (p.x < 0 || p.y < 0 || p.x >= kFineWindow || p.y >= kFineWindow) return false;
  return is_clear(at) || fine_.is_clear(p);
}

}  // namespace whisker::perception
