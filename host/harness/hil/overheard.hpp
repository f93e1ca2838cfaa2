/// What an observer of a robot's bus knows from its frames alone: nothing is sent.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "firmware/can/codec.hpp"
#include "firmware/can/ids.hpp"
#include "firmware/can/input_set.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/can/param_server.hpp"
#include "firmware/robot.hpp"
#include "hal/can_port.hpp"

namespace whisker::hil {

/// Passes the message of the frame on, unless a value is out of range.
template <class M, class F>
void with(const hal::CanFrame& frame, const F& use) {
  M message;
  if (can::decode(frame, message)) use(message);
}

struct Sender {
  can::MessageKind kind;
  can::Party party;
  int robot;
  std::uint8_t node;
  bool whole;  ///< size and checksum are right
};

/// Empty for an E-stop, which has no sender, and for what no node of a robot sends.
std::optional<Sender> sender_of(const hal::CanFrame& frame);

struct OperatorFrame {
  can::MessageKind kind;
  int robot;
  bool whole;  ///< size and checksum are right
};

/// Empty for what no operator sends.
std::optional<OperatorFrame> operator_frame(const hal::CanFrame& frame);

/// A status with what the bus carries of it.
Status status_of(const can::NavStatus& told);

/// Input sets, missions and parameters of one robot.
class Overheard {
 public:
  /// Called for each order that the controller accepts, once. Of the operator's missions only the goal
  /// counts.
  using Accepted = std::function<void(can::Requester, can::Order, const can::Mission&)>;

  /// params: those of the robot, until others are committed.
  Overheard(const Params& params, Accepted accepted);

  /// Every whole frame of the robot's nodes.
  void on_frame(can::MessageKind kind, const hal::CanFrame& frame);
  /// Every whole frame of its operator. time_us: of any clock.
  void on_operator(can::MessageKind kind, const hal::CanFrame& frame, std::uint64_t time_us);
  /// A node restarted: the number of the last mission may come again.
  void restarted();

  const Params& params() const { return server_.committed(); }
  /// The complete input set of this tick of the current mission; null if it is not kept.
  const can::InputSet* set_of(std::uint16_t tick16) const;

 private:
  static constexpr std::size_t kKept = 256;  // complete input sets: more than the delay of any command

  template <can::MessageKind kKind>
  void on_range(int beam, const hal::CanFrame& frame);
  /// What a requester has sent, and its last order that was accepted.
  struct Requests {
    can::MissionParts parts;
    std::optional<can::MissionOrder> order;
    int accepted = -1;
    std::optional<can::ParamRequest> param;
  };
  Requests& of(std::uint8_t to_operator) { return to_operator != 0 ? operator_ : base_; }
  void on_request(Requests& from, can::MessageKind kind, const hal::CanFrame& frame);
  void on_mission(Requests& from, const hal::CanFrame& frame);
  void on_reply(const can::MissionReply& reply);
  void on_reply(const can::ParamReply& reply);
  /// The frames of input sets, and the sets that they complete.
  struct Sets {
    can::InputSets frames;
    std::array<std::optional<can::InputSet>, kKept> kept;
    template <class... M>
    void on_frame(const M&... of_frame);
  };
  template <class... M>
  void on_set(const M&... of_frame);

  const Accepted accepted_;
  Sets sets_;
  /// Since the base's last order. The controller forgets the sets before it as soon as it has taken it; its
  /// reply may come behind a set that it has received afterwards.
  Sets since_order_;
  Requests base_, operator_;
  std::uint64_t operator_us_ = 0;  // of its last frame
  can::ParamServer server_;
};

}  // namespace whisker::hil
