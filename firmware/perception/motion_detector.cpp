#include "firmware/perception/motion_detector.hpp"

namespace whisker::perception {
namespace {

constexpr int32_t kUm = 125;  // in units of 1/8 mm
constexpr Length kFarthest = 2_m;
// Error of the estimated pose over the path between the scans, plus the rounding of a reading.
constexpr Length kSlack = 3_mm;
constexpr Angle kWidening = Angle::turns(5, 3600);
constexpr Angle kMisaim = 5_deg + kWidening;
// Noise bound: three readings of a wall at rest are not all too short by this.
constexpr Length kNoise = 30_mm;
constexpr Length kStep = 60_mm;
constexpr Angle kTurn = Angle::turns(75, 3600);
constexpr Duration kWhile = 250_ms;
// Closer than this to a sector's rim, MotionDetector::Near is too coarse to decide.
constexpr Length kHair = micrometres(500);
// Displacement of a moving object over the kept scans. A shorter one has no certain direction.
constexpr Length kDisplaced = 40_mm;
constexpr Length kFarthestDisplaced = 500_mm;

}  // namespace

void MotionDetector::configure(const Mount (&mounts)[kBeams]) noexcept {
  mounts_ = mounts;
  outermost_ = Length{};
  for (int i = 0; i < kBeams; ++i) {
    left_[i] = Roughly(facing(mounts[i].axis + mounts[i].half_cone));
    right_[i] = Roughly(facing(mounts[i].axis - mounts[i].half_cone));
    outermost_ = max(outermost_, norm(mounts[i].apex));
  }
}

void MotionDetector::add(const Pose& from, Time taken, const Length (&free)[kBeams], uint8_t hits) noexcept {
  if (count_ > 0) {
    const Scan& last = scan_[newest_];
    if (!farther(from.at - last.at, kStep - micrometres(1)) &&
        magnitude(from.heading - last.heading) < kTurn.raw() && taken - newest_taken_ < kWhile) {
      return;
    }
  }
  newest_ = static_cast<int8_t>((newest_ + 1) % kKept);
  if (count_ < kKept) ++count_;
  newest_taken_ = taken;
  Scan& scan = scan_[newest_];
  scan.at = from.at;
  scan.heading = from.heading;
  scan.facing = Roughly(facing(from.heading));
  scan.hits = hits;
  for (int i = 0; i < kBeams; ++i) {
    scan.free[i] = narrow<uint16_t>(min(free[i], kFarthest).raw() / kUm);
    if (i == 0 || scan.free[i] > scan.free[scan.farthest]) scan.farthest = static_cast<uint8_t>(i);
  }
}

/// A vector of at most 4 m in 32 um, so that its products with a direction fit into 32 bits. The error of
/// what follows is at most 0.3 mm at 2 m.
struct MotionDetector::Near {
  int32_t x;
  int32_t y;

  static constexpr int32_t units(Length l) noexcept { return l.raw() / 32; }
  static constexpr Near of(const Vec& v) noexcept { return {units(v.x), units(v.y)}; }
  constexpr int32_t along(Roughly d) const noexcept { return (x * d.cos + y * d.sin) / (1 << 14); }
  /// To the left of a line in this direction.
  constexpr int32_t aside(Roughly d) const noexcept { return (y * d.cos - x * d.sin) / (1 << 14); }
  /// norm() > distance >= 0.
  constexpr bool farther(int32_t distance) const noexcept {
    const auto squared = [](int32_t a) { return static_cast<uint32_t>(a / 2 * (a / 2)); };
    return squared(x) + squared(y) > squared(distance);
  }
};

bool MotionDetector::holds(const Scan& scan, int beam, Vec way, Facing heading) const noexcept {
  const Mount& mount = mounts_[beam];
  const Vec from_apex = Vec{along(way, heading), -across(way, heading)} - mount.apex;
  // Within both edges; never both behind the apex.
  if (across(from_apex, mount.axis + mount.half_cone) < kSlack) return false;
  if (-across(from_apex, mount.axis - mount.half_cone) < kSlack) return false;
  return !farther(from_apex, Length::from_raw((scan.free[beam] + 1) * kUm - 1) - kSlack);
}

MotionDetector::Mask MotionDetector::holding(Vec point, Mask among) const noexcept {
  Mask holding = 0;
  for (int n = 0; n < count_ && among >> (n * kBeams) != 0; ++n) {
    if ((among >> (n * kBeams) & kOfScan) == 0) continue;
    const Scan& scan = scan_[n];
    const Vec way = point - scan.at;
    const Length free = Length::from_raw(scan.free[scan.farthest] * kUm);
    if (farther(way, min(kFarthest, outermost_ + free))) continue;
    const Near off = Near::of(way);
    const Near seen{off.along(scan.facing), off.aside(scan.facing)};
    bool turned = false;
    Facing heading;
    for (int i = 0; i < kBeams; ++i) {
      const Mask bit = Mask{1} << (n * kBeams + i);
      if ((among & bit) == 0) continue;
      const Near apex = Near::of(mounts_[i].apex);
      const Near from_apex{seen.x - apex.x, seen.y - apex.y};
      const int32_t right_of_left = -from_apex.aside(left_[i]);
      const int32_t left_of_right = from_apex.aside(right_[i]);
      const int32_t inwards = right_of_left < left_of_right ? right_of_left : left_of_right;
      if (inwards < Near::units(kSlack - kHair)) continue;
      const Length rim = Length::from_raw(scan.free[i] * kUm) - kSlack;
      if (rim < -kHair || from_apex.farther(Near::units(rim + kHair))) continue;
      const bool well_inside = inwards >= Near::units(kSlack + kHair) && rim > kHair &&
                               !from_apex.farther(Near::units(rim - kHair));
      if (!well_inside && !turned) heading = facing(scan.heading);
      turned = turned || !well_inside;
      if (well_inside || holds(scan, i, way, heading)) holding |= bit;
    }
  }
  return holding;
}

bool MotionDetector::contradicts(const Beam& beam, Length nearest, Length farthest, bool misaimed,
                                 const LocalGrid& local_grid) const noexcept {
  if (farthest > kReach || nearest <= Length{}) return false;
  const Angle half = beam.half_cone + (misaimed ? kMisaim : kWidening);
  const Angle step = Angle::from_raw(half.raw() / (kSectors / 2));
  const Length far = farthest + kNoise;
  // A cell is coarse: an obstacle in it also occupies the cell's ground before the obstacle.
  const Length beyond = farthest + kNoise / 3;
  const Length middle = (nearest + beyond) / 2;
  const Length radius = (beyond - nearest) / 2 + arc(step, far) / 2 + kSlack;
  const auto ray = [&](int k) { return beam.axis - half + step * k; };
  // The sectors in `among` that contain the ray k from `nearest` to `far`.
  const auto across = [&](int k, Mask among) {
    if (among == 0) return Mask{0};
    for (Mask scans = among; scans != 0; scans >>= kBeams) {
      if ((scans & kOfScan) != 0) local_grid.work().add(kRayUnits);
    }
    const Q30 x = cos(ray(k));
    const Q30 y = sin(ray(k));
    const Mask behind = holding(beam.apex + Vec{far * x, far * y}, among);
    return behind == 0 ? Mask{0} : holding(beam.apex + Vec{nearest * x, nearest * y}, behind);
  };
  // Sectors that contain the ray examined last: only some, until others are asked for.
  const Mask all = (Mask{1} << (kBeams * count_)) - 1;
  int examined = -1;
  Mask some = 0;
  for (int n = 0; n < kSectors; ++n) {
    // Middle sectors first: an obstacle is most likely in the middle of the cone.
    const int k = (n + kSectors / 2) % kSectors;
    const Angle centre = ray(k + 1) - Angle::from_raw(step.raw() / 2);
    if (local_grid.all_clear(beam.apex + polar(centre, middle), radius)) continue;
    const Mask known = examined == k ? some : 0;
    some = across(k + 1, known);
    if (some == 0) some = across(k + 1, across(k, all & ~known));
    if (some == 0) return false;
    examined = k + 1;
  }
  return true;
}

bool MotionDetector::came_from(Vec at, Angle& direction) const noexcept {
  for (int n = count_; n > 0; --n) {
    const Scan& scan = scan_[(newest_ + kKept + 1 - n) % kKept];
    Vec way;
    Length nearest = kFarthestDisplaced;
    for (int i = 0; i < kBeams; ++i) {
      if ((scan.hits >> i & 1U) == 0) continue;
      const Beam beam = beam_of(mounts_[i], {scan.at, scan.heading});
      const Vec from = at - beam.apex - polar(beam.axis, Length::from_raw(scan.free[i] * kUm));
      if (farther(from, nearest)) continue;
      nearest = norm(from);
      way = from;
    }
    if (!farther(way, kDisplaced)) continue;
    direction = bearing(way);
    return true;
  }
  return false;
}

}  // namespace whisker::perception
