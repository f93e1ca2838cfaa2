#include "host/lab/calibration/beam_fit.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/bearing.hpp"
#include "host/lab/calibration/wall_model.hpp"

namespace whisker::calibration {
namespace {

constexpr std::size_t kFewest = 60;  // readings
constexpr double kLeastTurn = 330;   // deg
constexpr int kFewestEchoes = 8;
constexpr double kWallGain = 25;           // logarithm of a likelihood ratio: chance gives less than 15
constexpr double kLeastShare = 0.5;        // of the echoes within the edges that must be of the wall
constexpr double kFarther = 1.4;           // a second wall this much farther away is cut off
constexpr double kMostAxisError = 2;       // deg
constexpr double kMostSigma = 0.15;        // of the wall's distance
constexpr double kSmallestSigma = 0.0015;  // m: readings are whole millimetres

double turn_of(const Samples& samples) {
  const auto [low, high] =
      std::minmax_element(samples.begin(), samples.end(),
                          [](const auto& a, const auto& b) { return a.heading_rad < b.heading_rad; });
  return (high->heading_rad - low->heading_rad) / kRadPerDeg;
}

/// Counts what the wall explains, and learns the errors of the sensor from it.
void count(BeamFit& fit, const Wall& wall, const std::vector<Look>& looks, Errors& errors, double min_range) {
  std::vector<double> off;
  int inside = 0, outside = 0;
  fit.on_wall = fit.dropouts = fit.wild = fit.phantoms = 0;
  for (const Look& look : looks) {
    const Prediction p = predict(wall, look, errors, min_range);
    const bool echo = look.metres > 0 && look.metres < errors.within;
    if (p.off_axis > wall.edge) {
      fit.phantoms += echo ? 1 : 0;
      outside += look.lost ? 0 : 1;
    } else if (p.visible && !p.uncertain) {
      const double residual = std::fabs(look.metres - p.metres);
      const bool on_wall = echo && residual < 4 * errors.sigma;
      ++(on_wall ? fit.on_wall : echo ? fit.wild : fit.dropouts);
      if (on_wall) off.push_back(residual);
      inside += look.lost ? 0 : 1;
    }
  }
  int missed = 0;
  for (const Look& look : looks) {
    const Prediction p = predict(wall, look, errors, min_range);
    missed += p.off_axis <= wall.edge && p.visible && !p.uncertain && !look.lost && look.metres == 0 ? 1 : 0;
  }
  errors.dropout = std::clamp((missed + 1.0) / (inside + 10.0), 0.02, 0.45);
  errors.phantom = std::clamp((fit.phantoms + 1.0) / (outside + 10.0), 0.02, 0.6);
  if (off.empty()) return;
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  errors.sigma = std::max(1.4826 * *middle, kSmallestSigma);
}

struct Solution {
  Wall wall;
  double gain = 0;
};

/// Alternates between the wall and the errors.
Solution solve(BeamFit& fit, const std::vector<Look>& looks, const Believed& beam, Errors& errors) {
  Solution s;
  s.wall = coarse_search(looks, beam, errors);
  for (const bool final : {false, false, true}) {
    s.gain = refine(s.wall, looks, errors, beam.min_range_m, final);
    count(fit, s.wall, looks, errors, beam.min_range_m);
  }
  return s;
}

/// What is left without the readings up to a little beyond the edges: a second wall, or chance.
Solution second(const Wall& wall, const std::vector<Look>& looks, const Believed& beam,
                const Errors& errors) {
  std::vector<Look> rest;
  for (const Look& look : looks) {
    if (std::fabs(wrapped(look.heading - wall.facing)) > wall.edge + 2 * kRadPerDeg) rest.push_back(look);
  }
  Solution s;
  s.wall = coarse_search(rest, beam, errors);
  s.gain = gain(s.wall, rest, errors, beam.min_range_m);
  return s;
}

}  // namespace

BeamFit fit_beam(const Samples& samples, const Believed& beam, double wall_deg) {
  BeamFit fit;
  fit.readings = static_cast<int>(samples.size());
  if (samples.size() < kFewest) return fit;
  fit.turn_deg = turn_of(samples);
  fit.trouble = Trouble::not_enough_turn;
  if (fit.turn_deg < kLeastTurn) return fit;

  const std::vector<Look> all = looks(samples, beam, wall_deg * kRadPerDeg);
  const auto echoes = std::count_if(all.begin(), all.end(), [](const Look& l) { return l.metres > 0; });
  fit.trouble = Trouble::nothing_seen;
  if (echoes < kFewestEchoes) return fit;

  Errors errors;
  errors.within = beam.max_range_m;
  Solution s;
  for (int walls = 0;; ++walls) {
    const double within = errors.within;
    errors = {};
    errors.within = within;
    s = solve(fit, all, beam, errors);
    fit.trouble = Trouble::no_wall;
    if (s.gain < kWallGain || fit.on_wall < kFewestEchoes) return fit;
    if (fit.on_wall < kLeastShare * (fit.on_wall + fit.wild + fit.dropouts)) return fit;
    const Solution other = second(s.wall, all, beam, errors);
    if (other.gain < kWallGain) break;
    fit.trouble = Trouble::second_wall;
    fit.wall_m = std::min(s.wall.distance, other.wall.distance);
    fit.second_m = std::max(s.wall.distance, other.wall.distance);
    if (fit.second_m < kFarther * fit.wall_m || walls == 4) return fit;
    errors.within = std::min(0.9 * fit.second_m, 0.97 * errors.within);
  }

  const Uncertainty u = uncertainty(s.wall, all, errors, beam.min_range_m);
  fit.axis_deg = wrapped(-s.wall.facing) / kRadPerDeg;
  fit.axis_error_deg = u.facing / kRadPerDeg;
  fit.edge_deg = s.wall.edge / kRadPerDeg;
  fit.edge_error_deg = u.edge / kRadPerDeg;
  fit.sure_edge_deg = sure_edge(s.wall, all, errors, beam.min_range_m) / kRadPerDeg;
  fit.edge_is_bound = u.edge_is_bound;
  fit.half_cone_deg = std::min(s.wall.half_cone, s.wall.edge) / kRadPerDeg;
  fit.half_cone_error_deg = u.half_cone / kRadPerDeg;
  fit.wall_m = s.wall.distance;
  fit.wall_error_m = u.distance;
  fit.second_m = 0;
  fit.sigma_m = errors.sigma;
  fit.within_m = errors.within;
  const bool noisy = fit.axis_error_deg > kMostAxisError || fit.sigma_m > kMostSigma * fit.wall_m;
  fit.trouble = noisy ? Trouble::too_noisy : Trouble::none;
  return fit;
}

}  // namespace whisker::calibration
