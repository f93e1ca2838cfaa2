/// A run as one picture: the world, the path by what the robot did, where it looked, how it ended.
#pragma once

#include <string>
#include <vector>

#include "host/run/map_picture.hpp"
#include "host/run/record.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::report {

struct RunPicture {
  std::string subtitle;  ///< a third line under the verdict, e.g. the planner; may be empty
  bool looks = true;     ///< a dot where a decision was taken from a look
  int cones = 4;  ///< places at most, the first entries into the danger area, where the beams are drawn
  bool legend = true;
  /// Of another run in the same world, whose way is to fit in, too.
  const std::vector<TickRecord>* beside = nullptr;
  const MapPicture* map = nullptr;  ///< at the end, of a planner that has one
  double path_tolerance = 5e-4;     ///< m; a path point nearer than this to the drawn line is left out
};

/// The SVG file. Axes are equal, in metres; the card is 620 to 980 px wide. Records may be empty; those
/// without a finite position are left out, and the legend says how many. Equal input gives equal bytes.
std::string run_svg(const Scenario& scenario, const std::vector<TickRecord>& records, const RunResult& result,
                    const RunPicture& options = {});

}  // namespace whisker::report
