#include "host/harness/sim/spec.hpp"

#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/si.hpp"

namespace whisker::sim {

RobotSpec robot_spec(const Params& params) {
  RobotSpec spec;
  spec.radius = si(params.body.radius);
  spec.track = si(params.body.track);
  spec.max_speed = si(params.wheels.max_speed);
  spec.max_acceleration = si(params.wheels.max_acceleration);
  spec.motor_lag = si(params.wheels.motor_lag);
  spec.counts_per_m = params.wheels.counts_per_metre;
  spec.wheel_ratio = params.wheels.ratio.raw() * 1e-6;
  for (int i = 0; i < 3; ++i) {
    const RangefinderParams& r = params.rangefinders;
    const Vec2 own{si(r.beams[i].x), si(r.beams[i].y)};
    const double axis = si(beam_axis(r, i));
    const SinCos direction = sin_cos(axis);
    const bool radial = own.x == 0 && own.y == 0;
    spec.beams[i] = {radial ? si(r.offset) * direction.cos : own.x,
                     radial ? si(r.offset) * direction.sin : own.y,
                     axis,
                     si(beam_cone(r, i)) / 2,
                     si(r.min_range),
                     si(r.max_range)};
  }
  spec.rate_hz = params.rangefinders.rate_hz;
  spec.latency_s = si(params.rangefinders.latency);
  spec.bumper = params.bumper.fitted == Fitted::yes;
  spec.gyro = params.gyro.fitted == Fitted::yes;
  spec.gyro_range = si(params.gyro.range);
  spec.gyro_rate_hz = params.gyro.rate_hz;
  spec.period_s = si(params.safety.period);
  return spec;
}

}  // namespace whisker::sim
