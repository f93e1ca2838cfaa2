/// The chart of `whisker robot layout`: success and time over the side angle.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whisker::report {

struct LayoutPoint {
  double angle_deg = 0;
  double success = 0;             ///< share of the missions
  std::optional<double> s_per_m;  ///< none: the line has a gap here
  bool contact = false;           ///< some mission ended in contact
  bool best = false;
};

struct LayoutLine {
  std::string name;                 ///< in the legend
  std::vector<LayoutPoint> points;  ///< by angle
};

struct LayoutChart {
  std::string title;
  std::string subtitle;
  std::vector<LayoutLine> lines;  ///< at most 4
  double rule_angle_deg = 0;      ///< below it, some walls ahead are invisible
  double margin_deg = 0;          ///< above it: up to here they are seen, but only just
};

/// At least one line with at least one point. A rule's angle that lies left of the points is told in words.
std::string layout_svg(const LayoutChart& chart);

}  // namespace whisker::report
