#include "host/lab/calibration/wall_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host/harness/scenario/bearing.hpp"

namespace whisker::calibration {
namespace {

constexpr double kBin = 0.02;  // m
constexpr std::size_t kModes = 8;
constexpr std::size_t kCoarseLooks = 400;  // enough to find a wall
constexpr double kHeadingStep = 5 * kRadPerDeg;
constexpr double kNarrowest = 0.5 * kRadPerDeg, kWidest = 60 * kRadPerDeg;  // half cones

/// The distances of the centre that come up most often, if every echo were that of the wall's foot.
std::vector<double> modes(const std::vector<Look>& looks, double within) {
  std::map<int, int> counts;
  for (const Look& l : looks) {
    if (l.metres > 0 && l.metres < within) ++counts[static_cast<int>((l.metres + l.advance) / kBin)];
  }
  std::vector<std::pair<int, int>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](auto& a, auto& b) { return a.second > b.second; });
  if (sorted.size() > kModes) sorted.resize(kModes);
  std::vector<double> all;
  for (const auto& [bin, n] : sorted) all.push_back((bin + 0.5) * kBin);
  return all;
}

struct Direction {
  double facing, half_cone, distance;
};
// The distance and the width of the cone change the readings alike, hence the last two.
constexpr Direction kDirections[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 0}, {-1, 1, 0}};

bool allowed(const Wall& w) { return w.half_cone >= kNarrowest && w.half_cone <= kWidest && w.distance > 0; }

/// Evenly fewer, so that the search is fast.
std::vector<Look> thinned(const std::vector<Look>& looks) {
  const std::size_t step = looks.size() / kCoarseLooks + 1;
  std::vector<Look> some;
  for (std::size_t i = 0; i < looks.size(); i += step) some.push_back(looks[i]);
  return some;
}

/// Halfway between the outermost reading within the edge and the next one.
void settle_edge(Wall& wall, const std::vector<Look>& looks, const Errors& errors, double min_range) {
  double inner = 0, outer = 2 * wall.edge;
  for (const Look& look : looks) {
    const Prediction p = predict(wall, look, errors, min_range);
    if (look.lost || !p.visible || p.uncertain) continue;
    if (p.off_axis <= wall.edge) {
      inner = std::max(inner, p.off_axis);
    } else {
      outer = std::min(outer, p.off_axis);
    }
  }
  if (outer - inner < kHeadingStep) wall.edge = (inner + outer) / 2;
}

double climb(Wall& wall, const std::vector<Look>& looks, const Errors& errors, double min_range,
             double step) {
  double best = gain(wall, looks, errors, min_range);
  for (; step > 0.02 * kRadPerDeg; step /= 2) {
    const double metres = step * 0.25;
    for (bool better = true; better;) {
      better = false;
      for (const Direction& d : kDirections) {
        for (const double sign : {1.0, -1.0}) {
          Wall to = wall;
          to.facing += sign * d.facing * step;
          to.half_cone += sign * d.half_cone * step;
          to.distance += sign * d.distance * metres;
          if (!allowed(to)) continue;
          const double g = gain(to, looks, errors, min_range);
          if (g <= best + 1e-9) continue;
          best = g;
          wall = to;
          better = true;
        }
      }
    }
  }
  return best;
}

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

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

/// The inverse of a symmetric, positive definite matrix.
Matrix inverse(const Matrix& a) {
  Matrix minor{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      minor[i][j] = a[r][c] * a[s][d] - a[r][d] * a[s][c];
    }
  }
  const double det = a[0][0] * minor[0][0] + a[0][1] * minor[0][1] + a[0][2] * minor[0][2];
  for (Vector& row : minor) {
    for (double& x : row) x /= det;
  }
  return minor;
}

constexpr double kWeak = 0.35;         // rad: what is known of an angle without any reading
constexpr double kBinError = 0.0017;   // rad, of axis and edge: their resolution
constexpr double kModelError = 0.003;  // rad, of the half cone: real cones have no sharp edge

}  // namespace

Wall coarse_search(const std::vector<Look>& looks, const Believed& beam, const Errors& errors) {
  const std::vector<Look> some = thinned(looks);
  Wall best;
  double most = -1;
  for (const double distance : modes(looks, errors.within)) {
    for (double facing = -180 * kRadPerDeg; facing < 180 * kRadPerDeg; facing += kHeadingStep) {
      Wall w{facing, std::max(beam.half_cone_deg * kRadPerDeg, kNarrowest), distance, 0};
      const double g = gain(w, some, errors, beam.min_range_m);
      if (g <= most) continue;
      most = g;
      best = w;
    }
  }
  return best;
}

// The gain jumps where a reading crosses the edge, so one climb may end beside the summit.
double refine(Wall& wall, const std::vector<Look>& looks, const Errors& errors, double min_range,
              bool final) {
  double best = climb(wall, looks, errors, min_range, 4 * kRadPerDeg);
  if (!final) return best;
  const Wall start = wall;
  for (const double aside : {-2.0, -1.0, -0.5, 0.5, 1.0, 2.0}) {
    Wall w = start;
    w.facing += aside * kRadPerDeg;
    const double g = climb(w, looks, errors, min_range, 0.3 * kRadPerDeg);
    if (g <= best) continue;
    best = g;
    wall = w;
  }
  wall.facing = wrapped(wall.facing);
  gain(wall, looks, errors, min_range);
  settle_edge(wall, looks, errors, min_range);
  return best;
}

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

Uncertainty uncertainty(const Wall& wall, const std::vector<Look>& looks, const Errors& errors,
                        double min_range) {
  const double noise = 1 / (errors.sigma * errors.sigma);
  Matrix information{};
  information[0][0] = information[1][1] = 1 / (kWeak * kWeak);
  information[2][2] = 1;
  // Of each side: the readings beyond the last tenth before the edge, and whether the edge is within the
  // range.
  int readings[2] = {0, 0};
  bool bound[2] = {true, true};
  constexpr double kRim = 0.17;  // rad
  for (const Look& look : looks) {
    const double u = wrapped(look.heading - wall.facing);
    const Prediction p = predict(wall, look, errors, min_range);
    const int side = u < 0 ? 0 : 1;
    const bool sure = p.visible && !p.uncertain;
    if (std::fabs(p.off_axis - wall.edge) < kRim && !look.lost) ++readings[side];
    if (p.off_axis > wall.edge && p.off_axis < wall.edge + kRim && sure) bound[side] = false;
    if (!sure || p.off_axis > wall.edge || look.metres <= 0) continue;
    if (std::fabs(look.metres - p.metres) > 4 * errors.sigma) continue;
    const double incidence = std::max(p.off_axis - wall.half_cone, 0.0);
    const double slope = p.metres * std::tan(incidence);
    const Vector d{u < 0 ? slope : -slope, -slope, 1 / std::cos(incidence)};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) information[i][j] += d[i] * d[j] * noise;
    }
  }
  // Each side's edge lies between two readings, or a few farther out if dropouts hide the last ones.
  const auto spacing = [&](int side) {
    return 2 * kRim / std::max(readings[side], 1) / (1 - errors.dropout);
  };
  const double left = spacing(0), right = spacing(1);
  Uncertainty u;
  u.edge_is_bound = bound[0] && bound[1];
  const double edges = 0.5 * std::sqrt(left * left + right * right);
  if (!bound[0] && !bound[1]) information[0][0] += 1 / (edges * edges);
  const Matrix covariance = inverse(information);
  u.facing = std::sqrt(covariance[0][0] + kBinError * kBinError);
  u.half_cone = std::sqrt(covariance[1][1] + kModelError * kModelError);
  u.distance = std::sqrt(covariance[2][2]);
  u.edge = std::sqrt(edges * edges + kBinError * kBinError);
  return u;
}

}  // namespace whisker::calibration
