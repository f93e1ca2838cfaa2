#include "host/rules/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/report/axes.hpp"
#include "host/report/colour.hpp"
#include "host/report/svg.hpp"

namespace whisker::rules {
namespace {

using report::PathData;
using report::Plot;
using report::Point;
using report::Svg;

constexpr double kWidth = 400;
constexpr double kSetHeight = 110;
constexpr double kMapHeight = 400;
constexpr double kRow = 200;     ///< of the memberships
constexpr double kMapRow = 500;  ///< of the surfaces
constexpr double kColumn = 540;
constexpr int kCells = 100;
constexpr int kLevels = 32;

/// Distinct in hue for colour-blind eyes; neighbours also differ in dashes for grey print.
constexpr const char* kColours[] = {"#225aa0", "#c2690a", "#00795c", "#a0337a", "#3a3a3a"};

struct Range {
  double low;
  double high;
};

Range span_over(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low < *high ? Range{*low, *high} : Range{*low - 1, *high + 1};
}

/// One variable: each set as a curve, each crisp term as a line at its constant.
void draw_sets(Svg& svg, Point corner, const std::string& name, Range range, const std::vector<Term>& terms) {
  const Plot plot{corner, kWidth, kSetHeight, {range.low, range.high}, {0, 1}};
  svg.rect(plot.corner, plot.width, plot.height, R"(fill="#fff")");
  draw_plot_axes(svg, plot, name, "membership", 8, 2);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const std::string stroke =
        fmt::format(R"(fill="none" stroke="{}" stroke-width="1.8" stroke-dasharray="{}")", kColours[t % 5],
                    t % 2 == 0 ? "none" : "7 3");
    double peak = terms[t].constant;
    if (terms[t].crisp) {
      const double x = std::min(std::max(peak, range.low), range.high);
      svg.line(plot.page(x, 0), plot.page(x, 1), stroke);
    } else {
      PathData data;
      double most = -1;
      for (int i = 0; i <= 400; ++i) {
        const double x = range.low + (range.high - range.low) * i / 400;
        const double y = terms[t].set(x);
        if (y > most) most = y, peak = x;
        i == 0 ? data.move(plot.page(x, y)) : data.line(plot.page(x, y));
      }
      svg.path(data, stroke);
    }
    const Point at = plot.page(std::min(std::max(peak, range.low), range.high), 1);
    svg.text({at.x, at.y - 4 - (t % 2 == 0 ? 0 : 10)}, report::shortened(terms[t].name, 12),
             fmt::format(R"(text-anchor="middle" font-size="9" fill="{}")", kColours[t % 5]));
  }
}

/// An output over one input.
void draw_line(Svg& svg, Point corner, const RuleBase& base, const Surface& s, std::size_t o) {
  const Domain::Part& part = s.domain.parts[0];
  const Range y = span_over(s.values[o]);
  const Plot plot{
      corner, kWidth, kMapHeight, {part.axis.value(part.from), part.axis.value(part.to)}, {y.low, y.high}};
  draw_plot_axes(svg, plot, base.inputs[part.axis.input].name, base.outputs[o].name, 8, 8);
  PathData data;
  for (std::int32_t i = 0; i < part.count(); ++i) {
    const Point p = plot.page(part.axis.value(part.from + i), s.values[o][static_cast<std::size_t>(i)]);
    i == 0 ? data.move(p) : data.line(p);
  }
  svg.path(data, R"(fill="none" stroke="#225aa0" stroke-width="1.8")");
}

/// An output over two inputs: the first to the right, the second upward.
void draw_map(Svg& svg, Point corner, const RuleBase& base, const Surface& s, std::size_t o) {
  const Domain::Part& a = s.domain.parts[0];
  const Domain::Part& b = s.domain.parts[1];
  const Plot plot{corner,
                  kWidth,
                  kMapHeight,
                  {a.axis.value(a.from), a.axis.value(a.to)},
                  {b.axis.value(b.from), b.axis.value(b.to)}};
  const Range range = span_over(s.values[o]);
  const report::ColourScale scale = report::ColourScale::sequential(range.low, range.high);
  std::vector<PathData> levels(kLevels);
  const double w = kWidth / kCells;
  const double h = kMapHeight / kCells;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const auto row = static_cast<std::size_t>((a.count() - 1) * (2 * i + 1) / (2 * kCells));
      const auto column = static_cast<std::size_t>((b.count() - 1) * (2 * j + 1) / (2 * kCells));
      const double value = s.values[o][row * static_cast<std::size_t>(b.count()) + column];
      const double share = (value - range.low) / (range.high - range.low);
      const auto level = static_cast<std::size_t>(std::min(std::max(share * kLevels, 0.0), kLevels - 1.0));
      levels[level].box({corner.x + i * w, corner.y + kMapHeight - (j + 1) * h}, w, h);
    }
  }
  svg.open(R"(shape-rendering="crispEdges")");
  for (std::size_t l = 0; l < kLevels; ++l) {
    const double value = range.low + (range.high - range.low) * (static_cast<double>(l) + 0.5) / kLevels;
    if (!levels[l].empty()) svg.path(levels[l], fmt::format(R"(fill="{}")", scale.at(value)));
  }
  svg.close();
  draw_plot_axes(svg, plot, base.inputs[a.axis.input].name, base.inputs[b.axis.input].name, 8, 8);
  draw_colour_bar(svg, {corner.x + kWidth + 14, corner.y}, 14, kMapHeight, scale, 5);
}

}  // namespace

std::string picture(const RuleBase& base, const Surface& surface) {
  const std::size_t rows = std::max(base.inputs.size(), base.outputs.size());
  const double top = 84;
  const double maps = top + kRow * static_cast<double>(rows);
  const double width = kColumn * static_cast<double>(std::max<std::size_t>(2, base.outputs.size())) + 40;
  const std::string title = base.name.empty() ? base.file : base.name;
  Svg svg(width, maps + kMapRow + 20, title);
  svg.text({20, 30}, report::shortened(title, 80), R"(font-size="17" font-weight="bold")");
  const auto row = [&](std::size_t i) { return top + kRow * static_cast<double>(i); };
  for (std::size_t i = 0; i < base.inputs.size(); ++i) {
    const Input& v = base.inputs[i];
    draw_sets(svg, {70, row(i)}, v.name, {v.low, v.high}, v.terms);
  }
  for (std::size_t o = 0; o < base.outputs.size(); ++o) {
    const Output& v = base.outputs[o];
    draw_sets(svg, {70 + kColumn, row(o)}, v.name, {v.low, v.high}, v.terms);
    const Point corner{70 + kColumn * static_cast<double>(o), maps + 30};
    svg.text({corner.x, corner.y - 12}, report::shortened(v.name, 60),
             R"(font-size="14" font-weight="bold")");
    surface.domain.parts.size() > 1 ? draw_map(svg, corner, base, surface, o)
                                    : draw_line(svg, corner, base, surface, o);
  }
  return std::move(svg).finish();
}

}  // namespace whisker::rules
