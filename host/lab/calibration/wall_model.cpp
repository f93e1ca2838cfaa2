#include "host/lab/calibration/wall_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/harness/sim/elementary.hpp"

namespace whisker::calibration {
namespace {

using sim::kPi;

constexpr int kBins = 1800;            // of the angle off the axis, up to half a turn
constexpr double kSteepest = 1.55;     // rad, incidence; a wall is not seen along itself
constexpr double kPhantomDensity = 2;  // a metre: phantoms come mostly from the nearest half metre
constexpr double kWild = 0.03;         // share of echoes within the edges that are not of the wall
constexpr double kNearLimit = 2.5;     // standard deviations

}  // namespace

double wrapped(double rad) {
  const double turn = std::remainder(rad, 2 * kPi);
  return turn <= -kPi ? kPi : turn;
}

std::vector<Look> looks(const Samples& samples, const Believed& beam, double wall_rad) {
  std::vector<Look> all;
  all.reserve(samples.size());
  for (const Sample& s : samples) {
    const double heading = wrapped(s.heading_rad - wall_rad);
    const double advance = beam.x_m * std::cos(heading) - beam.y_m * std::sin(heading);
    all.push_back({heading, advance, s.reading == Reading::echo ? s.metres : 0, s.reading == Reading::lost});
  }
  return all;
}

Prediction predict(const Wall& wall, const Look& look, const Errors& errors, double min_range) {
  Prediction p;
  p.off_axis = std::fabs(wrapped(look.heading - wall.facing));
  const double incidence = std::max(p.off_axis - wall.half_cone, 0.0);
  if (incidence > kSteepest) return p;
  p.metres = (wall.distance - look.advance) / std::cos(incidence);
  const double blur = kNearLimit * errors.sigma;
  p.uncertain = p.metres > errors.within - blur || p.metres < min_range + blur;
  p.visible = p.metres < errors.within + blur && p.metres > min_range - blur;
  return p;
}

double gain(Wall& wall, const std::vector<Look>& looks, const Errors& errors, double min_range) {
  const double missed = std::log(errors.dropout / (1 - errors.phantom));
  const double peak = (1 - errors.dropout) * (1 - kWild) / (std::sqrt(2 * kPi) * errors.sigma);
  const double wild = (1 - errors.dropout) * kWild * kPhantomDensity;
  const double phantom = errors.phantom * kPhantomDensity;
  std::array<double, kBins + 1> by_angle{};
  for (const Look& look : looks) {
    // A lost reading says nothing of the wall.
    if (look.lost) continue;
    const Prediction p = predict(wall, look, errors, min_range);
    if (!p.visible || p.uncertain) continue;
    double ratio = missed;
    if (look.metres > 0 && look.metres < errors.within) {
      const double z = (look.metres - p.metres) / errors.sigma;
      ratio = std::log((peak * std::exp(-0.5 * z * z) + wild) / phantom);
    }
    by_angle[static_cast<std::size_t>(p.off_axis * (kBins / kPi))] += ratio;
  }
  double sum = 0, best = 0;
  wall.edge = 0;
  for (std::size_t i = 0; i <= kBins; ++i) {
    sum += by_angle[i];
    if (sum <= best) continue;
    best = sum;
    wall.edge = static_cast<double>(i + 1) * (kPi / kBins);
  }
  return best;
}

}  // namespace whisker::calibration
