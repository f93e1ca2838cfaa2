/// Identifiers: function << 4 | node of the sender. A lower identifier wins arbitration, so the function is
/// the priority. An operator is no node: it sends functions that no controller sends, with the controller's
/// number.
#pragma once

#include <stdint.h>

namespace whisker::can {

/// The two nodes of a robot.
enum class Party : uint8_t {
  controller,  ///< decides: nodes 1 to 7
  base,        ///< has the sensors and the wheels: node of its controller + 8
};

constexpr uint8_t kRobots = 7;
constexpr uint8_t kBaseOffset = 8;

/// robot: 1..kRobots.
constexpr uint8_t node_of(uint8_t robot, Party party) noexcept {
  return party == Party::base ? static_cast<uint8_t>(robot + kBaseOffset) : robot;
}

constexpr Party other(Party party) noexcept { return party == Party::base ? Party::controller : Party::base; }

constexpr uint32_t id_of(uint8_t function, uint8_t node) noexcept {
  return static_cast<uint32_t>(function) << 4 | node;
}

}  // namespace whisker::can
