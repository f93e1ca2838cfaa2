#include "firmware/perception/perception.hpp"

namespace whisker::perception {
namespace {

constexpr Length kAppears = 50_mm;  // nearer than the reading before: another object

}  // namespace

void Perception::configure(const Params& params) noexcept {
  loses_walls_ = params.rangefinders.incidence.raw() < (90_deg).raw();
  for (int i = 0; i < hal::kBeams; ++i) mounts_[i] = mount(params.rangefinders, i);
  local_grid_.configure(params);
  contacts_.configure(params.body.radius);
  motion_.configure(mounts_);
  const Duration reach = params.rangefinders.latency + milliseconds(1000 / params.rangefinders.rate_hz);
  history_.configure(reach / (localization::PoseHistory::kKept - 2));
}

void Perception::forget(const Pose& pose) noexcept {
  history_.reset();
  local_grid_.reset(pose);
  contacts_.reset();
  motion_.reset();
  seen_ = 0;
  contradicted_ = 0;
  misses_ = false;
  for (Contradiction& contradiction : contradictions_) contradiction = {};
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
  bool appears[hal::kBeams] = {};
  bool measured[hal::kBeams] = {};
  Pose from;
  int seen = 0;
  for (int i = 0; i < hal::kBeams; ++i) {
    const RecentReadings sight = conditioner_.sight(i, params);
    out.moving_scan.beam[i] = sight.typical;
    if (!sight.fresh) continue;
    out.sighted = true;
    ConeObservation& observation = out.observations[i];
    if (!history_.at(sight.taken, from)) continue;
    observation.number = static_cast<int8_t>(i);
    observation.beam = beam_of(mounts_[i], from);
    const Length proving = proving_range(params.rangefinders, i);
    scatter_[i].add(sight);
    misses_ = misses_ || sight.misses;
    // What contradicted was a phantom.
    if (sight.phantoms) contradicted_ = 0;
    observation.hit = sight.near.validity != Validity::clear && sight.near.distance <= proving;
    const Length allowance = observation.hit ? scatter_[i].allowance() : Length{};
    observation.free = free[i] = max(Length{}, min(sight.near.distance, proving) - allowance);
    observation.aimed = body.settled && sight.oldest - body.settled_since >= Duration{};
    observation.taken = sight.taken;
    if (observation.hit &&
        motion_.contradicts(observation.beam, observation.free, sight.farthest, local_grid_)) {
      const bool approaches = contradictions_[i].approaches(observation);
      const bool anew = !local_grid_.doubting() && !approaches && !sight.phantoms;
      if (anew && contradicted_ < kDistrusted) contradicted_ = static_cast<uint8_t>(contradicted_ + 3);
      const bool explained = loses_walls_ || misses_ || sight.phantoms;
      if (approaches || !explained) moved[i] = sight.farthest;
    }
    const uint8_t bit = static_cast<uint8_t>(1U << i);
    // A single clear reading is not evidence: it needs a second one.
    const EarlierObservation* const before = sight.single ? &last_[i] : nullptr;
    if (!sight.single || (seen_ & bit) != 0) {
      local_grid_.mark(observation, before);
      local_grid_.chain(observation, before);
    }
    measured[i] = sight.measured;
    appears[i] = (seen_ & bit) != 0 && last_[i].free > observation.free + kAppears;
    last_[i] = {observation.beam.apex, observation.beam.axis, observation.free};
    seen_ |= bit;
    out.observed = static_cast<uint8_t>(out.observed | bit);
    ++seen;
  }
  // After all marks, because another beam may clear ground that an echo takes back, or into which a moving
  // object is about to drive.
  for (int i = 0; i < hal::kBeams; ++i) {
    const bool echo = (out.observed >> i & 1U) != 0 && out.observations[i].hit;
    if (echo && (doubts() || measured[i] || (appears[i] && i != hal::kFront))) {
      local_grid_.revoke(out.observations[i], appears[i]);
    }
    if (moved[i] > Length{}) local_grid_.doubt(out.observations[i], moved[i]);
  }
  for (int i = 0; i < contacts_.count(); ++i) local_grid_.block(contacts_.at(i), contacts_.radius());
  if (seen == hal::kBeams) motion_.add(from, out.observations[0].taken, free);
  out.doubts = doubts();
  out.local_grid = &local_grid_;
  out.contacts = &contacts_;
}

}  // namespace whisker::perception
