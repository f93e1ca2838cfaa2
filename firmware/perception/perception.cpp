#include "firmware/perception/perception.hpp"

#ifndef WHISKER_SMALL

namespace whisker::perception {

void LocalPerception::configure(const Params& params) noexcept {
  local_grid_.configure(params);
  motion_.configure(params);
  const Duration reach = params.rangefinders.latency + milliseconds(1000 / params.rangefinders.rate_hz);
  history_.configure(reach / (localization::PoseHistory::kKept - 2));
}

void LocalPerception::place(const Pose& pose) noexcept {
  forget(pose);
  local_grid_.reset(pose);
}

void LocalPerception::forget(const Pose& pose) noexcept {
  history_.reset();
  local_grid_.forget(pose);
  motion_.reset();
  seen_ = 0;
  granted_ = Q14{};
  for (RangeScatter& scatter : scatter_) scatter = {};
}

void LocalPerception::observe(const Standing& body, const RangeConditioner& conditioner, const Params& params,
                              ConeObservations& observations, planning::View& view) noexcept {
  history_.add(body.pose, body.now);
  local_grid_.move_to(body.pose);
  Length free[hal::kBeams];
  Length moved[hal::kBeams];
  const Length proving = proving_range(params.rangefinders);
  int seen = 0;
  for (int i = 0; i < hal::kBeams; ++i) {
    const RecentReadings sight = conditioner.sight(i, params);
    view.moving_scan.beam[i] = sight.typical;
    if (!sight.fresh) continue;
    view.sighted = true;
    ConeObservation& observation = observations[i];
    if (!history_.at(sight.taken, observation.from)) continue;
    observation.axis = beam_axis(params.rangefinders.side_angle, i);
    scatter_[i].add(sight);
    observation.hit = sight.near.validity != Validity::clear && sight.near.distance <= proving;
    const Length allowance = observation.hit ? scatter_[i].allowance() : Length{};
    observation.free = free[i] = max(Length{}, min(sight.near.distance, proving) - allowance);
    observation.aimed = body.settled && sight.oldest - body.settled_since >= Duration{};
    observation.taken = sight.taken;
    if (observation.hit &&
        motion_.contradicts(observation.from, i, observation.free, sight.farthest, local_grid_)) {
      moved[i] = sight.farthest;
    }
    const uint8_t bit = static_cast<uint8_t>(1U << i);
    // Only a reading of something is evidence by itself.
    if (!sight.clear) {
      local_grid_.mark(observation);
    } else if ((seen_ & bit) != 0) {
      local_grid_.mark(observation, &last_[i]);
    }
    last_[i] = {observation.from, observation.free};
    seen_ |= bit;
    view.proved = static_cast<uint8_t>(view.proved | bit);
    ++seen;
  }
  // After all marks: another beam may see ground as empty into which something is about to move.
  for (int i = 0; i < hal::kBeams; ++i) {
    if (moved[i] > Length{}) local_grid_.doubt(observations[i], moved[i]);
  }
  if (seen == hal::kBeams) motion_.add(observations[0].from, observations[0].taken, free);
  view.observations = observations;
  view.local_grid = &local_grid_;
  view.granted = granted_;
}

void LocalPerception::guard(planning::Manoeuvre& manoeuvre, const Pose& pose, const WheelState& wheels,
                            Duration elapsed, const Params& params) noexcept {
  if (manoeuvre.kind != planning::ManoeuvreKind::cruise) return;
  const safety::Grant grant = safety::guard(manoeuvre, pose, wheels, local_grid_, elapsed, params);
  manoeuvre.forward = grant.forward;
  manoeuvre.turning = grant.turning;
  granted_ = grant.factor;
}

}  // namespace whisker::perception

#endif
