#include "tests/robot/properties/watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "firmware/planning/state.hpp"

namespace whisker::test {
namespace {

constexpr int32_t kUnit = 100;    // um/s on the wire
constexpr int32_t kRounded = 10;  // units, over many ticks

}  // namespace

Watch::Watch(const Params& params)
    : top_((params.wheels.max_speed.raw() + kUnit / 2) / kUnit),
      acceleration_(params.wheels.max_acceleration),
      to_stand_(milliseconds(multiply_divide(params.wheels.max_speed.raw(), 1000,
                                             params.wheels.max_acceleration.raw())) +
                longest_gap(params) * 2) {}

std::string Watch::see(const Status& status, Duration elapsed, bool refused) {
  // Rounding to the wire may increase the difference of two speeds by one unit.
  follows_ = static_cast<double>((acceleration_ * elapsed).raw()) / kUnit;
  change_ = static_cast<std::int32_t>(follows_) + 1;
  std::string broken = speeds(status, refused);
  if (broken.empty()) broken = faults(status, elapsed);
  if (broken.empty()) broken = counters(status.health);
  if (planning::name(status.decision.mode)[0] == '?' || planning::name(status.decision.why)[0] == '?') {
    broken = "a word without a name";
  }
  return broken;
}

/// What the wheels reach of the last command by now.
void Watch::reach() {
  const double left = last_.left - reached_[0], right = last_.right - reached_[1];
  const double farther = std::max(std::fabs(left), std::fabs(right));
  const double share = farther > follows_ ? follows_ / farther : 1;
  reached_[0] += left * share;
  reached_[1] += right * share;
}

std::string Watch::speeds(const Status& status, bool refused) {
  const hal::WheelSpeeds c = status.command;
  const hal::WheelSpeeds before = last_;
  reach();
  last_ = c;
  if (refused) reached_[0] = reached_[1] = 0;
  if (std::abs(c.left) > top_ || std::abs(c.right) > top_) return "beyond the speed limit";
  if (refused) return c.left == 0 && c.right == 0 ? "" : "a refused command is not zero";
  const auto far = [c](double left, double right, int32_t most) {
    return std::fabs(c.left - left) > most || std::fabs(c.right - right) > most;
  };
  // Braking goes on from the last command, everything else from where the wheels are.
  if (far(before.left, before.right, change_) && far(reached_[0], reached_[1], change_ + kRounded)) {
    return "beyond the acceleration limit: " + std::to_string(before.left) + " -> " + std::to_string(c.left) +
           ", " + std::to_string(before.right) + " -> " + std::to_string(c.right) + ", reached " +
           std::to_string(reached_[0]) + ", " + std::to_string(reached_[1]) + ", change " +
           std::to_string(change_);
  }
  return "";
}

std::string Watch::faults(const Status& status, Duration elapsed) {
  const Fault fault = status.health.fault;
  if (fault_ != Fault::none && fault != fault_) return "the first fault did not stay";
  fault_ = fault;
  faulted_for_ = fault == Fault::none ? Duration{} : faulted_for_ + elapsed;
  if (fault == Fault::none) return "";
  if (status.decision.mode != planning::Mode::stopped || status.decision.why != planning::Why::fault) {
    return "a fault that does not show";
  }
  const bool moving = status.command.left != 0 || status.command.right != 0;
  return moving && faulted_for_ >= to_stand_ ? "still moving after a fault" : "";
}

std::string Watch::counters(const Health& now) {
  const Health before = health_;
  health_ = now;
  const bool down =
      now.range_refused < before.range_refused || now.range_invalid < before.range_invalid ||
      now.range_stale < before.range_stale || now.range_stuck < before.range_stuck ||
      now.range_out_of_range < before.range_out_of_range || now.drive_refused < before.drive_refused ||
      now.encoder_refused < before.encoder_refused || now.encoder_jumps < before.encoder_jumps ||
      now.wheel_stalls < before.wheel_stalls || now.wheel_runaways < before.wheel_runaways ||
      now.unsteady_looks < before.unsteady_looks || now.no_progress < before.no_progress ||
      now.pose_out_of_range < before.pose_out_of_range || now.late_ticks < before.late_ticks ||
      now.clock_jumps < before.clock_jumps || now.bumps < before.bumps ||
      now.bumper_refused < before.bumper_refused || now.bumper_stuck < before.bumper_stuck ||
      now.gyro_lost < before.gyro_lost || now.gyro_saturated < before.gyro_saturated ||
      now.wheel_slips < before.wheel_slips;
  return down ? "a counter went down" : "";
}

}  // namespace whisker::test
