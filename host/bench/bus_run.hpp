/// A run as an observer of the bus sees it: nothing is sent, and nothing inside the core is known.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "firmware/can/input_set.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/can/param_server.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/robot.hpp"
#include "hal/can_port.hpp"

namespace whisker::bench {

class BusRun {
 public:
  struct Listener {
    /// heard: the mission began while this observer listened. Otherwise start and goal are unknown and zero.
    std::function<void(const can::Mission&, const Params&, bool heard)> begins;
    /// The pose of the status is that of the wheels since `begins`; what the bus does not carry is zero.
    std::function<void(const can::InputSet&, const Status&)> stepped;
  };

  /// params: those of the robot, until a base transfers others.
  BusRun(int robot, const Params& params, Listener listener);

  /// Every frame on the bus, also of others.
  void on_frame(const hal::CanFrame& frame);

 private:
  static constexpr std::size_t kKept = 16;  // complete input sets: more than the delay of any answer

  void execute(can::MessageKind kind, const hal::CanFrame& frame);
  template <can::MessageKind kKind>
  void on_range(int beam, const hal::CanFrame& frame);
  void on_mission(const hal::CanFrame& frame);
  void on_reply(const can::MissionReply& reply);
  void on_reply(const can::ParamReply& reply);
  void on_status(const can::NavStatus& told);
  void keep();
  void begin(const can::Mission& mission, bool heard);

  const int robot_;
  Params params_;
  const Listener listener_;
  can::InputSets sets_;
  std::array<std::optional<can::InputSet>, kKept> kept_;
  can::MissionParts parts_;
  std::optional<can::MissionOrder> order_;
  std::optional<can::ParamRequest> request_;
  can::ParamServer server_;
  std::optional<can::WheelCommand> command_;
  int accepted_ = -1;
  bool begun_ = false;
  std::optional<std::uint16_t> tick16_;  // of the last step
  std::uint32_t tick_ = 0;
  localization::Odometry odometry_;
};

}  // namespace whisker::bench
