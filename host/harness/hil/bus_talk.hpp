/// How a base asks a controller on the bus, and waits for its answers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/can/base_node.hpp"
#include "firmware/can/rules_server.hpp"
#include "host/harness/hil/bus_pilot.hpp"
#include "host/harness/hil/clock.hpp"

namespace whisker::hil {

/// Thrown if the mission cannot continue; BusPilot::trouble() has the reason.
struct Hopeless {};

/// Every wait ends: with the answer, with an error of the node (Hopeless), with a restart of the controller
/// (ControllerRestarted), or with BusOptions::patience_ms (NoAnswer).
class BusTalk {
 public:
  /// All must outlive it.
  BusTalk(Clock& clock, const BusOptions& options, can::BaseNode& node)
      : clock_(clock), options_(options), node_(node) {}

  bool lockstep() const { return options_.sync_mode == can::SyncMode::lockstep; }
  bool running() const { return node_.state() == can::NodeState::running; }
  /// The controller gets its table and parameters now: one more restart, and it has lost them.
  void count_restarts() { restarts_ = node_.peer_restarts(); }

  void nap();
  void watchful_nap();
  /// Patience begins anew for this answer.
  void ask_for(const char* answer);
  void watch_patience();
  void check();
  /// Says what it waits for, once.
  void explain();

  /// The table with this digest drives it: sends the table unless it is null.
  void make_it_drive_with(std::uint32_t wanted, const can::RulesServer::Table* table);
  void hand_over(const Params& params);
  /// Until it accepts.
  void give(can::Order order, const can::Mission& mission);

 private:
  template <class F>
  void ask_info_until(const char* answer, const F& done);
  bool send_rules(std::uint32_t wanted, const can::RulesServer::Table* table);
  can::RulesStatus send_rules_once(std::uint8_t upload, const can::RulesServer::Table* table);
  void ask(const can::ParamRequest& request);

  Clock& clock_;
  const BusOptions& options_;
  can::BaseNode& node_;
  std::string said_;
  const char* awaited_ = "";
  std::uint64_t asked_us_ = 0;
  std::optional<std::uint32_t> restarts_;
};

}  // namespace whisker::hil
