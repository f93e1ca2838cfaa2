/// Finds the wall that explains the looks best.
#pragma once

#include <vector>

#include "host/calibration/wall_model.hpp"

namespace whisker::calibration {

/// Over all headings, at the most frequent distances, with the believed cone.
Wall coarse_search(const std::vector<Look>& looks, const Believed& beam, const Errors& errors);

/// Improves facing, half cone and distance; sets the edge. Returns its gain. final: as well as possible.
double refine(Wall& wall, const std::vector<Look>& looks, const Errors& errors, double min_range, bool final);

/// rad; the edge, or less if it is soft: up to here, hardly more echoes are missing than near the axis.
double sure_edge(const Wall& wall, const std::vector<Look>& looks, const Errors& errors, double min_range);

/// Estimates of the standard deviations; angles in rad.
struct Uncertainty {
  double facing = 0;
  double half_cone = 0;
  double edge = 0;
  double distance = 0;         ///< m
  bool edge_is_bound = false;  ///< on both sides, the wall leaves the range before the edge
};
Uncertainty uncertainty(const Wall& wall, const std::vector<Look>& looks, const Errors& errors,
                        double min_range);

}  // namespace whisker::calibration
