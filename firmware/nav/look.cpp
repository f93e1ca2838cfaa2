#include "firmware/nav/look.hpp"

#include "firmware/nav/steering.hpp"
#include "firmware/nav/ways.hpp"

namespace whisker::nav {

namespace {

constexpr Angle kAimed = 5_deg;

}  // namespace

void Look::begin(Manoeuvre& manoeuvre) noexcept {
  in_vain_ = false;
  aimed_for_ = Duration{};
  halt(manoeuvre);
}

void Look::halt(Manoeuvre& manoeuvre) noexcept {
  halting_ = true;
  manoeuvre = stop();
}

bool Look::step(const View& view, Angle heading, Length length, const Params& params,
                Manoeuvre& manoeuvre) noexcept {
  Angle turn;
  if (!turn_to_unseen(view, heading, length, view.pose.heading, params, turn)) return true;
  if (magnitude(turn) <= nearest_facing(kAimed, params).raw()) aimed_for_ += view.elapsed;
  in_vain_ = aimed_for_ > params.safety.stalled_after;
  if (in_vain_) return true;
  if (magnitude(turn) > (1_deg).raw()) {
    halting_ = false;
    manoeuvre = cruise(face(turn), params);
  } else if (!halting_) {
    halt(manoeuvre);
  }
  return false;
}

}  // namespace whisker::nav
