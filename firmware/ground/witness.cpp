#include "firmware/ground/witness.hpp"

namespace whisker::ground {
namespace {

constexpr int32_t kUm = 125;  // in 1/8 mm
constexpr Length kFarthest = 2_m;
// Of the estimated pose over the ways that the scans span, and of a reading's rounding.
constexpr Length kSlack = 3_mm;
constexpr Angle kWidening = Angle::turns(5, 3600);
// Three readings of a wall at rest are not all this much too near.
constexpr Length kNoise = 30_mm;
constexpr Length kStep = 60_mm;
constexpr Angle kTurn = Angle::turns(75, 3600);
constexpr Duration kWhile = 250_ms;

}  // namespace

void Witness::configure(const Params& params) noexcept {
  side_ = params.rangefinders.side_angle;
  half_ = Angle::from_raw(params.rangefinders.cone.raw() / 2);
  offset_ = params.rangefinders.offset;
}

void Witness::add(const Pose& from, Time taken, const Length (&free)[kBeams]) noexcept {
  if (count_ > 0) {
    const Scan& last = scan_[newest_];
    if (norm(from.at - last.at) < kStep && magnitude(from.heading - last.heading) < kTurn.raw() &&
        taken - newest_taken_ < kWhile) {
      return;
    }
  }
  newest_ = static_cast<int8_t>((newest_ + 1) % kKept);
  if (count_ < kKept) ++count_;
  newest_taken_ = taken;
  Scan& scan = scan_[newest_];
  scan.at = from.at;
  scan.heading = from.heading;
  for (int i = 0; i < kBeams; ++i) {
    scan.free[i] = static_cast<uint16_t>(min(free[i], kFarthest).raw() / kUm);
  }
}

Witness::Mask Witness::holding(Vec point, Mask among) const noexcept {
  Mask holding = 0;
  for (int n = 0; n < count_; ++n) {
    const Mask beams = among >> (n * kBeams) & ((1U << kBeams) - 1);
    if (beams == 0) continue;
    const Scan& scan = scan_[n];
    const Vec rel = point - scan.at;
    if (norm(rel) > kFarthest) continue;
    const Angle direction = bearing(rel) - scan.heading;
    for (int i = 0; i < kBeams; ++i) {
      if ((beams >> i & 1U) == 0) continue;
      const Angle off = direction - beam_axis(side_, i);
      if (magnitude(off) > (90_deg).raw()) continue;
      const Length reach = norm(rel);
      const Length forward = reach * cos(off) - offset_;
      const Length aside = abs(reach * sin(off));
      const Length from_apex = norm({forward, aside});
      if ((from_apex + kSlack).raw() / kUm > scan.free[i]) continue;
      // Across the nearer edge.
      const Length inside = forward * sin(half_) - aside * cos(half_);
      if (inside >= kSlack) holding |= 1U << (n * kBeams + i);
    }
  }
  return holding;
}

bool Witness::contradicts(const Pose& from, int beam, Length nearest, Length farthest,
                          const Patch& patch) const noexcept {
  if (farthest > kReach || nearest <= Length{}) return false;
  const Angle axis = from.heading + beam_axis(side_, beam);
  const Vec apex = from.at + polar(axis, offset_);
  const Angle half = half_ + kWidening;
  const Angle step = Angle::from_raw(half.raw() / (kSectors / 2));
  const Length far = farthest + kNoise;
  // Cells are coarse: what stands in one takes the ground before it, too.
  const Length beyond = farthest + kNoise / 3;
  const Length middle = (nearest + beyond) / 2;
  const Length radius = (beyond - nearest) / 2 + arc(step, far) / 2 + kSlack;
  Mask before = 0;
  for (int k = 0; k <= kSectors; ++k) {
    const Angle direction = axis - half + step * k;
    const Mask here = holding(apex + polar(direction, far), ~Mask{0});
    const Mask both = here == 0 ? 0 : holding(apex + polar(direction, nearest), here);
    if (k > 0 && (both & before) == 0) {
      const Angle centre = direction - Angle::from_raw(step.raw() / 2);
      if (!patch.all_clear(apex + polar(centre, middle), radius)) return false;
    }
    before = both;
  }
  return true;
}

}  // namespace whisker::ground
