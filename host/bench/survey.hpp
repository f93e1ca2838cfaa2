/// Who is on a bus, from received frames alone: nothing is sent.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "firmware/can/ids.hpp"
#include "firmware/can/messages.hpp"
#include "hal/can_port.hpp"
#include "host/hil/clock.hpp"

namespace whisker::bench {

/// A node by its last heartbeat. What it has not sent is empty.
struct SeenNode {
  std::uint8_t robot = 0;
  can::Party party = can::Party::controller;
  can::Heartbeat beat;
  std::uint64_t heard_us = 0;  ///< time of that heartbeat
  bool guards = false;         ///< a guard node: it has sent a GuardStatus
  std::optional<std::uint32_t> table_hash;
  std::optional<std::uint32_t> version;  ///< of the firmware: major << 16 | minor << 8 | patch
  std::optional<std::uint32_t> rules;    ///< CRC-32 of the response table

  std::uint8_t node() const { return can::node_of(robot, party); }
};

class Survey {
 public:
  void on_frame(const hal::CanFrame& frame, std::uint64_t now_us);
  /// By number. A node that restarted loses the Info of its earlier start.
  const std::map<std::uint8_t, SeenNode>& nodes() const { return nodes_; }
  /// Null if this node has sent no heartbeat.
  const SeenNode* find(int robot, can::Party party) const;
  /// The controller or the base of the robot sent a heartbeat within the time after which a node is lost.
  bool alive(int robot, can::Party party, std::uint64_t now_us) const;

 private:
  std::map<std::uint8_t, SeenNode> nodes_;
};

/// A port whose received frames a survey sees, too.
class SurveyPort final : public hal::CanPort {
 public:
  SurveyPort(hal::CanPort& port, Survey& survey, hil::Clock& clock)
      : port_(port), survey_(survey), clock_(clock) {}

  bool send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept override {
    return port_.send(frame, lifetime_ms);
  }
  bool receive(hal::CanFrame& out) noexcept override;
  void poll(std::uint32_t now_ms) noexcept override { port_.poll(now_ms); }
  void restart() noexcept override { port_.restart(); }
  hal::CanState state() const noexcept override { return port_.state(); }
  const hal::CanCounts& counts() const noexcept override { return port_.counts(); }

 private:
  hal::CanPort& port_;
  Survey& survey_;
  hil::Clock& clock_;
};

}  // namespace whisker::bench
