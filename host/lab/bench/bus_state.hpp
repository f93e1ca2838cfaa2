/// The last value of everything that a bus carries about one robot.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "firmware/can/messages.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/robot.hpp"
#include "hal/can_port.hpp"
#include "host/harness/hil/overheard.hpp"
#include "host/lab/bench/survey.hpp"

namespace whisker::bench {

/// The wheels are commanded to stand.
bool stands(const can::WheelCommand& command);

struct BusState {
  std::optional<can::NavStatus> status;
  std::optional<can::WheelCommand> command;
  std::optional<can::WheelState> wheels;
  std::optional<hal::RangeReading> beams[hal::kBeams];
  std::optional<can::RangeTrustReport> trust;
  std::optional<can::PoseSigmaReport> sigma;
  std::optional<can::GuardReport> guard;  ///< only a guard node sends it
  std::optional<can::Sync> sync;
  std::uint64_t frames = 0;  ///< of this robot, valid

  /// False: not a valid frame of this robot.
  bool on_frame(const hal::CanFrame& frame, int robot);
};

class BusRun {
 public:
  struct Listener {
    /// heard: the mission began while this observer listened. Otherwise start and goal are unknown and zero.
    std::function<void(const can::Mission&, const Params&, bool heard)> begins;
    /// The pose of the status is that of the wheels since `begins`; what the bus does not carry is zero.
    std::function<void(const can::InputSet&, const Status&)> stepped;
  };

  /// params: those of the robot, until others are committed.
  BusRun(int robot, const Params& params, Listener listener);

  /// Every frame on the bus, also of others.
  void on_frame(const hal::CanFrame& frame);

 private:
  void on_operator(const hal::CanFrame& frame);
  can::Mission from_here(const planning::Goal& goal) const { return {odometry_.pose(), goal}; }
  void on_status(const can::NavStatus& told);
  void begin(const can::Mission& mission, bool heard);

  const int robot_;
  const Listener listener_;
  hil::Overheard overheard_;
  std::optional<can::WheelCommand> command_;
  bool begun_ = false;
  std::optional<std::uint16_t> tick16_;  // of the last step
  std::uint32_t tick_ = 0;
  localization::Odometry odometry_;
};

}  // namespace whisker::bench
