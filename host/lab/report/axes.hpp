/// Axes with equal scales in metres: a grid of round numbers and a scale bar.
#pragma once

#include <string>
#include <vector>

#include "host/harness/sim/geometry.hpp"
#include "host/lab/report/svg.hpp"

namespace whisker::report {

/// Bounding box of added points; points that are not finite or beyond 100 km are ignored.
class Box {
 public:
  void add(sim::Vec2 p, double radius = 0);
  bool empty() const { return empty_; }
  sim::Vec2 min() const { return min_; }
  sim::Vec2 max() const { return max_; }

 private:
  bool empty_ = true;
  sim::Vec2 min_, max_;
};

/// False for a position that cannot be drawn.
bool drawable(sim::Vec2 p);

/// The largest of 1, 2, 5 x 10^k that is at most `x`. x > 0.
double round_step(double x);

/// Number of decimals that a multiple of this step needs, at most 6.
int step_decimals(double step);

/// All multiples of the step within [from, to].
std::vector<double> multiples(double step, double from, double to);

/// The rectangle of the page that shows a rectangle of the world.
struct View {
  sim::Vec2 min, max;           ///< m
  Point corner;                 ///< top left on the page
  double pixels_per_metre = 1;  ///< of both axes

  double width() const { return (max.x - min.x) * pixels_per_metre; }
  double height() const { return (max.y - min.y) * pixels_per_metre; }
  double right() const { return corner.x + width(); }
  double bottom() const { return corner.y + height(); }
  Point page(sim::Vec2 p) const;
};

/// The box with a margin, at least one metre wide, no side shorter than a quarter of the other, as large as
/// fits into max_width x max_height pixels.
View fit(const Box& box, Point corner, double max_width, double max_height);

/// Grid lines, for use inside the clipped plot.
void draw_grid(Svg& svg, const View& view);

/// Frame, numbers, "x / m" and "y / m", and a scale bar under the right end. Needs 50 px on the left, 44 px
/// below.
void draw_axes(Svg& svg, const View& view);

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
