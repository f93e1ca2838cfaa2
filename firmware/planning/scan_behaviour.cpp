#include "firmware/planning/scan_behaviour.hpp"

#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {

namespace {

constexpr Angle kAimed = 5_deg;

}  // namespace

void ScanBehaviour::begin(Angle heading, Length length, Manoeuvre& manoeuvre) noexcept {
  heading_ = heading;
  length_ = length;
  in_vain_ = false;
  waited_for_ = Duration{};
  halt(manoeuvre);
}

void ScanBehaviour::halt(Manoeuvre& manoeuvre) noexcept {
  halting_ = true;
  manoeuvre = stop();
}

bool ScanBehaviour::step(const View& view, const Params& params, Manoeuvre& manoeuvre) noexcept {
  Angle turn;
  if (!turn_to_unseen(view, heading_, length_, view.pose.heading, params, turn)) return true;
  const bool aimed = magnitude(turn) <= nearest_facing(kAimed, params).raw();
  if (aimed || (!halting_ && view.granted == Q14{})) waited_for_ += view.elapsed;
  in_vain_ = waited_for_ > params.safety.stalled_after;
  if (in_vain_) return true;
  if (magnitude(turn) > (1_deg).raw()) {
    halting_ = false;
    manoeuvre = face(turn, params);
  } else if (!halting_) {
    halt(manoeuvre);
  }
  return false;
}

}  // namespace whisker::planning
