#include <algorithm>
#include <cmath>

#include "host/calibration/wall_search.hpp"
#include "host/scenario/bearing.hpp"

namespace whisker::calibration {
namespace {

constexpr double kOnWall = 4;  // standard deviations
constexpr double kWindow = 6 * kRadPerDeg;
constexpr double kSharp = 1.5 * kRadPerDeg;  // less is chance
constexpr double kInward = 0.5 * kRadPerDeg;
constexpr double kFewMissing = 0.03;  // share
constexpr double kChance = 2;         // standard deviations

struct Count {
  double looks = 0;
  double missing = 0;
  double share() const { return looks > 0 ? missing / looks : 0; }
};

}  // namespace

double sure_edge(const Wall& wall, const std::vector<Look>& looks, const Errors& errors, double min_range) {
  const auto count = [&](double from, double to) {
    Count c;
    for (const Look& look : looks) {
      const Prediction p = predict(wall, look, errors, min_range);
      if (look.lost || !p.visible || p.uncertain || p.off_axis < from || p.off_axis > to) continue;
      c.looks += 1;
      c.missing += std::fabs(look.metres - p.metres) < kOnWall * errors.sigma ? 0 : 1;
    }
    return c;
  };
  // Most of what a window misses, it misses at its outer end: the middle of the first good one is sure.
  const double usual = count(0, wall.edge / 2).share() + kFewMissing;
  for (double edge = wall.edge; edge > wall.edge / 2; edge -= kInward) {
    const Count c = count(edge - kWindow, edge);
    if (c.share() <= usual + kChance * std::sqrt(usual * (1 - usual) / std::max(c.looks, 1.0))) {
      return wall.edge - edge < kSharp ? wall.edge : edge - kWindow / 2;
    }
  }
  return wall.edge / 2;
}

}  // namespace whisker::calibration
