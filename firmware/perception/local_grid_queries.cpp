#include "firmware/perception/local_grid.hpp"

namespace whisker::perception {
namespace {

constexpr int32_t kWindow = kCells * kUnitsPerCell;

constexpr int kUnitBits = 8;
static_assert(1 << kUnitBits == kUnitsPerCell);

/// The lowest bit's place. row != 0.
int lowest(Row row) noexcept { return kCells - 1 - leading_zeros(row & (0U - row)); }

/// Of a cell's centre from x.
constexpr int32_t offset(int cell, int32_t x) noexcept { return cell * kUnitsPerCell + kHalfCell - x; }

constexpr int32_t kRootOfTwo = 181;  // 2^-7
constexpr int32_t least(int32_t a, int32_t b) noexcept { return a < b ? a : b; }

/// Of a point in the first quadrant; up to 8 % too short.
constexpr int32_t distance_of(int32_t x, int32_t y) noexcept {
  const int32_t longer = x < y ? y : x;
  const int32_t diagonal = (x + y) * (kRootOfTwo / 2) / Q7::kOne;
  return longer < diagonal ? diagonal : longer;
}

/// The ways of a disc: ahead, at 30 and at 60 degrees to both sides. Coordinates are along the course and to
/// its left.
class Fan {
 public:
  Fan(int32_t most, int32_t radius, int32_t abeam) noexcept
      : ahead_(most),
        side_{{most, most}, {most, most}},
        radius_(radius),
        touched_(radius + kCellCover),
        touched_q14_(touched_ * Q14::kOne),
        beyond_(touched_ * 6 / 5),
        first_q14_((abeam + 1) * Q14::kOne) {}

  /// So far along, a cell is beside every way or behind it.
  bool behind(int32_t x) const noexcept { return x <= -touched_; }
  /// A suspect cell that is not behind is here.
  void meet(int32_t x, int32_t y) noexcept {
    const int32_t aside = y < 0 ? -y : y;
    if (x >= 0) nearest_ = least(nearest_, distance_of(x, aside));
    const int32_t long_x = x * kCosine, short_x = x * kSine;
    const int32_t long_y = aside * kCosine, short_y = aside * kSine;
    Side& same = side_[y < 0];
    stop(same.at_30, long_x + short_y, long_y - short_x);
    stop(same.at_60, short_x + long_y, short_y - long_x);
    if (aside > beyond_) return;
    Side& other = side_[y >= 0];
    stop(ahead_, x * Q14::kOne, aside * Q14::kOne);
    stop(other.at_30, long_x - short_y, long_y + short_x);
    stop(other.at_60, short_x - long_y, short_y + long_x);
  }

  int32_t ahead() const noexcept { return ahead_; }
  int32_t left() const noexcept { return side_[0].farther(); }
  int32_t right() const noexcept { return side_[1].farther(); }
  /// INT32_MAX: none.
  int32_t nearest() const noexcept { return nearest_; }

 private:
  // Of 30 degrees; 2^-14.
  static constexpr int32_t kCosine = 14189;
  static constexpr int32_t kSine = 8192;
  struct Side {
    int32_t at_30, at_60;
    int32_t farther() const noexcept { return at_30 > at_60 ? at_30 : at_60; }
  };

  /// A way that is free so far meets a cell that lies so far along and beside it, 2^-14.
  [[gnu::always_inline]] void stop(int32_t& free, int32_t along_q14, int32_t across_q14) const noexcept {
    const int32_t beside_q14 = across_q14 < 0 ? -across_q14 : across_q14;
    if (beside_q14 < touched_q14_ && along_q14 >= first_q14_) shorten(free, along_q14, beside_q14);
  }
  [[gnu::noinline]] void shorten(int32_t& free, int32_t along_q14, int32_t beside_q14) const noexcept {
    const int32_t along = along_q14 / Q14::kOne;
    const int32_t beyond = along - free;
    if (beyond >= radius_) return;
    const int32_t beside = beside_q14 / Q14::kOne;
    const int32_t squared = (radius_ - beside) * (radius_ + beside);
    // The root, half the chord, matters only where it is longer.
    if (beyond >= 0 && squared < (beyond + 1) * (beyond + 1)) return;
    const int32_t rest =
        squared > 0 ? along - static_cast<int32_t>(square_root_32(static_cast<uint32_t>(squared))) : along;
    free = rest < 0 ? 0 : rest;
  }

  int32_t ahead_;
  Side side_[2];  // left, right
  int32_t nearest_ = INT32_MAX;
  int32_t radius_;
  int32_t touched_;
  int32_t touched_q14_;
  int32_t beyond_;     // aside, a cell meets only ways of its side: 1.2 is more than the secant of 30 degrees
  int32_t first_q14_;  // cells less than this along a way are abeam of it
};

}  // namespace

Length LocalGrid::length_of(int32_t units) const noexcept {
  return Length::from_raw(saturate32(scale_down_by(int64_t{units} * scale_.cell_um(), kUnitBits)));
}

bool LocalGrid::in_window(Point p, int32_t reach) noexcept {
  return p.x >= reach && p.y >= reach && p.x <= kWindow - reach && p.y <= kWindow - reach;
}

Obstacles LocalGrid::along(const Vec& from, Angle heading, Length length, Length radius,
                           int32_t enough) const noexcept {
  const Point start = local(from);
  const Stadium stadium({start.x, start.y, heading, units(length), units(radius), abeam()});
  const Row box = to_torus(stadium.box());
  int32_t suspect = 0, unknown = 0;
  // The cells whose middle is not right of the start.
  const Row left = Span{-kUnitsPerCell, start.x + kHalfCell - 1}.columns();
  int32_t nearest = INT32_MAX;
  Point nearest_unknown;
  work_.add(kPathUnits);
  for (Rows rows = stadium.rows(); rows.more(); rows.next()) {
    const int s = slot(rows.row());
    const Row unclear = box & ~clear(s);
    if (unclear == 0) continue;
    work_.add(kPathRowUnits);
    const Row blocked = to_window(unclear) & stadium.columns(rows.row());
    const Row solid = blocked & solid_row(rows.row());
    suspect += bits(solid);
    if (suspect >= enough) break;
    const Row open = blocked & ~solid;
    unknown += bits(open);
    const int32_t dy = rows.offset(start.y);
    const auto look_at = [&](int cell) {
      const int32_t dx = offset(cell, start.x);
      const int32_t squared = dx * dx + dy * dy;
      if (squared >= nearest) return;
      nearest = squared;
      nearest_unknown = {dx, dy};
    };
    // Of a row, the nearest on either side.
    if ((open & left) != 0) look_at(kCells - 1 - leading_zeros(open & left));
    if ((open & ~left) != 0) look_at(lowest(open & ~left));
  }
  if (unknown == 0) return {0, suspect, {}};
  return {unknown, suspect, {length_of(nearest_unknown.x), length_of(nearest_unknown.y)}};
}

int32_t LocalGrid::suspects_along(const Vec& from, Angle heading, Length length, Length radius,
                                  int32_t enough) const noexcept {
  const Point start = local(from);
  const Stadium stadium({start.x, start.y, heading, units(length), units(radius), abeam()});
  const Row box = to_torus(stadium.box());
  int32_t found = 0;
  work_.add(kPathUnits);
  for (Rows rows = stadium.rows(); rows.more() && found < enough; rows.next()) {
    const Row solid = box & met(slot(rows.row()));
    if (solid == 0) continue;
    work_.add(kPathRowUnits);
    found += bits(to_window(solid) & stadium.columns(rows.row()));
  }
  return found;
}

Ways LocalGrid::ways(const Vec& from, Angle course, Length horizon) const noexcept {
  if (solid_slots_ == 0) return {horizon, horizon, horizon, 60_m};
  const int32_t most = units(horizon);
  const Point start = local(from);
  const int32_t c = q14(cos(course));
  const int32_t s = q14(sin(course));
  Fan fan(most, meets_, abeam());
  for (Row slots = solid_slots_; slots != 0; slots &= slots - 1) {
    const int slot = lowest(slots);
    const Row solid = solid_at(slot);
    if (solid == 0) {
      solid_slots_ &= ~(Row{1} << slot);
      continue;
    }
    const int32_t dy = offset((slot - row_) & (kCells - 1), start.y);
    for (Row cells = to_window(solid & ~clear(slot)); cells != 0; cells &= cells - 1) {
      const int32_t dx = offset(lowest(cells), start.x);
      const int32_t x = (dx * c + dy * s) / Q14::kOne;
      if (!fan.behind(x)) fan.meet(x, (dy * c - dx * s) / Q14::kOne);
    }
  }
  const auto way = [&](int32_t free) { return free == most ? horizon : length_of(free); };
  return {way(fan.left()), way(fan.ahead()), way(fan.right()),
          fan.nearest() == INT32_MAX ? 60_m : length_of(fan.nearest())};
}

Row LocalGrid::on_lane(int row) const noexcept {
  const Pose& begin = lane_.begin();
  const Point at = local(begin.at);
  if (!nearby(at)) return 0;
  work_.add(kArcRowUnits);
  const Facing way = facing(begin.heading);
  const HalfPlane left = HalfPlane::left_of(way), ahead = HalfPlane::ahead_of(way);
  const int32_t dy = row * kUnitsPerCell + kHalfCell - at.y;
  const int32_t beside = units(lane_.half_width()) + kHalfCell;
  Span cells;
  left.clip(cells, at.x, dy, -beside);
  (-left).clip(cells, at.x, dy, -beside);
  ahead.clip(cells, at.x, dy, 0);
  (-ahead).clip(cells, at.x, dy, -units(lane_.length()));
  return to_torus(cells.columns());
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
  const Point apex = local(beam.apex);
  if (nearby(apex)) echo_arc(beam, apex, nearest, farthest, true);
}

bool LocalGrid::is_clear(Vec at) const noexcept {
  const Point p = local(at);
  if (p.x < 0 || p.y < 0 || p.x >= kWindow || p.y >= kWindow) return false;
  return (to_window(clear_row(static_cast<int>(p.y / kUnitsPerCell))) >> (p.x / kUnitsPerCell) & 1U) != 0;
}

}  // namespace whisker::perception
