#include "host/lab/baselines/deflection_laws.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace whisker::baselines {
namespace {

constexpr double kMost_rad = 0.7853981633974483;
constexpr double kNearest_m = 0.05;
constexpr double kRawPerRad = 683565275.5764316;  // 2^32 / 2 pi

double push(Length range) {
  const double range_m = std::max(range.raw() * 1e-6, kNearest_m);
  return std::max(1 / range_m - 1 / RepulsionDeflection::kInfluence_m, 0.0);
}

}  // namespace

Angle RepulsionDeflection::deflect(const planning::View& view, Angle, const Params&,
                                   planning::Decision&) noexcept {
  const perception::Echoes& sight = view.moving_scan;
  const Length left = sight.beam[hal::kLeft].distance;
  const Length right = sight.beam[hal::kRight].distance;
  const double sides = push(right) - push(left);
  const double front = push(sight.beam[hal::kFront].distance);
  const double bend_rad = kSideGain_rad * sides + (left < right ? -kFrontGain_rad : kFrontGain_rad) * front;
  const double raw = std::floor(std::clamp(bend_rad, -kMost_rad, kMost_rad) * kRawPerRad + 0.5);
  return Angle::from_raw(static_cast<std::uint32_t>(static_cast<std::int64_t>(raw)));
}

}  // namespace whisker::baselines
