#include "host/baselines/gait.hpp"

#include <initializer_list>

namespace whisker::baselines {
namespace {

constexpr AngularRate kTurnRate = 2500_mrad_per_s;

AngularRate rate_towards(Angle error, std::int32_t gain) {
  constexpr std::int64_t kMicroradians = 6283185;  // a turn
  return AngularRate::from_raw(saturate32(scale_down<32>(error.wrapped() * kMicroradians) * gain));
}

/// Less forward speed beside more turning: none left at `most`.
Speed slower(Speed top, AngularRate turn, AngularRate most) {
  const std::int32_t rest = most.raw() - abs(turn).raw();
  return rest <= 0 ? Speed{} : Speed::from_raw(multiply_divide(top.raw(), rest, most.raw()));
}

}  // namespace

Way way(const nav::View& view, Angle heading, Length length, Length margin, const Params& params) {
  const ground::Obstacles o = view.patch->along(view.pose.at, heading, length, params.body.radius + margin);
  if (o.suspect > 0) return Way::blocked;
  return o.unknown > 0 ? Way::open : Way::free;
}

nav::Manoeuvre stop() {
  nav::Manoeuvre m;
  m.kind = nav::Kind::stop;
  return m;
}

nav::Manoeuvre cruise(Speed forward, AngularRate turn, const Params& params) {
  nav::Manoeuvre m;
  m.kind = nav::Kind::cruise;
  m.forward = forward;
  m.turning = turn * (params.body.track / 2);
  return m;
}

nav::Manoeuvre steer(const nav::View& view, Angle heading, Speed top, const Params& params) {
  const Angle error = heading - view.pose.heading;
  return cruise(slower(top, rate_towards(error, 1), 833_mrad_per_s), limit(rate_towards(error, 6), kTurnRate),
                params);
}

nav::Manoeuvre face(const nav::View& view, Angle heading, const Params& params) {
  return cruise(Speed{}, limit(rate_towards(heading - view.pose.heading, 5), kTurnRate), params);
}

bool faces(const nav::View& view, Angle heading) {
  return magnitude(heading - view.pose.heading) < (3_deg).raw();
}

nav::Manoeuvre along_wall(const nav::View& view, std::int32_t side, const Params& params) {
  const RangefinderParams& r = params.rangefinders;
  const Q30 abeam = sin(r.side_angle + Angle::from_raw(r.cone.raw() / 2));
  const Length left = view.sight.beam[hal::kLeft].distance * abeam;
  const Length right = view.sight.beam[hal::kRight].distance * abeam;
  const Length wall = side > 0 ? left : right;
  const Length error = max(-100_mm, min(wall - min(150_mm, (left + right) / 2), 60_mm));
  const Length near = max(Length{}, 300_mm - view.sight.beam[hal::kFront].distance);
  const AngularRate turn = limit(AngularRate::from_raw((error * 20).raw() - (near * 15).raw()), kTurnRate);
  const bool round_an_end = error == 60_mm && near == Length{};
  const Speed forward =
      round_an_end ? abs(turn) * 180_mm : slower(params.wheels.max_speed, turn, 4000_mrad_per_s);
  return cruise(forward, turn * side, params);
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
  const ground::Obstacles o =
      view.patch->along(view.pose.at, heading, length, params.body.radius + params.skirt.planning_margin);
  if (o.suspect > 0 || o.unknown == 0) return true;
  const Angle to_cell = bearing(o.nearest_unknown);
  const Angle side = params.rangefinders.side_angle;
  Angle error = to_cell - view.pose.heading;
  for (const Angle axis : {side, -side}) {
    const Angle e = to_cell - axis - view.pose.heading;
    if (magnitude(e) < magnitude(error)) error = e;
  }
  if (magnitude(error) > (1_deg).raw()) {
    halting_ = false;
    manoeuvre = face(view, view.pose.heading + error, params);
  } else if (!halting_) {
    halting_ = true;
    manoeuvre = stop();
  }
  return false;
}

}  // namespace whisker::baselines
