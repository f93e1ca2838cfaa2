#include "firmware/nav/look.hpp"

#include "firmware/nav/steering.hpp"
#include "firmware/nav/ways.hpp"

namespace whisker::nav {

void Look::begin(Manoeuvre& manoeuvre) noexcept {
  halting_ = true;
  manoeuvre = stop();
}

bool Look::step(const View& view, Angle heading, Length length, const Params& params,
                Manoeuvre& manoeuvre) noexcept {
  Angle turn;
  if (!turn_to_unseen(view, heading, length, view.pose.heading, params, turn)) return true;
  if (magnitude(turn) > (1_deg).raw()) {
    halting_ = false;
    manoeuvre = cruise(face(turn), params);
  } else if (!halting_) {
    begin(manoeuvre);
  }
  return false;
}

}  // namespace whisker::nav
