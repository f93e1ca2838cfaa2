#include "host/baselines/gait.hpp"

#include "firmware/nav/steering.hpp"
#include "firmware/nav/ways.hpp"

namespace whisker::baselines {

nav::Manoeuvre stop() {
  nav::Manoeuvre m;
  m.kind = nav::Kind::stop;
  return m;
}

bool face(const nav::View& view, Angle heading, const Params& params, nav::Manoeuvre& manoeuvre) {
  const Angle error = heading - view.pose.heading;
  manoeuvre = nav::cruise(nav::face(error), params);
  return magnitude(error) < (3_deg).raw();
}

bool Stall::stalled(const nav::View& view, const Params& params) {
  constexpr std::int32_t kTicks = 50;
  const bool turns = abs(view.turning) > AngularRate{300_mrad_per_s} * (params.body.track / 2);
  const bool wanted = turns || view.granted == Q14::ratio(1, 1);
  slow_ticks_ = view.forward < 20_mm_per_s ? slow_ticks_ + (wanted ? 1 : 4) : 0;
  return slow_ticks_ >= kTicks;
}

bool Look::step(const nav::View& view, Angle heading, Length length, const Params& params,
                nav::Manoeuvre& manoeuvre) {
  Angle turn;
  if (!nav::turn_to_unseen(view, heading, length, view.pose.heading, params, turn)) return true;
  if (magnitude(turn) > (1_deg).raw()) {
    halting_ = false;
    manoeuvre = nav::cruise(nav::face(turn), params);
  } else if (!halting_) {
    halting_ = true;
    manoeuvre = stop();
  }
  return false;
}

}  // namespace whisker::baselines
