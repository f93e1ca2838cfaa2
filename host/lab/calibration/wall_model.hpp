/// How well a flat wall explains what one beam read while it turned.
///
/// Let u be the angle from the wall's normal to the axis of the beam, c the half width of its cone, L the
/// incidence up to which the wall gives an echo, and p the distance of the apex from the wall. The nearest
/// point of the wall within the cone is p away up to |u| = c, p / cos(|u| - c) beyond, and gives no echo
/// beyond the edge |u| = c + L.
#pragma once

#include <vector>

#include "host/lab/calibration/sample.hpp"

namespace whisker::calibration {

/// rad and m.
struct Wall {
  double facing =
      0;  ///< heading of the body, from the wall's normal, at which the axis meets the wall squarely
  double half_cone = 0;
  double distance = 0;  ///< from the centre of the turn
  double edge = 0;      ///< c + L
};

/// The errors of the sensor.
struct Errors {
  double sigma = 0.02;   ///< m, standard deviation of a distance
  double dropout = 0.1;  ///< share of readings without an echo of the wall, within the edges
  double phantom = 0.1;  ///< share of echoes beyond the edges
  double within = 1000;  ///< m; farther echoes count as clear
};

/// A reading, prepared.
struct Look {
  double heading;  ///< rad from the wall's normal
  double advance;  ///< m, by which the apex is nearer to the wall than the centre
  double metres;   ///< 0: no echo
  bool lost;
};

/// wall_rad: the heading of the wall's normal, away from the robot.
std::vector<Look> looks(const Samples& samples, const Believed& beam, double wall_rad);

/// What the wall predicts for this look. visible: false beyond `within` or where no echo can come back.
struct Prediction {
  double off_axis = 0;  ///< |u|
  double metres = 0;
  bool visible = false;
  bool uncertain = false;  ///< so near the limit of the range that it may be lost
};
Prediction predict(const Wall& wall, const Look& look, const Errors& errors, double min_range);

/// The logarithm of the likelihood ratio of the wall against no wall, with the edge that makes it largest;
/// sets the edge. wall.edge is not read.
double gain(Wall& wall, const std::vector<Look>& looks, const Errors& errors, double min_range);

/// An angle in (-pi, pi].
double wrapped(double rad);

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
