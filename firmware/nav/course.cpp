#include "firmware/nav/course.hpp"

#include "firmware/fuzzy/scale.hpp"
#include "firmware/nav/ways.hpp"

namespace whisker::nav {
namespace {

constexpr Angle kStep = Angle::turns(1, kFan);
constexpr int32_t kSteps = 10;  // to 75 degrees
constexpr uint32_t kStraight = (1_deg).raw();

}  // namespace

Angle TableBend::bend(const ranges::Echoes& sight, const Params& params, Decision& decision) noexcept {
  decision.inputs = fuzzy::scale(sight.beam[hal::kLeft].distance, sight.beam[hal::kFront].distance,
                                 sight.beam[hal::kRight].distance, params.rangefinders.max_range,
                                 params.thesis.distance_source);
  decision.response = engine_(decision.inputs);
  return scaled(params.thesis.base_turn, decision.response.turn);
}

/// Bends quickly and straightens slowly, so that the course does not swing about what it passes.
void Course::bend_towards(Angle wanted) noexcept {
  const int64_t change = int64_t{wanted.wrapped()} - bend_;
  const bool grows = magnitude(wanted.wrapped()) > magnitude(bend_);
  bend_ += static_cast<int32_t>(grows ? change * 3 / 10 : change * 3 / 50);
}

bool Course::choose(const View& view, const Vec& to_goal, BendLaw& law, const Params& params, Side& wall,
                    Decision& decision) noexcept {
  const Length distance = norm(to_goal);
  const Angle target = bearing(to_goal);
  const Angle bend = law.bend(view.sight, params, decision);
  bend_towards(view.sight.beam[hal::kFront].distance >= distance ? Angle{} : bend);

  const Reach& reach = view.patch->reach();
  const auto passable = [&](Angle heading) {
    heading_ = heading;
    return way(view, heading, min(reach.probe, distance), reach.planning) != Way::blocked;
  };
  decision.why = magnitude(bend_) > kStraight ? Why::table : Why::target_free;
  if (passable(target + Angle::from_raw(static_cast<uint32_t>(bend_)))) return true;
  decision.why = Why::narrow;
  if (passable(target)) return true;
  for (int32_t i = 1; i <= kSteps; ++i) {
    const Angle off = kStep * (i * sign(wall));
    if (passable(target - off)) return true;
    if (passable(target + off)) {
      wall = opposite(wall);
      return true;
    }
  }
  return false;
}

}  // namespace whisker::nav
