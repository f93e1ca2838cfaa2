/// A run as one picture: the world, the path by class, static scans, the end.
#pragma once

#include <string>
#include <vector>

#include "host/harness/run/run_log.hpp"

namespace whisker::report {

struct RunPicture {
  std::string subtitle;  ///< a third line under the verdict, e.g. the planner; may be empty
  bool looks = true;     ///< a dot for each decision from a static scan
  int cones = 4;  ///< number of places, the first entries into the danger area, where the beams are drawn
  bool legend = true;
  /// Path of another run in the same world that must fit into the frame.
  const std::vector<TickRecord>* beside = nullptr;
  double path_tolerance = 5e-4;  ///< m; path points nearer than this to the drawn line are omitted
};

/// The SVG file, with the last map of a planner that has one. Axes have equal scales in metres; the card is
/// 620 to 980 px wide. The log may be without ticks;
/// those without a finite position are omitted, and the legend shows their number. Equal input gives equal
/// bytes.
std::string run_svg(const RunLog& log, const RunPicture& options = {});

}  // namespace whisker::report
