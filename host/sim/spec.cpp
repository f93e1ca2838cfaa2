#include "host/sim/spec.hpp"

namespace whisker::sim {
namespace {

double si(Length x) { return x.raw() / 1e6; }
double si(Speed x) { return x.raw() / 1e6; }
double si(Acceleration x) { return x.raw() / 1e6; }
double si(Duration x) { return x.raw() / 1e3; }
double si(Angle x) { return x.wrapped() * (kPi * 0x1p-31); }

}  // namespace

RobotSpec robot_spec(const Params& params) {
  RobotSpec spec;
  spec.radius = si(params.body.radius);
  spec.track = si(params.body.track);
  spec.max_speed = si(params.wheels.max_speed);
  spec.max_acceleration = si(params.wheels.max_acceleration);
  spec.motor_lag = si(params.wheels.motor_lag);
  spec.counts_per_m = params.wheels.counts_per_metre;
  spec.side_angle = si(params.rangefinders.side_angle);
  spec.cone_half_width = si(params.rangefinders.cone) / 2;
  spec.min_range = si(params.rangefinders.min_range);
  spec.max_range = si(params.rangefinders.max_range);
  spec.offset = si(params.rangefinders.offset);
  spec.rate_hz = params.rangefinders.rate_hz;
  spec.latency_s = si(params.rangefinders.latency);
  spec.period_s = si(params.safety.period);
  return spec;
}

}  // namespace whisker::sim
