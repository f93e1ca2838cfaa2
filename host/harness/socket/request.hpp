/// What a simulator says, one JSON object a line: docs/socket.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "firmware/localization/pose_fix.hpp"
#include "firmware/params.hpp"
#include "hal/types.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker::socket {

constexpr int kProtocol = 1;  ///< version

/// A line that does not follow the protocol; what() is the reason, as one_line().
struct ProtocolError : std::runtime_error {
  explicit ProtocolError(const std::string& what) : std::runtime_error(one_line(what)) {}
};

/// The first line.
struct Opening {
  Params robot;
  PlannerKind planner;
  sim::Pose start{};
  std::optional<Goal> goal;
};

/// One beam in a tick.
struct Beam {
  bool fresh = false;  ///< a new reading
  hal::RangeStatus status = hal::RangeStatus::stale;
  std::uint16_t mm = 0;
  std::uint8_t age_ms = 0;
};

/// Every further line. What a simulator leaves out, the core counts as refused by its HAL.
struct Tick {
  std::optional<std::uint32_t> now_ms;  ///< none: the time of arrival counts
  bool has_ranges = false;
  Beam beam[hal::kBeams];
  std::optional<std::array<std::int64_t, 2>> counts;  ///< left, right
  std::optional<hal::BumperReading> bumper;
  std::optional<hal::GyroReading> gyro;
  // Commands before the tick, in this order.
  bool reset = false;
  bool cancel = false;
  std::optional<sim::Pose> place;
  std::optional<localization::UncertainPose> fix;
  std::optional<Goal> goal;
};

/// `defaults`: what the line does not say. Throws ProtocolError.
Opening read_opening(const std::string& line, const Opening& defaults);
/// Throws ProtocolError.
Tick read_tick(const std::string& line);

}  // namespace whisker::socket
