#include "firmware/planning/scan_behaviour.hpp"

#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {

namespace {

constexpr Angle kAimed = 5_deg;
constexpr Angle kHeld = 1_deg;
constexpr Angle kPast = 2_deg;
constexpr Angle kUnbraked = 10_deg;
constexpr int8_t kSweeps = 4;

/// Less than the supervisor lets a body stand for a look.
bool waited_too_long(Duration waited, const Params& params) noexcept {
  return derived::outlasts_a_stall(waited, params) ||
         waited > derived::lost_after(params) * derived::kConsensusReads;
}

}  // namespace

void ScanBehaviour::begin(Angle heading, Length length, Manoeuvre& manoeuvre) noexcept {
  heading_ = heading;
  length_ = length;
  in_vain_ = false;
  cells_ = INT32_MAX;
  waited_for_ = Duration{};
  halt(manoeuvre);
}

void ScanBehaviour::halt(Manoeuvre& manoeuvre) noexcept {
  halting_ = true;
  manoeuvre = stop();
}

bool ScanBehaviour::step(const View& view, const Params& params, Manoeuvre& manoeuvre) noexcept {
  const Unseen rest = unseen(view, heading_, length_, view.pose.heading, params);
  if (rest.cells == 0) return true;
  if (view.local_grid->reach().past != Angle{}) return sweep(view, rest, params, manoeuvre);
  const Angle turn = rest.turn;
  const bool aimed = magnitude(turn) <= nearest_facing(kAimed, params).raw();
  if (aimed || (!halting_ && view.granted == Q14{})) waited_for_ += view.elapsed;
  in_vain_ = waited_too_long(waited_for_, params);
  if (in_vain_) return true;
  if (magnitude(turn) > nearest_facing(kHeld, params).raw()) {
    halting_ = false;
    manoeuvre = face(turn, params);
  } else if (!halting_) {
    halt(manoeuvre);
  }
  return false;
}

bool ScanBehaviour::sweep(const View& view, const Unseen& rest, const Params& params,
                          Manoeuvre& manoeuvre) noexcept {
  if (rest.cells < cells_) {
    cells_ = rest.cells;
    sweeps_ = 0;
    left_ = rest.turn.wrapped() > 0;
    aim_ = view.pose.heading + rest.turn;
  }
  const Angle past = view.local_grid->reach().past;
  const Angle turn = aim_ + (left_ ? past : -past) - view.pose.heading;
  const Angle beyond = turn + (left_ ? kUnbraked : -kUnbraked);
  if (view.granted == Q14{}) waited_for_ += view.elapsed;
  if ((left_ ? turn : -turn).wrapped() <= static_cast<int32_t>(nearest_facing(kPast, params).raw())) {
    left_ = !left_;
    ++sweeps_;
  }
  in_vain_ = sweeps_ >= kSweeps || derived::outlasts_a_stall(waited_for_, params);
  manoeuvre = face(beyond, params);
  return in_vain_;
}

}  // namespace whisker::planning
