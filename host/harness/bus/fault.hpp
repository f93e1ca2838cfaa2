#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hal/can_port.hpp"

namespace whisker::bus {

enum class FaultKind : std::uint8_t {
  // Faults of frames: each matching frame is affected.
  loss,           ///< does not arrive, nor do the `length` - 1 frames after it
  delay,          ///< arrives `ticks` later, plus up to `jitter`: later frames may overtake it
  duplicate,      ///< arrives twice
  reorder,        ///< arrives after the next one
  corrupt,        ///< one bit of its data is inverted
  forge,          ///< one bit of its data is inverted, and its check value corrected: see Repair
  freeze,         ///< has the data of the first affected frame with its identifier: a stuck counter
  wrong_size,     ///< has another size
  make_remote,    ///< is a remote frame
  make_extended,  ///< has the extended format, with the same identifier
  masquerade,     ///< has identifier `id`
  // Faults of the port, while they last.
  babble,   ///< a node sends `length` frames per tick with identifier `id`; lower priorities are blocked
  bus_off,  ///< the CAN controller goes bus-off repeatedly while this lasts; restart() ends it afterwards
  passive,  ///< the controller is error-passive
  down,     ///< the interface is down, and returns by itself
  full,     ///< the driver has no room: sent frames wait until they expire
  overrun   ///< only the first `length` frames of a tick are received
};
constexpr std::size_t kFaultKinds = static_cast<std::size_t>(FaultKind::overrun) + 1;
constexpr bool of_port(FaultKind kind) noexcept { return kind >= FaultKind::babble; }

enum class Direction : std::uint8_t { out, in, both };

/// One line of a schedule: it affects each matching frame, or for a fault of the port each tick, with
/// probability `chance`.
struct Fault {
  FaultKind kind;
  std::uint32_t from_tick = 0;
  std::uint32_t to_tick = UINT32_MAX;  ///< the first tick after it
  Direction direction = Direction::both;
  std::uint32_t match_id = 0;    ///< only frames whose identifier has these bits...
  std::uint32_t match_mask = 0;  ///< ...where this has ones
  double chance = 1;
  std::uint32_t length = 1;
  std::uint32_t ticks = 1;
  std::uint32_t jitter = 0;
  std::uint32_t id = 0;
};

using Schedule = std::vector<Fault>;

/// Number of occurrences of each kind, by its index: affected, lost or added frames; entries into bus_off and
/// down; passive ticks.
using Tally = std::array<std::uint32_t, kFaultKinds>;

inline std::uint32_t& of(Tally& tally, FaultKind kind) noexcept {
  return tally[static_cast<std::size_t>(kind)];
}

/// Corrects the check value of a frame for its data.
using Repair = std::function<void(hal::CanFrame&)>;

}  // namespace whisker::bus
