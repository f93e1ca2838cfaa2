/// A third party beside controller and base: docs/protocol.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/can/e2e.hpp"
#include "firmware/can/mission.hpp"
#include "host/bench/bus_state.hpp"
#include "host/bench/param_client.hpp"
#include "host/bench/survey.hpp"

namespace whisker::bench {

/// Commands the controller of a robot whose base is on the bus. The port must feed the survey, and no other
/// operator of the robot may send: every call throws NoAnswer if one does.
class OperatorClient final : public ParamClient {
 public:
  /// number: of the last order; another one than that of the last operator.
  OperatorClient(hal::CanPort& port, hil::Clock& clock, const Survey& survey, int robot, std::uint8_t number,
                 Patience patience);

  /// Waits for the Info of the controller, and compares its table.
  void connect() override;
  /// Returns once the wheels are commanded to stand.
  void cancel() override;

  /// Drives to this goal: from standstill with the committed parameters, or else instead of the goal that the
  /// robot has. Throws NoAnswer if the controller refuses.
  void drive_to(const planning::Goal& goal);
  /// Polls. The status that ended the drive to the goal, once it has come. Throws NoAnswer if another order
  /// replaced it, or the robot says nothing for too long.
  std::optional<can::NavStatus> ended();
  /// Since the goal was accepted, by the ticks of the base.
  double time_s() const;

  void request(const can::ParamRequest& request) override;
  bool replied(can::ParamReply& reply) const override;

 private:
  void poll() override;
  void on_frame(const hal::CanFrame& frame);
  void on_status(const can::NavStatus& status);
  const SeenNode* controller() const { return survey_.find(robot_, can::Party::controller); }
  can::MissionStatus order(can::Order order, const planning::Goal& goal);
  void send_order(can::Order order, const can::MissionValues& values);
  template <class M>
  void send(const M& message, can::AliveSender& alive);
  void begin_time();
  std::string state() const;
  [[noreturn]] void refuse(const char* what, can::MissionStatus status) const;

  hal::CanPort& port_;
  const Survey& survey_;
  const int robot_;
  std::uint8_t number_;
  BusState seen_;
  can::AliveSender requests_, missions_;
  std::optional<can::ParamReply> reply_;
  std::optional<can::MissionStatus> answer_;  // to the order number_
  std::optional<std::uint16_t> tick_before_;  // of the last status before that
  std::optional<can::NavStatus> ended_;
  std::optional<std::uint32_t> first_tick_;
  std::uint64_t heard_us_ = 0;  // the last status
  bool drives_ = false;         // to a goal of this operator
  bool replaced_ = false;       // by an order of the base
};

}  // namespace whisker::bench
