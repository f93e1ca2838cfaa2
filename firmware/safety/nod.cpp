#include "firmware/safety/nod.hpp"

#include "firmware/params/relations.hpp"
#include "firmware/perception/observation.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::safety {
namespace {

constexpr Q14 kEnough = Q14::ratio(1, 1);  // granted share that needs no nod
constexpr Duration kHeld = 20_ms;          // held back for this long
constexpr Duration kLongest = 2500_ms;
constexpr Duration kLongestBack = 1500_ms;
constexpr Duration kSettles = 100_ms;  // a covered cell becomes clear within two readings and their latency
constexpr int8_t kTries = 3;
constexpr int32_t kMostSuspect = 4;  // more near an echo are an obstacle
constexpr Angle kBack = 1_deg;
constexpr Angle kSlow = Angle::turns(1, 1800);  // in a tick
constexpr Angle kMostBend = 40_deg;
constexpr Angle kEdge = 1_deg;    // a beam sees a cell that is completely inside its edge by this much
constexpr Angle kBeyond = 2_deg;  // it turns on for this much

/// Braking from full speed: unseen ground beyond it holds nothing yet.
Length braking_way(const Params& p) noexcept { return relations::stopping_distance(p); }

/// The direction of the chord of the asked arc over this length, from straight ahead.
Angle chord(const planning::VelocityRequest& asked, Length length, const Params& p) noexcept {
  const int64_t rim = multiply_divide(asked.turning.raw(), length.raw(), asked.forward.raw());
  const Angle turn = angle_of(limit(Length::from_raw(saturate32(rim)), p.body.track / 2), p.body.track);
  const int32_t most = kMostBend.wrapped();
  const int32_t half = turn.wrapped();
  return Angle::from_raw(static_cast<uint32_t>(half > most ? most : half < -most ? -most : half));
}

}  // namespace

void Nod::enter(Phase phase) noexcept {
  planning::follow(kArrows, phase_, phase);
  for_ = covered_for_ = Duration{};
}

Nod::Unseen Nod::unseen(const Pose& pose, const perception::LocalGrid& grid,
                        const Params& params) const noexcept {
  perception::Beam beams[3];
  for (int i = 0; i < 3; ++i) beams[i] = perception::beam_of(mount(params.rangefinders, i), pose);
  Unseen found;
  const auto see = [&](const Vec& cell) {
    found.any = true;
    Angle least[2];
    for (const perception::Beam& beam : beams) {
      const Vec to = pose.at + cell - beam.apex;
      const Angle off = bearing(to) - beam.axis;
      const Angle half_cell = angle_of(cell_cover(params), norm(to) + micrometres(1)) + kEdge;
      const uint32_t inside = half_cell.raw() * (1U + static_cast<uint32_t>(tries_));
      const Angle edge = Angle::from_raw(beam.half_cone.raw() > inside ? beam.half_cone.raw() - inside : 0);
      if (magnitude(off) <= edge.raw()) {
        found.covered = true;
        return;
      }
      const int side = off.wrapped() < 0 ? 1 : 0;
      const Angle turn = side == 1 ? off + edge : off - edge;
      if (least[side] == Angle{} || magnitude(turn) < magnitude(least[side])) least[side] = turn;
    }
    for (int side = 0; side < 2; ++side) {
      Angle& best = found.turn[side];
      if (least[side] == Angle{}) continue;
      // The other way round is nearer.
      if (least[1 - side] != Angle{} && magnitude(least[1 - side]) < magnitude(least[side])) continue;
      if (best == Angle{} || magnitude(least[side]) > magnitude(best)) best = least[side];
    }
  };
  grid.each_unclear(pose.at, way_, braking_way(params), grid.reach().guard, see);
  return found;
}

bool Nod::needed(const planning::VelocityRequest& asked, Q14 granted, const Pose& pose,
                 const perception::LocalGrid& grid, Duration elapsed, const Params& params) noexcept {
  const bool ahead = asked.forward > Speed{} && abs(asked.turning) <= asked.forward / 2;
  for_ = ahead && granted < kEnough ? for_ + elapsed : Duration{};
  if (!ahead || for_ < kHeld) return false;
  const Length length = braking_way(params);
  heading_ = pose.heading;
  way_ = heading_ + chord(asked, length, params);
  const perception::Obstacles way = grid.along(pose.at, way_, length, grid.reach().guard);
  return way.unknown + way.suspect > 0 && way.suspect <= kMostSuspect;
}

planning::VelocityRequest Nod::step(const planning::VelocityRequest& asked, Q14 granted, const Pose& pose,
                                    const perception::LocalGrid& grid, Duration elapsed,
                                    const Params& params) noexcept {
  if (!asked.moves || asked.forward < Speed{}) {
    enter(Phase::off);
    return asked;
  }
  if (phase_ == Phase::off) {
    if (!needed(asked, granted, pose, grid, elapsed, params)) return asked;
    enter(Phase::look);
    const Unseen cells = unseen(pose, grid, params);
    right_ = cells.turn[1] != Angle{} &&
             (cells.turn[0] == Angle{} || magnitude(cells.turn[1]) < magnitude(cells.turn[0]));
  }
  for_ += elapsed;
  planning::VelocityRequest request = asked;
  if (phase_ == Phase::look) {
    if (look(pose, grid, elapsed, params, request.turning)) return request;
    enter(Phase::back);
  }
  if (!turn_back(pose, params, request.turning)) enter(Phase::off);
  return request;
}

/// False: it has looked for long enough, or all cells are clear.
bool Nod::look(const Pose& pose, const perception::LocalGrid& grid, Duration elapsed, const Params& params,
               Speed& turning) noexcept {
  const Unseen cells = unseen(pose, grid, params);
  const bool turns = cells.turn[0] != Angle{} || cells.turn[1] != Angle{};
  covered_for_ = turns || !cells.any ? Duration{} : covered_for_ + elapsed;
  if (!cells.any || covered_for_ > kSettles || for_ >= kLongest) {
    tries_ = static_cast<int8_t>(!cells.any ? 0 : tries_ < kTries ? tries_ + 1 : 0);
    return false;
  }
  if (turns && cells.turn[right_ ? 1 : 0] == Angle{}) right_ = !right_;
  const Angle turn = cells.turn[right_ ? 1 : 0] + (right_ ? -kBeyond : kBeyond);
  turning = turns ? planning::face(turn, params).turning : Speed{};
  return true;
}

/// `turning`: what is asked, and becomes the nod's. False: it is back, or leaves the turning to the operator.
bool Nod::turn_back(const Pose& pose, const Params& params, Speed& turning) noexcept {
  const Angle rest = heading_ - pose.heading;
  const planning::Manoeuvre back = planning::face(rest, params);
  // Fast, it would turn beyond it.
  const bool slow = magnitude(pose.heading - last_heading_) < kSlow.raw();
  last_heading_ = pose.heading;
  if (slow && magnitude(rest) < planning::nearest_facing(kBack, params).raw()) return false;
  if (for_ > kLongestBack || abs(turning) > abs(back.turning) / 4) return false;
  turning = back.turning;
  return true;
}

}  // namespace whisker::safety
