/// Detects moving objects by comparison with recent scans.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"

namespace whisker::perception {

/// The last few scans, each a pose and an empty sector per beam.
///
/// In a static world, an object that a beam sees was there before. So if an echo lies completely in ground
/// that earlier sectors showed empty, something has moved. The sectors are reduced and the place of the echo
/// is widened by the possible error of the pose estimate, so that a static world causes no detection.
class MotionDetector {
 public:
  static constexpr int kBeams = 3;
  /// Echoes farther away are ignored.
  static constexpr Length kReach = Length::from_raw(700000);

  /// The mounts must outlive it.
  void configure(const Mount (&mounts)[kBeams]) noexcept;
  void reset() noexcept {
    count_ = 0;
    newest_ = kKept - 1;
  }

  /// All beams at one time: nothing lies nearer than free[i], and `hits` has the bit of each beam that has an
  /// echo from there. The scan is kept if the body has moved or turned since the last kept one, or after some
  /// time.
  void add(const Pose& from, Time taken, const Length (&free)[kBeams], uint8_t hits) noexcept;

  /// True if no point of the beam's cone between these two distances could have been occupied before: each
  /// lies in a kept sector or in clear ground. `misaimed`: the beam may point beside its axis, so
  /// that its cone counts as 5 degrees wider on either side.
  bool contradicts(const Beam& beam, Length nearest, Length farthest, bool misaimed,
                   const LocalGrid& local_grid) const noexcept;

  /// The direction in which the object at this place has moved, by the oldest scan that has an echo of it.
  /// False: there is none.
  bool came_from(Vec at, Angle& direction) const noexcept;

 private:
  static constexpr int kKept = 10;
  static constexpr int kSectors = 8;
  static constexpr int32_t kRayUnits = 5;  // of Work, for a scan
  using Mask = uint32_t;                   // one bit per kept sector
  static_assert(kKept * kBeams <= 32);
  static constexpr Mask kOfScan = (Mask{1} << kBeams) - 1;
  /// Cosine and sine of a direction, 2^-14.
  struct Roughly {
    Roughly() noexcept = default;
    explicit Roughly(Facing direction) noexcept : cos(q14(direction.cos)), sin(q14(direction.sin)) {}
    int16_t cos = 0;
    int16_t sin = 0;
  };
  struct Scan {
    Vec at;
    Angle heading;
    Roughly facing;              // the same direction
    uint16_t free[kBeams] = {};  // 1/8 mm
    uint8_t hits = 0;            // as in add()
    uint8_t farthest = 0;        // the beam with the largest `free`
  };
  struct Near;
  /// The kept sectors that contain this point.
  Mask holding(Vec point, Mask among) const noexcept;
  /// The same for one sector, given the vector from its scan to the point and the direction of the scan;
  /// exact to a few micrometres.
  bool holds(const Scan& scan, int beam, Vec way, Facing heading) const noexcept;

  Time newest_taken_;
  int8_t newest_ = kKept - 1;
  uint8_t count_ = 0;
  const Mount* mounts_ = nullptr;
  Roughly left_[kBeams];   // edge of the cone, on a body that faces 0
  Roughly right_[kBeams];  // the other one
  Length outermost_;       // distance of an apex from the centre
  Scan scan_[kKept];
};

}  // namespace whisker::perception
