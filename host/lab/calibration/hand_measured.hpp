/// Values that a person measured with a tape.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "firmware/calibration/tape.hpp"
#include "host/lab/calibration/drive_rig.hpp"
#include "host/lab/calibration/umbmark.hpp"

namespace whisker::calibration {

/// Ratio and track from the ends of squares. The track stays where a spin has measured it. Throws as
/// umbmark().
Umbmark take_squares(const std::vector<SquareEnd>& ends, double side_m, double scale_sigma,
                     const Params& params, Values& values);

/// A CSV with a header and these columns, in any order: `side` (left or right), `x_m`, `y_m`, and if known
/// `believed_x_m` and `believed_y_m`. Others are ignored. Throws InputError.
std::vector<SquareEnd> read_square_ends(std::istream& in, const std::string& name);

/// The lines for a robot file.
std::vector<std::string> robot_lines(const Values& values);
/// The lines that declare what remains: the sigmas of the parameters' pose errors.
std::vector<std::string> sigma_lines(const Values& values);

}  // namespace whisker::calibration
