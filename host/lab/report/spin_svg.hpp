/// A picture of the spin of a calibration.
#pragma once

#include <string>
#include <vector>

namespace whisker::report {

/// A reading while the body turned: heading of the body and distance.
struct Sighting {
  double at_deg = 0;
  double m = 0;
};

struct SpinPicture {
  std::string title;
  struct Beam {
    std::string name;
    std::vector<Sighting> first, last;  ///< of the first and the last turn
  };
  std::vector<Beam> beams;
  double range_m = 2;
  double offset_deg = 0;  ///< by which the last turn is ahead
  double window_deg = 46;
  std::vector<double> mismatch_mm;  ///< evenly over -window to +window
};

/// For each beam, the first turn as a line and the last one as dots, before and after the match; below, the
/// mismatch over the offset.
std::string spin_svg(const SpinPicture& picture);

}  // namespace whisker::report
