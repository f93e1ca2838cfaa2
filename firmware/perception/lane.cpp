#include "firmware/perception/lane.hpp"

namespace whisker::perception {
namespace {

// As in LocalGrid::approaches(): half a cell is a sixteenth of the radius.
constexpr int32_t kAbeam = kHalfCell;

}  // namespace

void Lane::open(const Pose& from) noexcept {
  open_ = true;
  from_ = from;
  clear();
}

void Lane::clear() noexcept {
  for (Row& row : clear_) row = 0;
  aged_ = false;
}

void Lane::age() noexcept {
  if (aged_) {
    clear();
  } else {
    aged_ = true;
  }
}

GridPoint Lane::local(Vec at) const noexcept {
  const Vec off = at - from_.at;
  return {scale_.units_from(0, along(off, from_.heading)),
          scale_.units_from(0, -across(off, from_.heading)) + kRows / 2 * kUnitsPerCell};
}

void Lane::mark(const Beam& beam, Length free, const EarlierObservation& before,
                Length free_before) noexcept {
  const GridPoint apex = local(beam.apex);
  const GridPoint apex_before = local(before.apex);
  if (!nearby(apex) || !nearby(apex_before)) return;
  const int32_t reach = scale_.units(free);
  const int32_t reach_before = scale_.units(free_before);
  const Wedge cone(beam.axis - from_.heading, beam.half_cone);
  const Wedge cone_before(before.axis - from_.heading, beam.half_cone);
  for (Rows rows = cone.rows(apex.y, reach); rows.more() && rows.row() < kRows; rows.next()) {
    const int32_t dy = rows.offset(apex.y);
    const int32_t dy_before = rows.offset(apex_before.y);
    Span empty = Span::around(apex.x, reach);
    cone.hold(empty, apex.x, dy);
    cone_before.hold(empty, apex_before.x, dy_before);
    empty.inside_disc(apex.x, dy, reach);
    empty.inside_disc(apex_before.x, dy_before, reach_before);
    clear_[rows.row()] |= empty.columns();
  }
}

void Lane::take_back(const Beam& beam, Length begins, Length farthest) noexcept {
  const GridPoint apex = local(beam.apex);
  if (!nearby(apex)) return;
  const EchoArc arc{Wedge(beam.axis - from_.heading, beam.half_cone), scale_.units(begins),
                    scale_.units(farthest) + kUnitsPerCell};
  for (Rows rows = arc.rows(apex.y); rows.more() && rows.row() < kRows; rows.next()) {
    clear_[rows.row()] &= ~arc.columns(apex.x, rows.offset(apex.y));
  }
}

void Lane::mark_around(Vec at, Length radius) noexcept {
  const GridPoint centre = local(at);
  if (!nearby(centre)) return;
  const int32_t reach = scale_.units(radius);
  for (Rows rows(centre.y, reach); rows.more() && rows.row() < kRows; rows.next()) {
    Span span = Span::around(centre.x, reach);
    span.inside_disc(centre.x, rows.offset(centre.y), reach);
    clear_[rows.row()] |= span.columns();
  }
}

bool Lane::is_clear(const Span& span, int row) const noexcept {
  if (span.empty()) return true;
  if (span.low <= -kHalfCell || span.high >= kCells * kUnitsPerCell + kHalfCell) return false;
  return (span.columns() & ~clear_[row]) == 0;
}

bool Lane::holds(const Vec& from, const Vec& way, Length radius) const noexcept {
  const GridPoint here = local(from);
  const GridPoint there = local(from + way);
  const Length step = norm(way);
  const int32_t reach = scale_.units(radius);
  const int32_t half = scale_.units(step / 2);
  constexpr int32_t kWidth = kRows * kUnitsPerCell;
  if (there.y - reach <= kRim || there.y + reach >= kWidth - kRim) return false;
  const HalfPlane ahead = HalfPlane::facing(bearing(way) - from_.heading);
  for (Rows rows(there.y, reach + kHalfSquare); rows.more() && rows.row() < kRows; rows.next()) {
    Span span = Span::around(there.x, reach);
    span.touched_by_disc(there.x, rows.offset(there.y), reach);
    ahead.clip(span, here.x, rows.offset(here.y), half > kAbeam ? half : kAbeam);
    Span rim;
    rim.touched_by_disc(there.x, rows.offset(there.y), body_);
    ahead.clip(rim, here.x, rows.offset(here.y), half - kCellCover);
    if (!is_clear(span, rows.row()) || !is_clear(rim, rows.row())) return false;
  }
  return true;
}

bool Lane::is_clear(Vec at) const noexcept {
  const GridPoint p = local(at);
  if (!is_open() || p.x < 0 || p.y < 0 || p.x >= kCells * kUnitsPerCell || p.y >= kRows * kUnitsPerCell) {
    return false;
  }
  return (clear_[p.y / kUnitsPerCell] >> (p.x / kUnitsPerCell) & 1U) != 0;
}

}  // namespace whisker::perception
