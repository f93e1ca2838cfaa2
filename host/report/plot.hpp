/// A plot whose two axes have their own scales, for the pictures of the fuzzy controller.
#pragma once

#include <string>
#include <vector>

#include "host/report/svg.hpp"

namespace whisker::report {

struct Range {
  double min = 0;
  double max = 1;
};

struct Plot {
  Point corner;  ///< top left, px
  double width = 0;
  double height = 0;
  Range x, y;  ///< x with min above max increases to the left

  Point page(double px, double py) const {
    return {corner.x + (px - x.min) / (x.max - x.min) * width,
            corner.y + (y.max - py) / (y.max - y.min) * height};
  }
};

/// About `count` round numbers within the range.
std::vector<double> ticks(Range range, int count);

/// Frame, numbers and axis names. Needs 48 px on the left and 38 px below.
void draw_plot_axes(Svg& svg, const Plot& plot, const std::string& x_name, const std::string& y_name,
                    int x_ticks, int y_ticks);

}  // namespace whisker::report
