/// A mission on the bus: six values, one frame each, and an order with a digest of all six.
#pragma once

#include <stdint.h>

#include "firmware/can/messages.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::can {

struct Mission {
  Pose start{};
  planning::Goal goal{};
};

/// Parts 1 to 6 as raw values.
struct MissionValues {
  uint32_t of[kMissionValues] = {};
};

MissionValues values_of(const Mission& mission) noexcept;
/// False: a value is out of its range.
bool mission_of(const MissionValues& values, Mission& mission) noexcept;
/// FNV-1a 32, folded to 16 bits.
uint16_t digest_of(const MissionValues& values) noexcept;

/// Collects the parts of one mission at a time.
class MissionParts {
 public:
  /// A part of another mission restarts the collection.
  void on_frame(const MissionValue& part) noexcept;
  /// All parts of this mission have arrived and match.
  bool complete(const MissionOrder& order) const noexcept;
  const MissionValues& values() const noexcept { return values_; }
  void forget() noexcept { seen_ = 0; }

 private:
  MissionValues values_;
  uint8_t mission_ = 0;
  uint8_t seen_ = 0;
};

}  // namespace whisker::can
