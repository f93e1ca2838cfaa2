/// Tells a beam that has stopped measuring from one in a round room.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"

namespace whisker::perception {

/// One beam whose readings repeat the same millimetre.
///
/// Over a turn of `stuck_turn`, a beam may repeat it because what is around has the same shape in all
/// directions: walls or posts in a ring, with the centre of the body's own rotation for their centre. That
/// the beam is stuck is known only once it still repeats it although the body has left this rotation, by 20
/// mm and an eighth of its radius: a ring would then come nearer, or recede. Standing, turning on and
/// circling on leave it open.
class Repetition {
 public:
  /// The next distance, and the body as it arrives. True: the beam is stuck, until the distance differs.
  bool stuck(uint16_t mm, const Pose& body, Angle stuck_turn) noexcept;
  void end() noexcept { phase_ = Phase::over; }

 private:
  enum class Phase : uint8_t { over, repeats, suspected, stuck };
  void suspect(const Pose& body, Angle turn) noexcept;

  Phase phase_ = Phase::over;
  uint16_t mm_ = 0;
  // The body at the first repetition; once suspected, the centre of the rotation that has led from there to
  // the body then, in the world and as seen from the body.
  Vec at_;
  Angle heading_;
  Length radius_;
};

}  // namespace whisker::perception
