/// Who is on a bus, from received frames alone: nothing is sent.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "firmware/can/ids.hpp"
#include "firmware/can/messages.hpp"
#include "hal/can_port.hpp"
#include "host/harness/hil/clock.hpp"

namespace whisker::bench {

/// A node by its last heartbeat. What it has not sent is empty.
struct SeenNode {
  std::uint8_t robot = 0;
  can::Party party = can::Party::controller;
  can::Heartbeat beat;
  std::uint64_t heard_us = 0;  ///< time of that heartbeat
  bool guards = false;         ///< a guard node: it has sent a GuardStatus
  bool drove = false;          ///< a heartbeat said so
  std::optional<std::uint32_t> table_hash;
  std::optional<std::uint32_t> version;  ///< of the firmware: major << 16 | minor << 8 | patch
  std::optional<std::uint32_t> rules;    ///< CRC-32 of the response table

  std::uint8_t node() const { return can::node_of(robot, party); }
  /// It hears its partner.
  bool matches() const {
    return beat.state == can::NodeState::ready || beat.state == can::NodeState::running;
  }
};

class Survey {
 public:
  void on_frame(const hal::CanFrame& frame, std::uint64_t now_us);
  /// By number. A node that restarted loses the Info of its earlier start.
  const std::map<std::uint8_t, SeenNode>& nodes() const { return nodes_; }
  /// Null if this node has sent no heartbeat.
  const SeenNode* find(int robot, can::Party party) const;
  /// The controller or the base of the robot sent a heartbeat within the time after which a node is lost.
  /// now_us: of the last look for frames.
  bool alive(int robot, can::Party party, std::uint64_t now_us) const;
  /// A node of the robot that has not sent a heartbeat must be there: its partner says that both match, or
  /// said that it drives. That one may be held up, or lost.
  bool misses_one(int robot) const;

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
  void poll(std::uint32_t now_ms) noexcept override {
    polled_us_ = clock_.now_us();
    port_.poll(now_ms);
  }
  void restart() noexcept override { port_.restart(); }
  hal::CanState state() const noexcept override { return port_.state(); }
  const hal::CanCounts& counts() const noexcept override { return port_.counts(); }
  /// The survey knows what had come by then.
  std::uint64_t polled_us() const { return polled_us_; }

 private:
  hal::CanPort& port_;
  Survey& survey_;
  hil::Clock& clock_;
  std::uint64_t polled_us_ = 0;
};

}  // namespace whisker::bench
