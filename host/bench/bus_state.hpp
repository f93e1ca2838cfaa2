/// The last value of everything that a bus carries about one robot.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/can/messages.hpp"
#include "host/bench/survey.hpp"

namespace whisker::bench {

/// The wheels are commanded to stand.
bool stands(const can::WheelCommand& command);

struct BusState {
  std::optional<can::NavStatus> status;
  std::optional<can::WheelCommand> command;
  std::optional<can::WheelState> wheels;
  std::optional<hal::RangeReading> beams[hal::kBeams];
  std::optional<can::RangeTrustReport> trust;
  std::optional<can::PoseSigmaReport> sigma;
  std::optional<can::GuardReport> guard;  ///< only a guard node sends it
  std::optional<can::Sync> sync;
  std::uint64_t frames = 0;  ///< of this robot, valid

  /// False: not a valid frame of this robot.
  bool on_frame(const hal::CanFrame& frame, int robot);
};

}  // namespace whisker::bench
