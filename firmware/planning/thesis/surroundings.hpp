/// Free distances in all directions, from the static scans at one position.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/echo.hpp"

namespace whisker::planning {

/// A ring of sectors. An echo at distance d means that nothing in its cone is nearer than d. A sector covered
/// by several cones keeps the largest such distance. The ring is cleared when the body drives on.
class Surroundings {
 public:
  static constexpr int kSectors = 72;

  void configure(const Params& params) noexcept;
  void forget() noexcept;

  /// Adds a static scan at this heading of the body. Unusable beams add nothing.
  void add(const perception::Echoes& look, Angle heading) noexcept;

  /// False if a sector ahead of the flanks does not keep the path of this length along `heading` free by
  /// radius + margin on both sides. Unknown sectors and those behind are ignored.
  bool allow(Angle heading, Length step) const noexcept;

 private:
  static constexpr uint16_t kUnknown = 0;
  /// A cone as seen from the body's centre, at its rim.
  struct Seen {
    Angle axis;
    uint32_t half = 0;  // 2^-32 turn
    Length ahead;       // minimum by which an echo is farther from the centre than from the apex
  };
  Length reach_;  // radius + margin
  Seen beam_[hal::kBeams];
  uint16_t free_mm_[kSectors] = {};  // from the body's centre; rounded down
};

}  // namespace whisker::planning
