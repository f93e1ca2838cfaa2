#include "host/lab/campaign/random_robot.hpp"

#include <algorithm>
#include <stdexcept>

#include "firmware/planning/goal_planner.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/sim/elementary.hpp"
#include "host/harness/worlds/random.hpp"
#include "host/harness/worlds/scale.hpp"

namespace whisker::campaign {
namespace {

using worlds::Random;

constexpr std::uint64_t kStream = 0x526F626F7473;  // no kind of world has this number
constexpr int kMostDraws = 100000;

double log_uniform(Random& random, double low, double high) {
  return low * sim::exponential(random.uniform(0, sim::natural_log(high / low)));
}

/// One draw; lengths in m, angles in degrees, times in s.
class Draw {
 public:
  explicit Draw(Random& random)
      : random_(random), radius_(log_uniform(random, 0.02, 1)), size_(radius_ / 0.09) {}

  Params params(bool own) {
    body();
    wheels();
    rangefinders();
    if (own) own_mounts();
    conditioning();
    driving();
    return p_;
  }

 private:
  void body() {
    set_si(p_.body.radius, radius_);
    set_si(p_.body.margin, 0.03 * size_);
    set_si(p_.body.track, random_.uniform(0.8, 2) * radius_);
  }

  void wheels() {
    // In radii, because a large body at 2 cm/s would take days, and a small one at 3 m/s cannot stop.
    const double speed = std::clamp(log_uniform(random_, 0.5, 20) * radius_, 0.02, 3.2);
    set_si(p_.wheels.max_speed, speed);
    set_si(p_.wheels.max_acceleration, std::clamp(speed / log_uniform(random_, 0.05, 3), 0.05, 20.0));
    set_si(p_.wheels.max_turn_rate, log_uniform(random_, 0.3, 20));
    set_si(p_.wheels.motor_lag, random_.uniform(0, 0.15));
    p_.wheels.counts_per_metre = static_cast<std::int32_t>(log_uniform(random_, 100, 100000));
  }

  void rangefinders() {
    RangefinderParams& r = p_.rangefinders;
    set_si(r.side_angle, random_.uniform(10, 80));
    set_si(r.cone, log_uniform(random_, 2, 60));
    set_si(r.offset, random_.uniform(0, 1.1) * radius_);
    set_si(r.min_range, random_.uniform(0, 0.5) * radius_);
    set_si(r.max_range, std::clamp(random_.uniform(1, 4) * size_, 1.5, 60.0));
    r.rate_hz = 5 + random_.index(96);
    set_si(r.latency, random_.uniform(0, 0.1));
  }

  void own_mounts() {
    constexpr double kInner[] = {10, -15, -80}, kOuter[] = {80, 15, -10};
    for (int i = 0; i < 3; ++i) {
      BeamParams& beam = p_.rangefinders.beams[i];
      const double axis = random_.uniform(kInner[i], kOuter[i]);
      // Mostly near the axis through the centre: a cone that passes beside the centre misses ground at the
      // rim.
      const double nearness = random_.uniform(0, 1);
      const double place = axis + random_.uniform(-60, 60) * nearness * nearness;
      const double off = random_.uniform(0, 1.1) * radius_;
      const sim::SinCos direction = sim::sin_cos(place * (sim::kPi / 180));
      set_si(beam.x, off * direction.cos);
      set_si(beam.y, off * direction.sin);
      set_si(beam.angle, axis);
      set_si(beam.cone, log_uniform(random_, 2, 60));
    }
  }

  void conditioning() {
    const RangefinderParams& r = p_.rangefinders;
    const double gap = 1.0 / r.rate_hz + r.latency.raw() * 1e-3;
    const double stale = std::max(0.02, gap * random_.uniform(1.2, 3));
    set_si(p_.conditioning.stale_after, stale);
    p_.conditioning.consensus = random_.chance(0.5) ? Consensus::agreeing : Consensus::median;
  }

  void driving() {
    set_si(p_.boundary.length_budget, std::min(2000.0, 400 * size_));
    p_.safety.period = milliseconds(5 + random_.index(16));
    set_si(p_.boundary.guard_margin, random_.uniform(0, 0.006) * size_);
  }

  Random& random_;
  Params p_;
  double radius_, size_;
};

}  // namespace

RandomRobot random_robot(std::uint64_t seed) {
  Random random(Random(seed).bits() + kStream);
  RandomRobot robot;
  // Drawn once, because check() refuses most draws with mounts of their own.
  const bool own = random.chance(0.5);
  for (int i = 0; i < kMostDraws; ++i) {
    robot.params = Draw(random).params(own);
    const ParamFault fault = check(robot.params);
    if (fault == ParamFault::none) return robot;
    ++robot.refusals[static_cast<std::size_t>(fault)];
  }
  throw std::runtime_error("no draw gave a robot whose parameters fit together");
}

double size_of(const Params& robot) {
  return static_cast<double>(robot.body.radius.raw()) / Params{}.body.radius.raw();
}

void fit_to(Scenario& scenario, const Params& robot) {
  const double size = size_of(robot);
  worlds::scale_lengths(scenario, size);
  const double least = planning::smallest_tolerance(robot).raw() * 1e-6;
  scenario.goal.tolerance_m = std::max(scenario.goal.tolerance_m, least);
  const Params reference;
  const double driving = size * reference.wheels.max_speed.raw() / robot.wheels.max_speed.raw();
  const double turning = static_cast<double>(turn_rate(reference).raw()) / turn_rate(robot).raw();
  scenario.time_limit_s *= std::max(driving, turning);
  scenario.robot = robot;
}

}  // namespace whisker::campaign
