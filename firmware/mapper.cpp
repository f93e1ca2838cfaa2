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
  history_.reset();
  patch_.reset(pose);
  witness_.reset();
  for (ranges::Scatter& scatter : scatter_) scatter = {};
}

void GroundMapper::observe(const Standing& body, const ranges::Conditioner& conditioner, const Params& params,
                           Proofs& proofs, nav::View& view) noexcept {
  history_.add(body.pose, body.now);
  patch_.move_to(body.pose);
  Length free[hal::kBeams];
  Length moved[hal::kBeams];
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
    proof.hit = sight.near.validity != ranges::Validity::clear;
    const Length allowance = proof.hit ? scatter_[i].allowance() : Length{};
    proof.free = free[i] = max(Length{}, sight.near.distance - allowance);
    proof.aimed = body.settled && sight.oldest - body.settled_since >= Duration{};
    proof.taken = sight.taken;
    if (proof.hit && witness_.contradicts(proof.from, i, proof.free, sight.farthest, patch_)) {
      moved[i] = sight.farthest;
    }
    patch_.mark(proof);
    view.proved = static_cast<uint8_t>(view.proved | 1U << i);
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
                         const Params& params) noexcept {
  if (manoeuvre.kind != nav::Kind::cruise) return;
  const motion::Grant grant = motion::shield(manoeuvre, pose, wheels, patch_, params);
  manoeuvre.forward = grant.forward;
  manoeuvre.turning = grant.turning;
  granted_ = grant.factor;
}

}  // namespace whisker

#endif
