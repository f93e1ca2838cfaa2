#include "firmware/planning/boundary/gap_passage.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

// All lengths are for the reference body.
constexpr AngularRate kSweepRate = 250_mrad_per_s;
constexpr AngularRate kFirstRate = 500_mrad_per_s;  // before both jambs were seen
constexpr Angle kSweep = 75_deg;
constexpr Angle kGlance = 50_deg;  // from within the lane
constexpr int8_t kRounds = 8;
constexpr int8_t kStops = 8;
constexpr Length kOn = 2_mm;        // from one stop to the next, or it is no use
constexpr Length kOutward = 10_mm;  // past the innermost point of a jamb
constexpr int8_t kOtherLanes = 1;
constexpr Length kDrop = 40_mm;  // of a reading, at a jamb
constexpr Length kFarJamb = 600_mm;
constexpr Length kJambs = 450_mm;    // farthest from each other
constexpr Length kInFront = 280_mm;  // of the gap
constexpr Length kLane = 160_mm;     // the same, for the begin of the lane
constexpr Length kNear = 60_mm;      // the place from which it was seen
constexpr Length kThere = 3_mm;
constexpr Length kBeside = 5_mm;  // the place in front of the gap
constexpr int8_t kMoves = 4;
constexpr Length kBehind = 125_mm;  // the gap: the body has passed it
constexpr Length kOff = 1_mm;       // of the lane from the middle of the jambs
constexpr int32_t kSure = 2;        // cells beside the planning radius, for the least width of a promised gap
constexpr int32_t kUnsure = 4;      // the same for sensors that lose walls: they see round jambs too far out
constexpr int32_t kSparePart = 8;   // the same, of the room on each side of the body
constexpr Angle kAstray = 25_deg;   // of the first heading from the middle of the gap
constexpr Angle kTilted = 2_deg;
constexpr Length kPursuit = 60_mm;

constexpr int index(Side side) noexcept { return side == Side::left ? 0 : 1; }

}  // namespace

void GapPassage::enter(Phase phase) noexcept {
  follow(kArrows, phase_, phase);
  pause();
}

void GapPassage::pause() noexcept {
  behaviours_.enter();
  last_ = Length{};
}

void GapPassage::begin(const View& view, const Pose& gap, bool promised, Decision& decision) noexcept {
  phase_ = Phase::brake;
  pause();
  at_ = gap.at;
  ahead_ = gap.heading;
  came_along_ = view.pose.heading;
  promised_ = promised;
  sweeps_ = rounds_ = stops_ = 0;
  seen_ = 0;
  moves_ = lanes_ = 0;
  there_ = opened_ = returns_ = meets_ = doubtful_ = false;
  decision.manoeuvre = stop();
}

GapPassage::Result GapPassage::step(const View& view, Decision& decision) noexcept {
  switch (phase_) {
    case Phase::brake:
      if (!view.settled) break;
      enter(there_ ? Phase::face : Phase::aim);
      break;
    case Phase::face:
      if (rounds_ == 0) ahead_ = bearing(at_ - view.pose.at);
      if (!turn_by(way() - view.pose.heading, behaviours_.params, decision.manoeuvre)) break;
      if (opened_ || returns_) {
        enter(Phase::creep);
      } else {
        seen_ = 0;
        sweeps_ = 0;
        enter(Phase::sweep);
      }
      break;
    case Phase::sweep: return sweep(view, decision);
    case Phase::aim:
      if (!there_ && !farther(rest(view), for_body(behaviours_.params, kNear))) {
        there_ = true;
        enter(Phase::face);
      } else if (turn_by(bearing(rest(view)) - view.pose.heading, behaviours_.params, decision.manoeuvre)) {
        enter(Phase::move);
      }
      break;
    case Phase::move: return move(view, decision);
    case Phase::creep: return creep(view, decision);
  }
  return Result::under_way;
}

GapPassage::Result GapPassage::sweep(const View& view, Decision& decision) noexcept {
  const Params& params = behaviours_.params;
  const bool glances = stops_ > 0;
  const AngularRate rate = glances || rounds_ == 0 || promised_ ? kFirstRate : kSweepRate;
  decision.manoeuvre = cruise({Speed{}, rate * sign(side_)}, params);
  const Angle most = glances ? kGlance : kSweep;
  bool ends = ((view.pose.heading - way()) * sign(side_)).wrapped() > static_cast<int32_t>(most.raw());
  if (!glances && (view.observed >> hal::kFront & 1U) != 0) ends = jamb(view) || ends;
  if (!ends) return Result::under_way;
  const bool found = meets_;
  last_ = Length{};
  meets_ = false;
  side_ = opposite(side_);
  ++sweeps_;
  if (glances) {
    if (sweeps_ == 2) enter(Phase::face);
    return Result::under_way;
  }
  if (seen_ == 3) return measured(view, decision);
  // The first sweep may begin beyond the jamb.
  return found || sweeps_ == 1 ? Result::under_way : Result::failed;
}

bool GapPassage::jamb(const View& view) noexcept {
  const Params& params = behaviours_.params;
  const perception::ConeObservation& front = view.observations[hal::kFront];
  const Angle edge = front.beam.axis + front.beam.half_cone * sign(side_);
  const bool own_side = ((edge - ahead_) * sign(side_)).wrapped() > -static_cast<int32_t>(kAstray.raw());
  const bool near = front.hit && own_side && front.free < for_body(params, kFarJamb);
  const bool drops = last_ > front.free + for_body(params, kDrop);
  last_ = front.free;
  if (!near || !(drops || meets_)) return false;
  Vec& jamb = jambs_[index(side_)];
  const Vec at = front.beam.apex + polar(edge, front.free);
  const Length outward = across(at - jamb, ahead_) * -sign(side_);
  if (meets_ && outward > Length{}) return outward > for_body(params, kOutward);
  jamb = at;
  meets_ = true;
  seen_ = static_cast<uint8_t>(seen_ | 1U << index(side_));
  return false;
}

GapPassage::Result GapPassage::measured(const View& view, Decision& decision) noexcept {
  const Params& params = behaviours_.params;
  const Vec across_gap = jambs_[0] - jambs_[1];
  const Length width = norm(across_gap);
  // From aside, the jambs may seem to be nearer to each other than they are.
  const Length half = view.local_grid->lane().half_width();
  const bool narrow = width < (moves_ > 0 ? half * 2 : half);
  const Vec at{(jambs_[0].x + jambs_[1].x) / 2, (jambs_[0].y + jambs_[1].y) / 2};
  const Angle ahead = bearing(across_gap) - 90_deg;
  ++rounds_;
  // So much room needs only one new jamb for a new pair: this one and the last one.
  seen_ = promised_ ? static_cast<uint8_t>(1U << index(opposite(side_))) : uint8_t{0};
  sweeps_ = 0;
  if (promised_ && width < promised_width(view)) return Result::failed;
  if (narrow || width > for_body(params, kJambs)) {
    const bool again = !doubtful_ && moves_ > 0;
    doubtful_ = true;
    return again ? Result::under_way : Result::failed;
  }
  doubtful_ = false;
  // The line between the innermost points of round jambs is askew by more than the heading, and to the other
  // side; that between corners is not askew. This part of the change is good for both.
  // Of a thick wall, the innermost points may be a corner in front and one behind, by turns: their mean is
  // good.
  const int32_t part = promised_ ? rounds_ : 1;
  const Angle change = Angle::from_raw(static_cast<uint32_t>((ahead - ahead_).wrapped() / 8 * 3 / part));
  const Length aside = across(at - at_, ahead_);
  const Length spare = width / 2 - view.local_grid->reach().guard;
  const bool same = opened_ && magnitude(change) < kTilted.raw() &&
                    max(aside, -aside) < (promised_ ? spare / kSparePart : for_body(params, kOff));
  // Where it is the same, the body keeps to the middle of the lane that is open.
  if (!same || !promised_) {
    at_ = at;
    ahead_ += change;
  }
  if (same || (opened_ && rounds_ > kRounds)) {
    enter(Phase::face);
    return Result::under_way;
  }
  if (rounds_ > kRounds) return Result::failed;
  const Length beside = promised_ ? spare : for_body(params, kBeside);
  if (moves_ < kMoves && farther(before(kInFront) - view.pose.at, beside)) {
    ++moves_;
    opened_ = false;
    enter(Phase::aim);
    return Result::under_way;
  }
  opened_ = true;
  decision.lane.opens = true;
  decision.lane.from = {before(kLane), ahead_};
  return Result::under_way;
}

Length GapPassage::promised_width(const View& view) const noexcept {
  const Params& params = behaviours_.params;
  const int32_t cells = loses_walls(params.rangefinders) ? kUnsure : kSure;
  return (view.local_grid->reach().planning + grid_cell(params) * cells) * 2;
}

Speed GapPassage::pace() const noexcept {
  return behaviours_.params.wheels.max_speed * (promised_ ? 3 : 1) / 5;
}

Vec GapPassage::before(Length reference) const noexcept {
  return at_ - polar(ahead_, for_body(behaviours_.params, reference));
}

Vec GapPassage::rest(const View& view) const noexcept {
  return before(promised_ || moves_ > 0 ? kInFront : kSeenFrom) - view.pose.at;
}

GapPassage::Result GapPassage::move(const View& view, Decision& decision) noexcept {
  const Params& params = behaviours_.params;
  const Vec way = rest(view);
  if (farther(way, for_body(params, kThere)) && !behaviours_.stalled(view)) {
    decision.manoeuvre = steer(bearing(way) - view.pose.heading, pace(), params);
    return Result::under_way;
  }
  there_ = true;
  decision.manoeuvre = stop();
  enter(Phase::brake);
  return Result::under_way;
}

GapPassage::Result GapPassage::creep(const View& view, Decision& decision) noexcept {
  const Params& params = behaviours_.params;
  const Angle heading = way();
  const Vec off = view.pose.at - at_;
  const Length passed = along(off, heading);
  if (passed > for_body(params, returns_ ? kInFront : kBehind)) {
    if (!returns_) return Result::through;
    if (++lanes_ > kOtherLanes) return Result::failed;
    returns_ = opened_ = false;
    stops_ = 0;
    rounds_ = 1;
    enter(Phase::face);
    return Result::under_way;
  }
  if (behaviours_.stalled(view)) {
    sweeps_ = 0;
    ++stops_;
    if (stops_ <= kStops && (stops_ < 3 || farther(view.pose.at - stopped_, for_body(params, kOn)))) {
      enter(Phase::sweep);
    } else if (returns_) {
      return Result::failed;
    } else {
      returns_ = true;
      stops_ = 0;
      enter(Phase::face);
    }
    stopped_ = view.pose.at;
    return Result::under_way;
  }
  const Angle back = atan2(across(off, heading).raw(), for_body(params, kPursuit).raw());
  decision.manoeuvre = steer(heading + back - view.pose.heading, pace(), params);
  return Result::under_way;
}

}  // namespace whisker::planning
