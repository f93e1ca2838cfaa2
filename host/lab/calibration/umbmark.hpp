/// Unequal wheels and a wrong track from squares to both sides: the test of Borenstein and Feng, "Measurement
/// and correction of systematic odometry errors in mobile robots", 1996.
#pragma once

#include <vector>

namespace whisker::calibration {

/// The end of one square, in the frame of its start: x ahead, y to the left, m.
struct SquareEnd {
  bool left = true;  ///< the turns were to the left
  double x_m = 0;    ///< as measured
  double y_m = 0;
  double believed_x_m = 0;  ///< by the robot's odometry
  double believed_y_m = 0;
};

struct Umbmark {
  double wheel_ratio = 1;  ///< true / believed
  double ratio_sigma = 0;  ///< relative
  double track = 1;        ///< true / believed
  double track_sigma = 0;
  double residual_m = 0;  ///< root of the mean square of what the fit leaves of a coordinate
};

/// side_m and track_m as the robot believes; scale_sigma: how well it knows lengths, see --tape. Fits the
/// arcs that unequal wheels drive, not their small-angle approximation, so that wheels of some per cent need
/// no second pass. Throws std::runtime_error if there are not two squares to each side, or no ratio and track
/// explain the ends.
Umbmark umbmark(const std::vector<SquareEnd>& ends, double side_m, double track_m,
                double scale_sigma = 0.001);

}  // namespace whisker::calibration
