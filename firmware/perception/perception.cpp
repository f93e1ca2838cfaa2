#include "firmware/perception/perception.hpp"

namespace whisker::perception {

void Perception::configure(const Params& params) noexcept {
  local_grid_.configure(params);
  motion_.configure(params);
  const Duration reach = params.rangefinders.latency + milliseconds(1000 / params.rangefinders.rate_hz);
  history_.configure(reach / (localization::PoseHistory::kKept - 2));
}

void Perception::place(const Pose& pose) noexcept {
  forget(pose);
  local_grid_.reset(pose);
}

void Perception::forget(const Pose& pose) noexcept {
  history_.reset();
  local_grid_.forget(pose);
  motion_.reset();
  seen_ = 0;
  for (RangeScatter& scatter : scatter_) scatter = {};
}

void Perception::sense(const hal::RangeReadings* readings, Time now, Angle heading, const Params& params,
                       Health& health) noexcept {
  if (readings == nullptr) count(health.range_refused);
  conditioner_.update(readings, now, heading, params, health);
}

void Perception::observe(const Standing& body, const Params& params, Percept& out) noexcept {
  if (body.settled) out.static_scan = conditioner_.look(body.settled_since, params);
  history_.add(body.pose, body.now);
  local_grid_.move_to(body.pose);
  Length free[hal::kBeams];
  Length moved[hal::kBeams];
  const Length proving = proving_range(params.rangefinders);
  int seen = 0;
  for (int i = 0; i < hal::kBeams; ++i) {
    const RecentReadings sight = conditioner_.sight(i, params);
    out.moving_scan.beam[i] = sight.typical;
    if (!sight.fresh) continue;
    out.sighted = true;
    ConeObservation& observation = out.observations[i];
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
    // A single clear reading is not evidence: it needs a second one.
    if (!sight.clear) {
      local_grid_.mark(observation);
    } else if ((seen_ & bit) != 0) {
      local_grid_.mark(observation, &last_[i]);
    }
    last_[i] = {observation.from, observation.free};
    seen_ |= bit;
    out.observed = static_cast<uint8_t>(out.observed | bit);
    ++seen;
  }
  // After all marks, because another beam may clear ground into which a moving object is about to drive.
  for (int i = 0; i < hal::kBeams; ++i) {
    if (moved[i] > Length{}) local_grid_.doubt(out.observations[i], moved[i]);
  }
  if (seen == hal::kBeams) motion_.add(out.observations[0].from, out.observations[0].taken, free);
  out.local_grid = &local_grid_;
}

}  // namespace whisker::perception
