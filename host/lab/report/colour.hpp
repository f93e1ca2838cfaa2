/// Colours for numbers. Both scales are safe for colour-blind eyes.
#pragma once

#include <string>

#include "host/lab/report/svg.hpp"

namespace whisker::report {

/// A linear blend between five colours over [min, max]; values outside get the end colours.
class ColourScale {
 public:
  /// Blue below, near white in the middle of the range, orange above. Blue is darker, so the two differ in
  /// grey print.
  static ColourScale diverging(double min, double max);
  /// Pale yellow to dark blue: darker is more.
  static ColourScale sequential(double min, double max);

  double min() const { return min_; }
  double max() const { return max_; }
  /// "#rrggbb"; a value that is not finite gets the colour of min.
  std::string at(double value) const;
  /// Black or white, whichever is easier to read on at(value).
  const char* ink(double value) const;

 private:
  struct Rgb {
    double red, green, blue;
  };
  ColourScale(double min, double max, const Rgb* stops) : min_(min), max_(max), stops_(stops) {}
  Rgb mixed(double value) const;
  static const Rgb kDiverging[5];
  static const Rgb kSequential[5];
  double min_, max_;
  const Rgb* stops_;
};

/// A vertical bar from min at the bottom to max at the top, with `ticks` numbers beside it. Needs 40 px on
/// its right.
void draw_colour_bar(Svg& svg, Point corner, double width, double height, const ColourScale& scale,
                     int ticks);

}  // namespace whisker::report
