#include "firmware/planning/boundary/gap_passage.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

// All lengths are for the reference body.
constexpr int8_t kAttempts = 8;
constexpr int8_t kHere = 2;
constexpr Length kElsewhere = 150_mm;
constexpr AngularRate kSweepRate = 250_mrad_per_s;
constexpr AngularRate kGlanceRate = 500_mrad_per_s;
constexpr Angle kSweep = 75_deg;
constexpr Angle kGlance = 50_deg;  // from within the lane
constexpr int8_t kSweeps = 4;
constexpr int8_t kRounds = 8;
constexpr int8_t kStops = 8;
constexpr int8_t kReturns = 1;
constexpr Length kDrop = 40_mm;  // of a reading, at a jamb
constexpr Length kFarJamb = 600_mm;
constexpr Length kJambs = 450_mm;    // farthest from each other
constexpr Length kInFront = 250_mm;  // of the gap
constexpr Length kLane = 200_mm;     // the same, for the begin of the lane
constexpr Length kNear = 60_mm;      // the place from which it was seen
constexpr Length kThere = 3_mm;
constexpr Length kBeside = 8_mm;  // the place in front of the gap
constexpr int8_t kMoves = 4;
constexpr Length kBehind = 125_mm;  // the gap: the body has passed it
constexpr Length kOff = 1_mm;       // of the lane from the middle of the jambs
constexpr Angle kAstray = 25_deg;   // of the first heading from the middle of the gap
constexpr Angle kTilted = 2_deg;
constexpr Length kPursuit = 60_mm;

constexpr int index(Side side) noexcept { return side == Side::left ? 0 : 1; }

}  // namespace

bool GapPassage::elsewhere(Vec at) const noexcept {
  return farther(at - at_, for_body(behaviours_.params, kElsewhere));
}

bool GapPassage::worth_trying(Vec at) const noexcept {
  return attempts_ < kAttempts && (here_ < kHere || elsewhere(at));
}

void GapPassage::enter(Phase phase) noexcept {
  phase_ = phase;
  behaviours_.enter();
  last_ = Length{};
}

void GapPassage::begin(const View& view, const Pose& gap, Decision& decision) noexcept {
  enter(Phase::brake);
  ++attempts_;
  here_ = static_cast<int8_t>(elsewhere(gap.at) ? 1 : here_ + 1);
  at_ = gap.at;
  ahead_ = gap.heading;
  came_along_ = view.pose.heading;
  sweeps_ = rounds_ = stops_ = 0;
  seen_ = 0;
  moves_ = returns_ = 0;
  there_ = opened_ = false;
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
      if (!turn_by(ahead_ - view.pose.heading, behaviours_.params, decision.manoeuvre)) break;
      if (opened_) {
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
  decision.manoeuvre = cruise({Speed{}, (stops_ > 0 ? kGlanceRate : kSweepRate) * sign(side_)}, params);
  const Angle most = stops_ > 0 ? kGlance : kSweep;
  bool ends = ((view.pose.heading - ahead_) * sign(side_)).wrapped() > static_cast<int32_t>(most.raw());
  const perception::ConeObservation& front = view.observations[hal::kFront];
  if ((view.observed >> hal::kFront & 1U) != 0) {
    const Length drop = for_body(params, kDrop);
    const Angle edge = front.beam.axis + front.beam.half_cone * sign(side_);
    const bool own_side = ((edge - ahead_) * sign(side_)).wrapped() > -static_cast<int32_t>(kAstray.raw());
    if (front.hit && own_side && last_ > front.free + drop && front.free < for_body(params, kFarJamb)) {
      jambs_[index(side_)] = front.beam.apex + polar(edge, front.free);
      seen_ = static_cast<uint8_t>(seen_ | 1U << index(side_));
      ends = true;
    }
    last_ = front.free;
  }
  if (!ends) return Result::under_way;
  last_ = Length{};
  side_ = opposite(side_);
  if (stops_ > 0) {
    if (++sweeps_ == 2) enter(Phase::face);
    return Result::under_way;
  }
  if (seen_ == 3) return measured(view, decision);
  return ++sweeps_ < kSweeps ? Result::under_way : Result::failed;
}

GapPassage::Result GapPassage::measured(const View& view, Decision& decision) noexcept {
  const Params& params = behaviours_.params;
  const Vec across_gap = jambs_[0] - jambs_[1];
  const Length width = norm(across_gap);
  // From aside, the jambs may seem to be nearer to each other than they are.
  const Length half = view.local_grid->lane().half_width();
  if (width < (moves_ > 0 ? half * 2 : half) || width > for_body(params, kJambs)) return Result::failed;
  Vec at{(jambs_[0].x + jambs_[1].x) / 2, (jambs_[0].y + jambs_[1].y) / 2};
  Angle ahead = bearing(across_gap) - 90_deg;
  // Round jambs seem to turn away from the body. Half of the change meets the middle between them.
  if (rounds_ > 0) {
    at = {(at.x + at_.x) / 2, (at.y + at_.y) / 2};
    ahead = ahead_ + Angle::from_raw(static_cast<uint32_t>((ahead - ahead_).wrapped() / 2));
  }
  const bool same =
      opened_ && !farther(at - at_, for_body(params, kOff)) && magnitude(ahead - ahead_) < kTilted.raw();
  at_ = at;
  ahead_ = ahead;
  if (same) {
    enter(Phase::face);
    return Result::under_way;
  }
  if (++rounds_ > kRounds) return Result::failed;
  seen_ = 0;
  sweeps_ = 0;
  if (moves_ < kMoves && farther(before(kInFront) - view.pose.at, for_body(params, kBeside))) {
    ++moves_;
    opened_ = false;
    enter(Phase::aim);
    return Result::under_way;
  }
  opened_ = true;
  decision.opens_lane = true;
  decision.lane = {before(kLane), ahead_};
  return Result::under_way;
}

Vec GapPassage::before(Length reference) const noexcept {
  return at_ - polar(ahead_, for_body(behaviours_.params, reference));
}

Vec GapPassage::rest(const View& view) const noexcept {
  return before(moves_ == 0 ? kSeenFrom : kInFront) - view.pose.at;
}

GapPassage::Result GapPassage::move(const View& view, Decision& decision) noexcept {
  const Params& params = behaviours_.params;
  const Vec way = rest(view);
  if (farther(way, for_body(params, kThere)) && !behaviours_.stalled(view)) {
    decision.manoeuvre = steer(bearing(way) - view.pose.heading, params.wheels.max_speed / 5, params);
    return Result::under_way;
  }
  there_ = true;
  decision.manoeuvre = stop();
  enter(Phase::brake);
  return returns_ > kReturns ? Result::failed : Result::under_way;
}

GapPassage::Result GapPassage::creep(const View& view, Decision& decision) noexcept {
  const Params& params = behaviours_.params;
  const Vec off = view.pose.at - at_;
  if (along(off, ahead_) > for_body(params, kBehind)) return Result::through;
  if (behaviours_.stalled(view)) {
    seen_ = 0;
    sweeps_ = 0;
    if (++stops_ > kStops) {
      // Back to the place in front: for another lane, or to leave the gap.
      ++returns_;
      stops_ = 0;
      rounds_ = 1;
      opened_ = false;
      enter(Phase::aim);
    } else {
      enter(Phase::sweep);
    }
    return Result::under_way;
  }
  const Angle back = atan2(across(off, ahead_).raw(), for_body(params, kPursuit).raw());
  decision.manoeuvre = steer(ahead_ + back - view.pose.heading, params.wheels.max_speed / 5, params);
  return Result::under_way;
}

}  // namespace whisker::planning
