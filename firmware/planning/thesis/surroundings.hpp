/// What the looks from one standing place have proved, all around.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/echo.hpp"

namespace whisker::planning {

/// A ring of sectors. An echo at distance d proves that nothing in its cone is nearer than d; a sector that
/// several cones cover keeps the largest such distance. Forgotten when the body moves away.
class Surroundings {
 public:
  static constexpr int kSectors = 72;

  void configure(const Params& params) noexcept;
  void forget() noexcept;

  /// Adds a look taken with the body at this heading. Beams that are not usable add nothing.
  void add(const perception::Echoes& look, Angle heading) noexcept;

  /// False if some sector ahead of the flanks does not keep the way of this length along `heading` free by
  /// radius + margin on both sides. Sectors without proof, and those behind, do not object.
  bool allow(Angle heading, Length step) const noexcept;

 private:
  static constexpr uint16_t kUnknown = 0;
  Length reach_;       // radius + margin
  Angle side_;         // of the left beam's axis
  uint32_t half_ = 0;  // of the cone as seen from the body's centre, beyond its rim; 2^-32 turn
  Length ahead_;       // by which an echo is farther from the centre than from the apex, at least
  uint16_t free_mm_[kSectors] = {};  // from the body's centre; rounded down
};

}  // namespace whisker::planning
