#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hal/can_port.hpp"

namespace whisker::bus {

enum class FaultKind : std::uint8_t {
  // Of frames: each that is hit.
  loss,           ///< does not arrive; and neither do the `length` - 1 after it
  delay,          ///< arrives `ticks` later, and up to `jitter` more: later ones may overtake it
  duplicate,      ///< arrives twice
  reorder,        ///< arrives after the next one
  corrupt,        ///< one bit of its data is wrong
  forge,          ///< one bit of its data is wrong, and its check value is right again: see Repair
  freeze,         ///< has the data of the first one with its identifier that was hit: a stuck counter
  wrong_size,     ///< has another size
  make_remote,    ///< is a remote frame
  make_extended,  ///< has the extended format, with the same identifier
  masquerade,     ///< has identifier `id`
  // Of the port, for as long as they last.
  babble,   ///< somebody sends `length` frames a tick with identifier `id`, and none that it outbids leaves
  bus_off,  ///< the controller goes bus-off, again and again while it lasts; restart() ends it after that
  passive,  ///< the controller is error-passive
  down,     ///< the interface is down, and comes back by itself
  full,     ///< the driver has no room: what is sent waits until it is too old
  overrun   ///< only the first `length` frames of a tick are received
};
constexpr std::size_t kFaultKinds = static_cast<std::size_t>(FaultKind::overrun) + 1;
constexpr bool of_port(FaultKind kind) noexcept { return kind >= FaultKind::babble; }

enum class Direction : std::uint8_t { out, in, both };

/// One line of a schedule: it hits each frame that matches, or for a fault of the port each tick, with
/// `chance`.
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

/// Times that each kind acted, by its number: frames that were hit, lost or added; entries into bus_off and
/// down; passive ticks.
using Tally = std::array<std::uint32_t, kFaultKinds>;

inline std::uint32_t& of(Tally& tally, FaultKind kind) noexcept {
  return tally[static_cast<std::size_t>(kind)];
}

/// Makes a frame's check value right for its data.
using Repair = std::function<void(hal::CanFrame&)>;

}  // namespace whisker::bus
