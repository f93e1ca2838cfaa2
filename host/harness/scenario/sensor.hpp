/// What the rangefinders really do, which the robot does not know. docs/scenario.md describes the physics.
#pragma once

#include <optional>
#include <string_view>

namespace whisker {

/// The reading of a target that is too dark to give an echo.
enum class Lost { clear, invalid };

/// The reading of a target nearer than the minimum range. `farther`: the output folds back, and a target at d
/// reads as one at minimum^2 / d, as of infrared triangulation.
enum class Near { too_near, farther };

/// The reading of a target beyond the robot's range_max_m that is within the sensor's own range.
enum class Far { clear, distance };

/// The defaults are what the robot believes.
struct Sensor {
  std::string_view model;  ///< name of a row of sensor_models.hpp; empty: none

  // Of the sensor; a model sets them all.
  double incidence_deg = 90;       ///< a flat surface seen farther from its normal gives no echo
  std::optional<double> cone_deg;  ///< the true full width
  std::optional<double>
      cone_far_deg;               ///< the same at the maximum range; a wider one than cone_deg counts as it
  double corner_scatter_m = 0.5;  ///< up to this distance, ends of walls and corners echo at any angle
  std::optional<double> min_range_m;  ///< nearer is near_is
  std::optional<double> max_range_m;  ///< farther is clear, of a target of reference reflectance in the dark
  double sigma_m = 0;                 ///< standard deviation of a distance
  double sigma_share = 0;             ///< the same, as a share of the distance
  double soft_range_m = 0.5;          ///< farther, a target that absorbs gives no echo
  double reflectance_reference = 1;   ///< from which max_range_m holds; 0: reflectance does not matter
  double ambient_knee_klux = 0.15;    ///< that doubles the noise power of the dark; 0: light does not matter
  Lost lost_is = Lost::clear;
  Near near_is = Near::too_near;

  // Of the mounting, of one unit, and of the surroundings; no model sets them.
  double skew_deg = 0;   ///< by which the side beams point farther outward
  double scale = 1;      ///< of every distance
  double phantom = 0;    ///< probability that a clear reading becomes an echo at 0.1 to 0.5 m
  double crosstalk = 0;  ///< probability that a reading is a neighbouring beam's where that is nearer
  double cover_glass_probability = 0;  ///< that a clear reading becomes an echo at cover_glass_m
  double cover_glass_m = 0.05;
  double soft = 0;          ///< share of the obstacles that absorb
  double reflectance = 1;   ///< of all targets
  double ambient_klux = 0;  ///< light on sensor and targets
  Far far_is = Far::clear;
};

/// The share of max_range_m up to which a target gives an echo, given its reflectance and the ambient light:
///   min(1, sqrt(reflectance / reflectance_reference)) / (1 + ambient_klux / ambient_knee_klux)^(1/4)
/// The light of a diffuse target that fills the spot falls with the square of the distance, and the least
/// signal that stands out of the shot noise rises with the root of the noise power.
double echo_share(const Sensor& sensor);

}  // namespace whisker
