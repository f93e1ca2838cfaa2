/// A third party beside controller and base: docs/protocol.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/can/e2e.hpp"
#include "firmware/can/mission.hpp"
#include "hal/can_port.hpp"
#include "host/lab/bench/bus_state.hpp"
#include "host/lab/bench/param_client.hpp"
#include "host/lab/bench/survey.hpp"
#include "host/lab/guard/operator.hpp"

namespace whisker::bench {

/// An operator of this robot sent it, whole or not.
bool from_operator(const hal::CanFrame& frame, int robot);

/// Sends what a hand asks for. First it commands zero until the guard node is armed, and its vouch counts.
/// It answers each GuardStatus, and sends at least every 20 ms, because a Velocity holds for 50 ms only.
class OperatorLink {
 public:
  /// A wish of the hand holds for this long, as a command of whisker::Guard does by default.
  static constexpr double kHold_s = 0.25;

  /// vouched_m: the operator says that nothing stands within this distance of the body's centre; 0: nothing.
  /// vouch_number: another one than that of the last operator. The hand must outlive the link; it sees no
  /// pose, because the bus does not carry it.
  OperatorLink(hal::CanPort& port, int robot, guard::Operator& hand, double vouched_m,
               std::uint8_t vouch_number);

  /// Every millisecond: takes the frames from the port, and sends what is due.
  void poll(std::uint64_t now_us);
  /// The hand may ask from now on: the guard node has the same table.
  void trust_table() { trusted_ = true; }
  /// From now on the wheels are asked to stand.
  void end() { ended_ = true; }

  /// The hand has commanded, or could have.
  bool started() const { return first_tick_.has_value(); }
  /// Seconds since then by the ticks of the base.
  double time_s() const { return time_s_; }
  /// Ticks of the robot in which the node was armed, until now.
  std::uint64_t driven() const { return driven_; }
  /// The wheels were commanded to stand.
  bool stands() const;
  /// Another operator of this robot sends.
  bool disturbed() const { return disturbed_; }
  const BusState& seen() const { return seen_; }

 private:
  void on_frame(const hal::CanFrame& frame);
  bool steady() const;
  guard::Twist wish();
  void send_velocity();
  void send_vouch();

  hal::CanPort& port_;
  const int robot_;
  guard::Operator& hand_;
  const double vouched_m_;
  const std::uint8_t vouch_number_;
  BusState seen_;
  can::AliveSender velocities_, vouches_;
  guard::Twist twist_;
  std::optional<std::uint32_t> first_tick_;
  std::uint64_t sent_us_ = 0, driven_ = 0;
  double time_s_ = 0, next_s_ = 0, asked_s_ = 0;
  bool due_ = true, trusted_ = false, ended_ = false, disturbed_ = false;
};

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
