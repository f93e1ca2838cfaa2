#include "firmware/perception/local_grid.hpp"

#include "firmware/perception/ground_age.hpp"
#include "hal/types.hpp"

namespace whisker::perception {
namespace {

constexpr int32_t kLaneTolerance = 45;  // of the radius, within which the body keeps to the lane's middle
constexpr Angle kBeside = 30_deg;       // of a side beam, revoked with it

static_assert(kUnitsPerCell == 256, "kCellCover counts in 256ths of a cell");

constexpr Angle kSuspectHalf = 6_deg;
constexpr Length kTestedTravel = 4_mm;
constexpr int32_t kAhead = 3;  // cells
constexpr Duration kDoubt = 1000_ms;

// Seen from any apex within or near the window.
constexpr int32_t kWholeWindow = 5 * kCells * kUnitsPerCell;

/// From the measurement of a moving object to standstill: two more readings, latency, a gap, lag, braking.
Duration time_to_stop(const Params& p) noexcept {
  const int32_t braking = multiply_divide(p.wheels.max_speed.raw(), 1000, p.wheels.max_acceleration.raw());
  return p.rangefinders.latency + milliseconds(2000 / p.rangefinders.rate_hz) + longest_gap(p) +
         p.wheels.motor_lag + milliseconds(braking);
}

/// The part of a cone's rows in which an echo lies, at most.
struct Struck {
  WedgeCut edges;
  int32_t x, ends;
  Row columns(int32_t dy) const noexcept {
    Span span = Span::around(x, ends);
    edges.clip(span, dy);
    if (span.empty()) return 0;
    span.within_disc(x, dy, ends);
    return span.columns();
  }
  /// Of these columns, those that are not nearer than this.
  Row from(int32_t begins, Row columns, int32_t dy) const noexcept {
    if (columns == 0) return 0;
    Span nearer = Span::around(x, ends);
    nearer.within_disc(x, dy, begins);
    return columns & ~nearer.columns();
  }
};

bool both_nearby(const LocalGrid::Apexes& at) noexcept { return nearby(at.now) && nearby(at.before); }

}  // namespace

Beam beam_of(const Mount& mount, const Pose& body) noexcept {
  const Q30 c = cos(body.heading);
  const Q30 s = sin(body.heading);
  const Vec ahead{mount.apex.x * c, mount.apex.x * s};
  const Vec aside{-(mount.apex.y * s), mount.apex.y * c};
  return {body.at + ahead + aside, body.heading + mount.axis, mount.half_cone};
}

void LocalGrid::configure(const Params& params) noexcept {
  scale_ = GridScale(grid_cell(params).raw());
  swept_ = rim_sweep(params).radius;
  clears_ = loses_walls(params.rangefinders) ? kScatterRange : 60_m;
  place_error_ = formula::place_error(params);
  footprint_ = units(swept_);
  body_ = narrow<int16_t>(units(params.body.radius + guard_slack(params)));
  reach_ = whisker::reach(params);
  lane_.configure(reach_.guard + swept_ / kLaneTolerance, params.body.radius + guard_slack(params));
  // One true cell of a wall beyond the echo would explain it, and what stands on the clear cells between
  // would stay unseen.
  explains_ = narrow<int16_t>(loses_only_grazed(params.rangefinders) ? kUnitsPerCell : kHalfCell);
  holds_ = Length{};
  for (int i = 0; i < 3; ++i) {
    // While it turns, two readings one after another share little more than half a cone.
    const int64_t cover = int64_t{cell_cover(params).raw()} * 2 * Q30::kOne;
    const int64_t holds = quotient(cover, sin(mount(params.rangefinders, i).half_cone).raw());
    holds_ = max(holds_, Length::from_raw(saturate32(holds)) + grid_cell(params) * 2);
  }
  const Length margin = reach_.guard - swept_;
  const uint64_t passed =
      uint64_t{2} * static_cast<uint64_t>(swept_.raw()) * static_cast<uint64_t>(margin.raw());
  passes_ = narrow<int16_t>(units(Length::from_raw(narrow<int32_t>(square_root(passed)))) - kCellCover);
  meets_ = narrow<int16_t>(units(reach_.planning + cell_cover(params)));
  ring_ = units(reach_.planning) + kUnitsPerCell + kCellCover;
  const GroundAge age = ground_age(params);
  age_travel_ = age.travel;
  age_turn_ = age.turn.raw();
  approach_ = derived::kMoverSpeed * time_to_stop(params);
}

LocalGrid::Point LocalGrid::local(Vec at) const noexcept {
  return {scale_.units_from(column_, at.x), scale_.units_from(row_, at.y)};
}

void LocalGrid::drop_rows(int first, int count) noexcept {
  for (int row = first; row < first + count; ++row) {
    const int s = slot(row);
    young_[s] = old_[s] = suspect_[s] = 0;
    tested_[s] = 0;
    for (Chain& chain : chains_) chain.swept[s] = 0;
  }
}

void LocalGrid::drop_columns(Row window) noexcept {
  const Row keep = ~to_torus(window);
  for (int s = 0; s < kCells; ++s) {
    young_[s] &= keep;
    old_[s] &= keep;
    suspect_[s] &= keep;
    untest(s, ~keep);
    for (Chain& chain : chains_) chain.swept[s] &= keep;
  }
}

void LocalGrid::reset(const Pose& pose) noexcept {
  drop_rows(0, kCells);
  unlink();
  last_ = pose;
  travel_ = Length{};
  turned_ = 0;
  doubting_ = false;
  close_lane();
  move_to(pose);
}

void LocalGrid::move_to(const Pose& pose) noexcept {
  // The body is behind the middle of the window, because the beams point ahead.
  const Vec middle = pose.at + polar(pose.heading, Length::from_raw(scale_.cell_um() * kAhead));
  const auto corner = [this](Length x) {
    return narrow<int32_t>(floor_div(int64_t{x.raw()} + scale_.cell_um() / 2, scale_.cell_um())) - kCells / 2;
  };
  const int32_t right = corner(middle.x) - column_;
  const int32_t up = corner(middle.y) - row_;
  column_ += right;
  row_ += up;
  if (right >= kCells || right <= -kCells || up >= kCells || up <= -kCells) {
    drop_rows(0, kCells);
  } else {
    const int rows = static_cast<int>(up);
    const int cols = static_cast<int>(right);
    if (rows > 0) drop_rows(kCells - rows, rows);
    if (rows < 0) drop_rows(0, -rows);
    if (cols > 0) drop_columns(columns_between(kCells - cols, kCells - 1));
    if (cols < 0) drop_columns(columns_between(0, -cols - 1));
  }
  if (farther(pose.at - tested_at_, kTestedTravel)) {
    for (Row& row : tested_) row = 0;
    tested_at_ = pose.at;
  }
  age(pose);
  clear_around(pose.at, footprint_);
  if (has_lane()) lane_.mark_around(pose.at, swept_);
}

void LocalGrid::age(const Pose& pose) noexcept {
  travel_ += norm(pose.at - last_.at);
  const uint32_t turn = magnitude(pose.heading - last_.heading);
  turned_ = turn > UINT32_MAX - turned_ ? UINT32_MAX : turned_ + turn;
  last_ = pose;
  if (travel_ >= age_travel_ || turned_ >= age_turn_) {
    for (int s = 0; s < kCells; ++s) {
      old_[s] = young_[s];
      young_[s] = 0;
    }
    if (has_lane()) lane_.age();
    travel_ = Length{};
    turned_ = 0;
  }
  renew_around(pose.at);
}

void LocalGrid::renew_around(Vec at) noexcept {
  const Point centre = local(at);
  const Row box = to_torus(Span{centre.x - ring_, centre.x + ring_}.columns());
  for (Rows rows(centre.y, ring_); rows.more(); rows.next()) {
    const int s = slot(rows.row());
    if ((box & old_[s] & ~young_[s]) == 0) continue;
    Span span;
    span.within_disc(centre.x, rows.offset(centre.y), ring_);
    young_[s] |= old_[s] & to_torus(span.columns());
  }
}

void LocalGrid::clear_around(Vec at, int32_t reach) noexcept {
  const Point centre = local(at);
  const Row box = to_torus(Span{centre.x - reach, centre.x + reach}.columns());
  for (Rows rows(centre.y, reach); rows.more(); rows.next()) {
    const int s = slot(rows.row());
    if ((box & (~young_[s] | suspect_[s])) == 0) continue;
    Span span;
    span.inside_disc(centre.x, rows.offset(centre.y), reach);
    const Row mask = to_torus(span.columns());
    young_[s] |= mask;
    suspect_[s] &= ~mask;
  }
}

Length LocalGrid::room_for(const ConeObservation& observation) const noexcept {
  return doubting_ && observation.hit ? approach_ : Length{};
}

LocalGrid::Apexes LocalGrid::apexes(const ConeObservation& observation,
                                    const EarlierObservation* before) const noexcept {
  const Point now = local(observation.beam.apex);
  return {now, before == nullptr || before->apex == observation.beam.apex ? now : local(before->apex)};
}

void LocalGrid::mark(const ConeObservation& observation, const EarlierObservation* before,
                     const Apexes& at) noexcept {
  const Beam& beam = observation.beam;
  const EarlierObservation last =
      before != nullptr ? *before : EarlierObservation{beam.apex, beam.axis, observation.free};
  const Point apex = at.now, apex_before = at.before;
  if (!both_nearby(at)) return;
  if (observation.taken - doubted_ > kDoubt) doubting_ = false;
  const Length taken_off = room_for(observation) + kReadingRounding;
  const Length cleared = min(observation.free, clears_);
  const Length earlier = min(last.free, clears_);
  if (has_lane()) {
    lane_.mark(beam, cleared - taken_off, {last.apex, last.axis, earlier}, earlier - taken_off);
  }
  const int32_t free = units(cleared - taken_off);
  const int32_t free_before = units(earlier - taken_off);
  const int32_t echo = units(observation.free) + kUnitsPerCell;
  const Wedge cone(beam.axis, beam.half_cone);
  const bool moved = !(beam.apex == last.apex) || beam.axis != last.axis || free_before < free;
  const Wedge cone_before = moved ? Wedge(last.axis, beam.half_cone) : cone;
  const bool wide = observation.hit && beam.half_cone.raw() > kSuspectHalf.raw();
  const Wedge core = wide ? Wedge(beam.axis, kSuspectHalf) : cone;
  const int32_t reach = observation.aimed ? kWholeWindow : observation.hit ? echo : free;
  const bool suspects = observation.hit && reach_.past != Angle{};
  work_.add(kMarkUnits);
  Rows rows = cone.rows(apex.y, reach);
  const int32_t first = rows.offset(apex.y);
  const int32_t up = apex.y - apex_before.y;
  WedgeCut held = cone.holding(apex.x, first);
  WedgeCut held_before = cone_before.holding(apex_before.x, first + up);
  Struck struck{core.clipping(apex.x, first, 0), apex.x, echo};
  for (; rows.more(); rows.next(), held.next(), held_before.next(), struck.edges.next()) {
    const int32_t dy = rows.offset(apex.y);
    work_.add(kMarkRowUnits);
    Span inside = Span::around(apex.x, reach);
    held.clip(inside, dy);
    const int s = slot(rows.row());
    const Row covered = to_torus(inside.columns());
    Row echoes = 0;
    if (suspects) {
      // Near the apex, the cone holds no cell.
      echoes = struck.columns(dy);
      suspect(s, to_torus(struck.from(free - kCellCover, echoes, dy)) & ~(young_[s] | old_[s]));
    }
    if ((covered & (~young_[s] | suspect_[s] | tested(s))) == 0) continue;
    Span empty = inside;
    empty.inside_disc(apex.x, dy, free);
    if (moved) {
      held_before.clip(empty, dy + up);
      empty.inside_disc(apex_before.x, dy + up, free_before);
    }
    const Row clear = to_torus(empty.columns());
    young_[s] |= clear;
    suspect_[s] &= ~clear;
    untest(s, clear);
    const Row unproved = covered & ~(young_[s] | old_[s]);
    if (observation.aimed) test(s, unproved);
    if (observation.hit && unproved != 0) {
      if (!suspects) echoes = struck.columns(dy);
      suspect(s, to_torus(echoes) & unproved);
    }
  }
}

void LocalGrid::doubt(const ConeObservation& observation, Length farthest) noexcept {
  doubting_ = true;
  close_lane();
  unlink();
  doubted_ = observation.taken;
  const Beam& beam = observation.beam;
  const Point apex = local(beam.apex);
  const Point body = local(last_.at);
  if (!nearby(apex)) return;
  const int32_t approach = units(approach_) + kCellCover;
  const int32_t nearest = units(observation.free) - approach;
  const int32_t echo_ends = units(farthest) + kUnitsPerCell;
  const int32_t beyond = units(farthest + approach_) + kUnitsPerCell;
  const Wedge cone(beam.axis, beam.half_cone);
  const int32_t first = kHalfCell - apex.y;
  WedgeCut beside = cone.clipping(apex.x, first, -approach);
  WedgeCut struck = cone.clipping(apex.x, first, 0);
  // The object may extend beyond the cone's edges, and be nearer there, but not behind the apex.
  Cut ahead(HalfPlane::facing(beam.axis), apex.x, first, 0);
  work_.add(kCells * kArcRowUnits);
  for (int row = 0; row < kCells; ++row, beside.next(), struck.next(), ahead.next()) {
    const int32_t dy = row * kUnitsPerCell + kHalfCell - apex.y;
    Span around;
    around.within_disc(apex.x, dy, beyond);
    if (around.empty()) continue;
    beside.clip(around, dy);
    ahead.clip(around, dy);
    if (around.empty()) continue;
    Span nearer;
    nearer.within_disc(apex.x, dy, nearest);
    Span under;
    under.inside_disc(body.x, row * kUnitsPerCell + kHalfCell - body.y, footprint_);
    const Row taken = to_torus(around.columns() & ~nearer.columns() & ~under.columns());
    Span echo;
    struck.clip(echo, dy);
    echo.within_disc(apex.x, dy, echo_ends);
    const int s = slot(row);
    young_[s] &= ~taken;
    old_[s] &= ~taken;
    suspect_[s] &= ~taken;
    suspect(s, taken & to_torus(echo.columns()));
    untest(s, taken);
  }
}

/// What lies outside the window explains an echo.
bool LocalGrid::leaves_window(const Beam& beam, Point apex, Length farthest) const noexcept {
  if (in_window(apex, units(farthest) + 2 * kUnitsPerCell)) return false;
  const Angle sides[] = {-beam.half_cone, Angle{}, beam.half_cone};
  for (const Angle side : sides) {
    const Vec end = polar(beam.axis + side, farthest + Length::from_raw(scale_.cell_um()));
    if (!in_window(local(beam.apex + end), 0)) return true;
  }
  return false;
}

bool LocalGrid::echo_arc(const Beam& beam, Point apex, Length nearest, Length farthest, bool takes) noexcept {
  if (!takes && leaves_window(beam, apex, farthest)) return false;
  const Point body = local(last_.at);
  const EchoArc arc{Wedge(beam.axis, beam.half_cone), units(nearest - kReadingRounding),
                    units(farthest) + (takes ? kUnitsPerCell : explains_)};
  const Row box = to_torus(Span::around(apex.x, arc.ends).columns());
  work_.add(kArcUnits);
  Rows rows = arc.rows(apex.y);
  for (WedgeCut edges = arc.edges(apex.x, rows.offset(apex.y)); rows.more(); rows.next(), edges.next()) {
    const int s = slot(rows.row());
    const Row clear = young_[s] | old_[s];
    const Row asked = takes ? clear : ~clear;
    if ((box & asked) == 0) continue;
    work_.add(kArcRowUnits);
    const Row touched = to_torus(arc.columns(edges, apex.x, rows.offset(apex.y))) & asked;
    if (touched == 0) continue;
    Span under = Span::around(body.x, footprint_);
    under.inside_disc(body.x, rows.offset(body.y), footprint_);
    Row cells = touched & ~to_torus(under.columns());
    // Sensors that lose walls may have cleared them, and what stands there would explain its own echo.
    if (!takes && cells != 0 && has_lane() && clears_ == kScatterRange) cells &= ~on_lane(rows.row());
    if (takes) {
      young_[s] &= ~cells;
      old_[s] &= ~cells;
    } else if (cells != 0) {
      return false;
    }
  }
  return true;
}

void LocalGrid::revoke(const Beam& beam, Length nearest, Length farthest) noexcept {
  const Point apex = local(beam.apex);
  if (!nearby(apex)) return;
  if (!echo_arc(beam, apex, nearest, farthest, false)) return;
  echo_arc(beam, apex, nearest, farthest, true);
  if (has_lane()) lane_.take_back(beam, nearest - kReadingRounding, farthest);
}

void LocalGrid::revoke_beside(const ConeObservation& observation, Length farthest, int32_t radii) noexcept {
  Beam beam = observation.beam;
  const Length free = observation.free;
  const Point apex = local(beam.apex);
  if (observation.number == hal::kFront || !nearby(apex) || units(free) > radii * footprint_) return;
  const Angle beside = Angle::from_raw(kBeside.raw() / 2);
  const Angle outward = beam.half_cone + beside;
  beam.axis += observation.number == hal::kLeft ? outward : -outward;
  beam.half_cone = beside;
  echo_arc(beam, apex, free, farthest, true);
  if (has_lane()) lane_.take_back(beam, free - kReadingRounding, farthest);
}

void LocalGrid::block(Vec centre, Length radius) noexcept {
  const Point at = local(centre);
  const Point body = local(last_.at);
  if (!nearby(at)) return;
  close_lane();
  const int32_t reach = units(radius);
  for (Rows rows(at.y, reach + kHalfSquare); rows.more(); rows.next()) {
    const int s = slot(rows.row());
    Span touched;
    touched.touched_by_disc(at.x, rows.offset(at.y), reach);
    Span under = Span::around(body.x, footprint_);
    under.inside_disc(body.x, rows.offset(body.y), footprint_);
    const Row taken = to_torus(touched.columns() & ~under.columns());
    young_[s] &= ~taken;
    old_[s] &= ~taken;
    suspect(s, taken);
  }
}

}  // namespace whisker::perception
