/// What the beams saw a moment ago, to tell what moves from what was there before.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"

namespace whisker::perception {

/// The last few scans, each a pose and an empty sector per beam.
///
/// In a world at rest, whatever a beam sees was there before: so where its echo lies wholly in ground that
/// earlier sectors showed empty, something has moved. The sectors are shrunk and the echo's place widened by
/// what the estimated pose may be wrong, so that a world at rest never contradicts.
class MotionDetector {
 public:
  static constexpr int kBeams = 3;
  /// Nothing farther away than this is judged.
  static constexpr Length kReach = Length::from_raw(700000);

  void configure(const Params& params) noexcept;
  void reset() noexcept {
    count_ = 0;
    newest_ = kKept - 1;
  }

  /// All beams at one time: nothing lies nearer than free[i]. Kept if the body has moved or turned since the
  /// last one that was kept, or after a while.
  void add(const Pose& from, Time taken, const Length (&free)[kBeams]) noexcept;

  /// True if no point of the beam's cone between these two distances could have been occupied before: each
  /// lies in a kept sector or in clear ground.
  bool contradicts(const Pose& from, int beam, Length nearest, Length farthest,
                   const LocalGrid& local_grid) const noexcept;

 private:
  static constexpr int kKept = 10;
  static constexpr int kSectors = 8;
  using Mask = uint32_t;  // a bit per kept sector
  static_assert(kKept * kBeams <= 32);
  /// A direction's cosine and sine, 2^-14.
  struct Facing {
    int16_t cos = 0;
    int16_t sin = 0;
  };
  static Facing facing(Angle direction) noexcept;
  /// What lies at v, seen in this direction; off by up to 90 um at 2 m.
  static Vec seen(Vec v, Facing facing) noexcept;
  struct Scan {
    Vec at;
    Angle heading;
    Facing facing;               // the same
    uint16_t free[kBeams] = {};  // 1/8 mm
  };
  /// The kept sectors that hold this point.
  Mask holding(Vec point, Mask among) const noexcept;
  /// The same of one sector and the way from its scan to the point, to the micrometre.
  bool holds(const Scan& scan, int beam, Vec way) const noexcept;

  Scan scan_[kKept];
  Time newest_taken_;
  int8_t newest_ = kKept - 1;
  int8_t count_ = 0;
  Angle side_;
  Angle half_;
  Facing beam_[kBeams];
  Facing edge_;  // half_
  Length offset_;
};

}  // namespace whisker::perception
