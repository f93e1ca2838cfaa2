#include "host/calibration/wall_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "host/scenario/bearing.hpp"

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

}  // namespace whisker::calibration
