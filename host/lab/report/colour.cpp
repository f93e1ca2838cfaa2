#include "host/lab/report/colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whisker::report {
namespace {

/// Relative luminance (WCAG 2.1). At 0.20 #1a1a1a and white have the same contrast ratio, but on blue the eye
/// still prefers white; here white has 3.5.
constexpr double kDarkInkAbove = 0.25;

double linear(double level) {
  const double c = level / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

const ColourScale::Rgb ColourScale::kDiverging[5] = {
    {33, 90, 160}, {126, 172, 214}, {247, 247, 244}, {250, 189, 110}, {224, 122, 10}};
const ColourScale::Rgb ColourScale::kSequential[5] = {
    {255, 252, 214}, {190, 226, 182}, {90, 183, 192}, {38, 120, 178}, {26, 46, 110}};

ColourScale ColourScale::diverging(double min, double max) { return {min, max, kDiverging}; }
ColourScale ColourScale::sequential(double min, double max) { return {min, max, kSequential}; }

ColourScale::Rgb ColourScale::mixed(double value) const {
  const double share = (value - min_) / (max_ - min_);
  const double place = 4 * (std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0);
  const int low = std::min(static_cast<int>(place), 3);
  const double k = place - low;
  const Rgb& a = stops_[low];
  const Rgb& b = stops_[low + 1];
  return {a.red + (b.red - a.red) * k, a.green + (b.green - a.green) * k, a.blue + (b.blue - a.blue) * k};
}

std::string ColourScale::at(double value) const {
  const Rgb c = mixed(value);
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(c.red), std::lround(c.green), std::lround(c.blue));
}

const char* ColourScale::ink(double value) const {
  const Rgb c = mixed(value);
  const double luminance = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
  return luminance > kDarkInkAbove ? "#1a1a1a" : "#fff";
}

void draw_colour_bar(Svg& svg, Point corner, double width, double height, const ColourScale& scale,
                     int ticks) {
  constexpr int kBands = 40;
  const double span = scale.max() - scale.min();
  svg.open(R"(class="colour-bar" shape-rendering="crispEdges")");
  for (int i = 0; i < kBands; ++i) {
    const double value = scale.min() + span * (i + 0.5) / kBands;
    // Rounded to whole pixels, so that no seam shows between two bands.
    const double top = std::round(corner.y + height * (kBands - 1 - i) / kBands);
    const double bottom = std::round(corner.y + height * (kBands - i) / kBands);
    svg.rect({corner.x, top}, width, bottom - top, fmt::format(R"(fill="{}")", scale.at(value)));
  }
  svg.close();
  svg.rect(corner, width, height, R"(fill="none" stroke="#8c8c88")");
  for (int i = 0; i < ticks; ++i) {
    const double share = static_cast<double>(i) / (ticks - 1);
    const double y = corner.y + height * (1 - share);
    svg.line({corner.x + width, y}, {corner.x + width + 4, y}, R"(stroke="#8c8c88")");
    svg.text({corner.x + width + 7, y + 4}, decimals(scale.min() + span * share, 2),
             R"(font-size="11" fill="#444")");
  }
}

}  // namespace whisker::report
