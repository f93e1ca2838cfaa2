#include "firmware/perception/local_grid.hpp"

namespace whisker::perception {
namespace {

constexpr Length kSweptBack = micrometres(500);
constexpr int32_t kWidest = (60_deg).wrapped();  // 0.58 below is the tangent of half of it
constexpr Duration kLongestLink = 450_ms;
// The gap point may lie within the body if what lies behind it, ahead of this part of the radius, does too.
constexpr int32_t kAheadPart = 3, kAheadParts = 10;

/// Across the rows of the window: the line from this point in this direction, with the side to keep.
Cut side_of(Facing line, bool left, GridPoint from) noexcept {
  const HalfPlane plane = HalfPlane::left_of(line);
  return {left ? plane : -plane, from.x, kHalfCell - from.y, plane.corner()};
}

/// An edge of a reading and, if there is one, of the reading before it.
struct Edges {
  Cut now;
  Cut before;
  bool both;

  void clip(Span& span, int32_t dy, int32_t dy_before) const noexcept {
    now.clip(span, dy);
    if (both) before.clip(span, dy_before);
  }
  void next() noexcept {
    now.next();
    if (both) before.next();
  }
};

}  // namespace

/// False if the cones of the two readings may not overlap.
bool LocalGrid::link(const Chain& chain, const Vec& from, const Edge& trail, Angle half_cone,
                     Boundary& seen_ahead) const noexcept {
  const int32_t sign = chain.left ? 1 : -1;
  const Angle overlap = (chain.lead - trail.angle) * sign;
  const int32_t least = static_cast<int32_t>(half_cone.raw() / 4);
  if (overlap.wrapped() < least || overlap.wrapped() > kWidest) return false;
  // Where the old leading edge crosses the new trailing one, both moved towards each other by the error.
  const Length between = across(chain.lead_from - from, chain.lead) * sign + place_error_ * 2;
  const int64_t reach = quotient(int64_t{between.raw()} * Q30::kOne, sin(overlap).raw());
  const Vec gap = from + polar(trail.facing, Length::from_raw(saturate32(reach)));
  const Angle half = Angle::from_raw(overlap.raw() / 2);
  seen_ahead = {gap, facing(trail.angle + half * sign)};
  // The part of the gap within the body is free.
  const Vec off = gap - last_.at;
  const Length body = swept_ - place_error_;
  const Length ahead = body * kAheadPart / kAheadParts;
  const Length deep = max(Length{}, whisker::along(off, seen_ahead.facing) - ahead);
  const Length beside = abs(across(off, seen_ahead.facing)) + deep * Q14::ratio(58, 100);
  if (!farther(off, body) && !farther({ahead, beside}, body)) {
    seen_ahead.at = last_.at + polar(seen_ahead.facing, ahead);
  }
  return true;
}

/// False: the beam has turned back, or has given no reading for too long, so that the chain begins anew.
bool LocalGrid::follows(Chain& chain, const ConeObservation& observation) const noexcept {
  const Beam& beam = observation.beam;
  const Length moved =
      arc(beam.axis - chain.last.axis, swept_) - across(beam.apex - chain.last.apex, beam.axis);
  const Length back = chain.left ? -moved : moved;
  chain.back = back < Length{} ? Length{} : chain.back + back;
  const bool linked = chain.linked && observation.taken - chain.taken <= kLongestLink;
  if (chain.back <= kSweptBack && linked) return true;
  if (linked) chain.left = !chain.left;
  chain.back = Length{};
  return false;
}

void LocalGrid::chain(const ConeObservation& observation, const EarlierObservation* before,
                      const Apexes& at) noexcept {
  if (reach_.past == Angle{}) return;
  Chain& chain = chains_[observation.number];
  const Beam& beam = observation.beam;
  bool linked = follows(chain, observation);
  const int32_t sign = chain.left ? 1 : -1;
  const Angle half = beam.half_cone * sign;
  const auto edge_at = [](Angle direction) { return Edge{direction, facing(direction)}; };
  const bool both = before != nullptr;
  const Vec from_before = both ? before->apex : beam.apex;
  const Angle axis_before = both ? before->axis : beam.axis;
  Sweep sweep_of{edge_at(beam.axis - half), edge_at(beam.axis + half), {}, {}};
  sweep_of.trail_before = both ? edge_at(axis_before - half) : sweep_of.trail;
  sweep_of.lead_before = both ? edge_at(axis_before + half) : sweep_of.lead;
  // Of two readings, either may be wrong. So a link joins the least advanced leading edge to the most
  // advanced trailing one; of a body that drives and turns, one may have the farther apex, the other the
  // farther axis.
  const Angle on = (beam.axis - axis_before) * sign;
  const bool turned_on = on.wrapped() >= 0;
  const auto shifted_on = [&](const Edge& edge) {
    return across(from_before - beam.apex, edge.facing) * sign >= Length{};
  };
  const Edge& foremost = turned_on ? sweep_of.trail : sweep_of.trail_before;
  const Edge& rearmost = turned_on ? sweep_of.lead_before : sweep_of.lead;
  Boundary seen_ahead;
  linked = linked &&
           link(chain, shifted_on(foremost) ? beam.apex : from_before, foremost, beam.half_cone, seen_ahead);
  chain.linked = sweep(chain, observation, before, at, sweep_of, linked ? &seen_ahead : nullptr);
  chain.lead_from = shifted_on(rearmost) ? from_before : beam.apex;
  chain.lead = rearmost.angle;
  chain.last = beam;
  chain.taken = observation.taken;
}

/// False: the beams lie too far from the window.
bool LocalGrid::sweep(Chain& chain, const ConeObservation& observation, const EarlierObservation* before,
                      const Apexes& at, const Sweep& edges, const Boundary* seen_ahead) noexcept {
  const bool both = before != nullptr;
  const Length room = room_for(observation);
  const auto within = [&](Length free) {
    return units(min(min(free, clears_) - room - kReadingRounding, holds_));
  };
  const Boundary boundary = seen_ahead != nullptr ? *seen_ahead : Boundary{};
  const Point apex = at.now;
  const Point gap = seen_ahead != nullptr ? local(boundary.at) : Point{};
  const Point apex_before = at.before;
  const int32_t free = within(observation.free);
  const int32_t free_before = both ? within(before->free) : free;
  const bool sound = nearby(apex) && nearby(apex_before) && (seen_ahead == nullptr || nearby(gap));
  const bool goes_on = sound && seen_ahead != nullptr;
  const int32_t first = kHalfCell - apex.y;
  const int32_t up = apex.y - apex_before.y;
  Edges trail{side_of(edges.trail.facing, chain.left, apex),
              side_of(edges.trail_before.facing, chain.left, apex_before), both};
  Edges lead{side_of(edges.lead.facing, !chain.left, apex),
             side_of(edges.lead_before.facing, !chain.left, apex_before), both};
  const HalfPlane beyond = HalfPlane::ahead_of(boundary.facing);
  Cut ahead(beyond, gap.x, kHalfCell - gap.y, beyond.corner());
  const auto next = [&] {
    trail.next();
    lead.next();
    ahead.next();
  };
  const int32_t reach = sound ? free : -1;
  work_.add(kLinkUnits);
  for (int row = 0; row < kCells; ++row) {
    if (row > 0) next();
    const int s = slot(row);
    Row& swept = chain.swept[s];
    const int32_t dy = first + row * kUnitsPerCell;
    if (static_cast<int32_t>(magnitude(dy)) > reach) {
      swept = 0;
      continue;
    }
    if (!goes_on) swept = 0;
    work_.add(kLinkRowUnits);
    Span empty = Span::around(apex.x, free);
    empty.inside_disc(apex.x, dy, free);
    if (both) empty.inside_disc(apex_before.x, dy + up, free_before);
    if (empty.empty()) {
      swept = 0;
      continue;
    }
    Span kept = empty;
    if (swept != 0) ahead.clip(kept, dy + apex.y - gap.y);
    Span entered = empty;
    trail.clip(entered, dy, dy + up);
    swept = (swept & to_torus(kept.columns())) | to_torus(entered.columns());
    if ((swept & (~young_[s] | suspect_[s] | tested(s))) == 0) continue;
    Span left_behind = empty;
    lead.clip(left_behind, dy, dy + up);
    const Row clear = swept & to_torus(left_behind.columns());
    young_[s] |= clear;
    suspect_[s] &= ~clear;
    untest(s, clear);
  }
  return sound;
}

}  // namespace whisker::perception
