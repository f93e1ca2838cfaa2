#include "firmware/mapper.hpp"

#ifndef WHISKER_SMALL

namespace whisker {

void GroundMapper::configure(const Params& params) noexcept {
  patch_.configure(params);
  witness_.configure(params);
  const Duration reach = params.rangefinders.latency + milliseconds(1000 / params.rangefinders.rate_hz);
  history_.configure(reach / (motion::History::kKept - 2));
}

void GroundMapper::place(const Pose& pose) noexcept {
  forget(pose);
  patch_.reset(pose);
}

void GroundMapper::forget(const Pose& pose) noexcept {
  history_.reset();
  patch_.forget(pose);
  witness_.reset();
  seen_ = 0;
  granted_ = Q14{};
  for (ranges::Scatter& scatter : scatter_) scatter = {};
}

void GroundMapper::observe(const Standing& body, const ranges::Conditioner& conditioner, const Params& params,
                           Proofs& proofs, nav::View& view) noexcept {
  history_.add(body.pose, body.now);
  patch_.move_to(body.pose);
  Length free[hal::kBeams];
  Length moved[hal::kBeams];
  const Length proving = proving_range(params.rangefinders);
  int seen = 0;
  for (int i = 0; i < hal::kBeams; ++i) {
    const ranges::Sight sight = conditioner.sight(i, params);
    view.sight.beam[i] = sight.typical;
    if (!sight.fresh) continue;
    view.sighted = true;
    ground::Proof& proof = proofs[i];
    if (!history_.at(sight.taken, proof.from)) continue;
    proof.axis = beam_axis(params.rangefinders.side_angle, i);
    scatter_[i].add(sight);
    proof.hit = sight.near.validity != ranges::Validity::clear && sight.near.distance <= proving;
    const Length allowance = proof.hit ? scatter_[i].allowance() : Length{};
    proof.free = free[i] = max(Length{}, min(sight.near.distance, proving) - allowance);
    proof.aimed = body.settled && sight.oldest - body.settled_since >= Duration{};
    proof.taken = sight.taken;
    if (proof.hit && witness_.contradicts(proof.from, i, proof.free, sight.farthest, patch_)) {
      moved[i] = sight.farthest;
    }
    const uint8_t bit = static_cast<uint8_t>(1U << i);
    // Only a reading of something is evidence by itself.
    if (!sight.clear) {
      patch_.mark(proof);
    } else if ((seen_ & bit) != 0) {
      patch_.mark(proof, &last_[i]);
    }
    last_[i] = {proof.from, proof.free};
    seen_ |= bit;
    view.proved = static_cast<uint8_t>(view.proved | bit);
    ++seen;
  }
  // After all marks: another beam may see ground as empty into which something is about to move.
  for (int i = 0; i < hal::kBeams; ++i) {
    if (moved[i] > Length{}) patch_.doubt(proofs[i], moved[i]);
  }
  if (seen == hal::kBeams) witness_.add(proofs[0].from, proofs[0].taken, free);
  view.proofs = proofs;
  view.patch = &patch_;
  view.granted = granted_;
}

void GroundMapper::guard(nav::Manoeuvre& manoeuvre, const Pose& pose, const motion::WheelState& wheels,
                         Duration elapsed, const Params& params) noexcept {
  if (manoeuvre.kind != nav::Kind::cruise) return;
  const motion::Grant grant = motion::shield(manoeuvre, pose, wheels, patch_, elapsed, params);
  manoeuvre.forward = grant.forward;
  manoeuvre.turning = grant.turning;
  granted_ = grant.factor;
}

}  // namespace whisker

#endif
