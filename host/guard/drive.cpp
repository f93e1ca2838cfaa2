#include "host/guard/drive.hpp"
#include "firmware/apps/pil_link/command_hash.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "firmware/control/wheel_drive.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "host/run/sim_world.hpp"
#include "host/run/spec.hpp"
#include "host/run/verdict.hpp"
#include "host/sim/plant.hpp"
#include "host/sim/sim_board.hpp"

namespace whisker::guard {
namespace {

std::int32_t micro(double value) {
  return static_cast<std::int32_t>(std::clamp(std::floor(value * 1e6 + 0.5), -2147483647.0, 2147483647.0));
}
Velocity velocity(const Twist& twist) {
  return {Speed::from_raw(micro(twist.forward_mps)), AngularRate::from_raw(micro(twist.turning_radps))};
}

/// The wheels do what the operator asks, within their limits.
class Bare {
 public:
  Bare(sim::Plant& plant, const Params& params) : plant_(plant), params_(params) {}
  void tick(const Velocity& asked, Duration elapsed) {
    const Speed turning = asked.turning * (params_.body.track / 2);
    const WheelPair want = inverse_kinematics(asked.forward, turning, params_.wheels.max_speed);
    now_ = slew(now_, want, params_.wheels.max_acceleration * elapsed);
    plant_.command(control::to_wire(now_));
  }

 private:
  sim::Plant& plant_;
  const Params& params_;
  WheelPair now_;
};

class Drive {
 public:
  Drive(const Scenario& scenario, Operator& hand, const Options& options)
      : scenario_(scenario),
        hand_(hand),
        options_(options),
        period_ms_(static_cast<int>(scenario.robot.safety.period.raw())),
        world_(scenario_),
        plant_(world_.view(), spec(), noise_spec(scenario.noise), scenario.seed, scenario.start),
        board_(plant_),
        guard_(board_, board_, scenario_.robot, &board_),
        bare_(plant_, scenario_.robot) {
    next_s_ = hand.first_s();
    if (options.table != nullptr) guard_.assist_by(*options.table);
    if (options.vouched_m > 0) guard_.vouch(Length::from_raw(micro(options.vouched_m)));
  }

  Result run() {
    while (plant_.time() < options_.time_s && !over()) {
      ask();
      tick();
      pass();
    }
    result_.end = ended();
    result_.time_s = plant_.in_contact() ? plant_.contact_time() : plant_.time();
    result_.path_m = plant_.path_length();
    result_.min_clearance_m = plant_.min_clearance();
    result_.final_distance_m = distance();
    if (options_.guarded) result_.hash = hash_.value();
    if (asked_ > 0) result_.granted = granted_ / asked_;
    return result_;
  }

 private:
  sim::RobotSpec spec() const {
    sim::RobotSpec spec = robot_spec(scenario_);
    if (options_.gap_ms) spec.period_s = 0.001;
    return spec;
  }
  Time now() const { return Time::from_raw(now_ms_); }
  double distance() const {
    const sim::Vec2 to = scenario_.goal.at - plant_.pose().at;
    return std::hypot(to.x, to.y);
  }
  bool at_goal() const { return options_.until_goal && distance() <= scenario_.goal.tolerance_m; }
  bool faulted() const { return options_.guarded && guard_.status().health.fault != Fault::none; }
  /// A fault ends the drive once the body stands.
  bool over() const {
    return plant_.in_contact() || at_goal() || (options_.ended && options_.ended()) ||
           (faulted() && std::fabs(plant_.v_left()) < 1e-3 && std::fabs(plant_.v_right()) < 1e-3);
  }
  End ended() {
    if (plant_.in_contact()) return End::contact;
    if (faulted()) {
      result_.fault = guard_.status().health.fault;
      return End::fault;
    }
    if (at_goal()) return End::arrived;
    return options_.ended && options_.ended() ? End::ended : End::time;
  }

  void ask() {
    if (plant_.time() < next_s_) return;
    twist_ = hand_.ask({plant_.pose(), plant_.time()});
    next_s_ = plant_.time() + hand_.pause_s();
    guard_.command(velocity(twist_), now());
  }

  void tick() {
    const hal::RangeReadings ranges = plant_.ranges();
    const sim::Pose pose = plant_.pose();
    if (options_.guarded) {
      count(guard_.tick(now()));
      hash_.add(guard_.status().command);
    } else {
      bare_.tick(velocity(twist_), milliseconds(gap_ms_));
    }
    ++result_.ticks;
    if (!options_.watch) return;
    options_.watch({plant_.time(), pose, plant_.v_left(), plant_.v_right(), ranges, twist_,
                    options_.guarded ? &guard_.status() : nullptr,
                    options_.guarded ? &guard_.local_grid() : nullptr});
  }

  void count(const GuardStatus& status) {
    ++result_.reasons[static_cast<std::size_t>(status.reason)];
    if (status.asked.forward == Speed{}) return;
    asked_ += 1;
    granted_ += status.forward.raw() / 16384.0;
    const bool held = status.forward == Q14{};
    if (held && !held_) ++result_.stops;
    held_ = held;
  }

  void pass() {
    gap_ms_ = options_.gap_ms ? options_.gap_ms() : period_ms_;
    now_ms_ += static_cast<std::uint32_t>(gap_ms_);
    for (int i = options_.gap_ms ? gap_ms_ : 1; i > 0 && !plant_.in_contact(); --i) plant_.advance();
  }

  const Scenario& scenario_;
  Operator& hand_;
  const Options& options_;
  int period_ms_;
  SimWorld world_;
  sim::Plant plant_;
  hal::SimBoard board_;
  Guard guard_;
  Bare bare_;
  Result result_;
  link::CommandHash hash_;
  Twist twist_;
  double next_s_ = 0;
  double asked_ = 0, granted_ = 0;
  bool held_ = false;
  int gap_ms_ = 10;
  std::uint32_t now_ms_ = 0;
};

}  // namespace

const char* name(End end) {
  switch (end) {
    case End::arrived: return "arrived";
    case End::contact: return "contact";
    case End::fault: return "fault";
    case End::time: return "time";
    case End::ended: return "ended";
  }
  return "?";
}

Result drive(const Scenario& scenario, Operator& hand, const Options& options) {
  const auto drive = std::make_unique<Drive>(scenario, hand, options);
  return drive->run();
}

}  // namespace whisker::guard
