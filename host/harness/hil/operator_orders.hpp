#pragma once

#include <cstdint>
#include <optional>

#include "firmware/can/e2e.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/can/mission.hpp"
#include "host/harness/hil/tap.hpp"

namespace whisker::hil {

/// Gives orders of an operator through the port of a base. No other operator of the robot may send.
class OperatorOrders {
 public:
  OperatorOrders(hal::CanPort& port, std::uint8_t robot);

  /// The port of the base.
  hal::CanPort& port() { return tap_; }
  /// The next order.
  void begin();
  /// Sends it, again while no answer comes. True: accepted() is valid. The base must be polled meanwhile.
  bool answered(can::Order order, const planning::Goal& goal, std::uint64_t now_us);
  bool accepted() const { return answer_ == can::MissionStatus::accepted; }

 private:
  void on_frame(const hal::CanFrame& frame);
  template <class M>
  void send(const M& message);

  Tap tap_;
  const std::uint8_t robot_;
  can::AliveSender alive_;
  std::uint8_t number_ = 0;
  std::optional<can::MissionStatus> answer_;
  std::optional<std::uint64_t> sent_us_;
};

}  // namespace whisker::hil
