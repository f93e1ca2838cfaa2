/// The robot as a function of values, for programs that call their drivers themselves.
#pragma once

#include "firmware/planning/default_planner.hpp"
#include "firmware/planning/planners.hpp"
#include "firmware/robot.hpp"

namespace whisker {

/// What the devices said at a tick. `has_...`: the device answered; without an answer for long, the robot
/// stops with a named fault.
struct Inputs {
  Time now;
  hal::EncoderCounts counts{};
  hal::RangeReadings ranges{};
  hal::BumperReading bumper{};  ///< with BumperParams::fitted
  hal::GyroReading gyro{};      ///< with GyroParams::fitted
  bool has_counts = true;
  bool has_ranges = true;
  bool has_bumper = false;
  bool has_gyro = false;
};

struct Outputs {
  hal::WheelSpeeds wheels{};  ///< for a closed loop of each wheel, for example hal::Governor, at once
  Fault fault = Fault::none;  ///< the wheels stand until reset()
  planning::Outcome outcome = planning::Outcome::none;
  Pose pose;
};

/// Robot with the default planner behind values. All that SimpleRobot adds is the check of its parameters.
class RobotOfValues {
 public:
  /// The parameters must outlive it.
  explicit RobotOfValues(const Params& params) noexcept
      : planner_(params, fuzzy::kDefaultTable),
        robot_(devices_, devices_, planning::planner_in(planner_), params, &devices_, &devices_) {}
  RobotOfValues(const RobotOfValues&) = delete;
  RobotOfValues& operator=(const RobotOfValues&) = delete;

  /// See the functions of Robot with these names.
  bool place(const Pose& pose) noexcept { return robot_.place(pose); }
  bool go_to(Vec at, Length tolerance = 100_mm) noexcept { return robot_.set_goal({at, tolerance}); }
  void cancel() noexcept { robot_.cancel(); }
  void reset() noexcept { robot_.reset(); }
  const Status& status() const noexcept { return robot_.status(); }

  /// One control tick: see Robot::tick().
  Outputs tick(const Inputs& inputs) noexcept {
    devices_.inputs = &inputs;
    const Status& status = robot_.tick(inputs.now);
    devices_.inputs = nullptr;
    return {status.command, status.health.fault, status.decision.outcome, status.pose};
  }

 private:
  struct Devices final : hal::Rangefinders, hal::Drive, hal::Bumper, hal::Gyro {
    const Inputs* inputs = nullptr;

    bool read(hal::RangeReadings& out) noexcept override {
      if (inputs->has_ranges) out = inputs->ranges;
      return inputs->has_ranges;
    }
    bool read(hal::EncoderCounts& out) noexcept override {
      if (inputs->has_counts) out = inputs->counts;
      return inputs->has_counts;
    }
    bool read(hal::BumperReading& out) noexcept override {
      if (inputs->has_bumper) out = inputs->bumper;
      return inputs->has_bumper;
    }
    bool read(hal::GyroReading& out) noexcept override {
      if (inputs->has_gyro) out = inputs->gyro;
      return inputs->has_gyro;
    }
    bool command(hal::WheelSpeeds) noexcept override { return true; }
  };

  Devices devices_;
  planning::DefaultPlanner planner_;
  Robot robot_;
};

/// Parameters that do not fit together do not compile: the error names the relation, fits<ParamFault::...>.
///
///   constexpr Params kRobot = params_of({90_mm, 30_mm, 140_mm}, wheels, hc_sr04(40_deg));
///   SimpleRobot<kRobot> robot;
///   robot.place({});
///   robot.go_to({4_m, 1_m});
///   every 10 ms:  drive(robot.tick({now, counts, ranges}).wheels);
template <const Params& kParams>
class SimpleRobot : public RobotOfValues {
 public:
  SimpleRobot() noexcept : RobotOfValues(kParams) {}

 private:
  template <ParamFault kViolated>
  static constexpr bool fits() noexcept {
    static_assert(kViolated == ParamFault::none, "the parameters do not fit: ask `whisker robot check`");
    return true;
  }
  static_assert(fits<check(kParams)>());
};

}  // namespace whisker
