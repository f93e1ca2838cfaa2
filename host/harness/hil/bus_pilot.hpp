#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "firmware/can/base_node.hpp"
#include "firmware/can/rules_server.hpp"
#include "host/harness/hil/clock.hpp"
#include "host/harness/hil/figures.hpp"
#include "host/harness/hil/replay.hpp"
#include "host/harness/run/pilot.hpp"

namespace whisker::hil {

/// The controller has restarted and lost the mission: the run must start again.
class ControllerRestarted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The handshake holds, but a request has no answer: what() names the request.
class NoAnswer : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The controller drives with another response table than BusOptions::rules, and takes none.
class OtherRules : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The controller does not calibrate, or not this way.
class NoCalibration : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The waiting caller was requested to stop.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct BusOptions {
  can::Identity identity{1, 1, 0};
  std::optional<std::uint32_t> rules;  ///< the controller must drive with the response table of this digest
  const can::RulesServer::Table* table = nullptr;  ///< of that digest: sent to a controller with another one
  can::Order order = can::Order::start;            ///< with which the run begins: one that drives
  std::optional<planning::Goal> goal;              ///< instead of the scenario's
  can::SyncMode sync_mode = can::SyncMode::lockstep;
  Shadow* shadow = nullptr;           ///< of a controller on this computer: what it knows is known
  std::uint32_t resend_ms = 20;       ///< lockstep: the shortest wait before a set is repeated, see Resend
  std::uint32_t patience_ms = 30000;  ///< for the answer to one request while the handshake holds
  std::function<void(const std::string&)> say;  ///< receives each awaited item once; "": it drives
  std::function<std::string()> bus_waits_for;   ///< reason why the port is off the bus, if known
  std::function<bool()> interrupted;            ///< true: give up
};

/// The base: the controller at the other end of a bus drives the simulated robot. Port, clock and figures
/// must outlive it. The first tick waits for a controller without limit, sends the parameters of the robot
/// and starts the mission. After a calibration, it waits for what the controller reports; after a drive along
/// a tape, it first says how far that was. Ticks throw ControllerRestarted, NoAnswer, NoCalibration,
/// OtherRules and Interrupted.
MakePilot bus_pilot(hal::CanPort& port, Clock& clock, const BusOptions& options, Figures& figures);

}  // namespace whisker::hil
