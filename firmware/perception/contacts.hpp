/// Obstacles that a bump switch has found; the beams may not see them.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"

namespace whisker::perception {

/// The last kKept places of contact, as discs. They stay obstacles whatever the beams see there.
class Contacts {
 public:
  static constexpr int8_t kKept = 16;

  /// Takes a third of the body's radius as that of every disc.
  void configure(Length body_radius) noexcept { radius_ = body_radius / 3; }
  void reset() noexcept { count_ = 0; }
  /// The body stands at `body` and touches something with these switches: hal::BumperReading::pressed, not 0.
  /// A place within half a radius of a known one is not kept.
  void add(uint8_t pressed, const Pose& body) noexcept;

  int count() const noexcept { return count_; }
  /// The centre of a disc; 0 <= n < count().
  Vec at(int n) const noexcept { return places_[n]; }
  Length radius() const noexcept { return radius_; }

 private:
  Vec places_[kKept];
  Length radius_;
  int8_t count_ = 0;
  int8_t next_ = 0;
};

}  // namespace whisker::perception
