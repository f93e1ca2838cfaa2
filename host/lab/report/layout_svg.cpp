#include "host/lab/report/layout_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/lab/report/axes.hpp"
#include "host/lab/report/palette.hpp"

namespace whisker::report {
namespace {

/// Distinct in hue for colour-blind eyes; dashes and the size of the points differ for grey print and where
/// lines coincide.
struct LineStyle {
  const char* colour;
  const char* dashes;
  double point;  ///< px, radius
};
constexpr LineStyle kStyles[] = {
    {"#225aa0", "none", 5.2}, {"#c2690a", "8 4", 4.0}, {"#00795c", "2 4", 2.8}, {"#a0337a", "10 3 2 3", 1.8}};

constexpr double kChartWidth = 720, kChartHeight = 626;
constexpr double kBesideEnds = 2.5;  // deg of the axis beyond the first and the last angle
constexpr const char* kRule = "A + cone/2 + L = 90";

using Value = std::optional<double> (*)(const LayoutPoint&);
std::optional<double> percent(const LayoutPoint& p) { return 100 * p.success; }
std::optional<double> pace(const LayoutPoint& p) { return p.s_per_m; }

Range angles(const LayoutChart& chart) {
  Range range{1e9, -1e9};
  for (const LayoutLine& line : chart.lines) {
    for (const LayoutPoint& p : line.points) {
      range.min = std::min(range.min, p.angle_deg);
      range.max = std::max(range.max, p.angle_deg);
    }
  }
  range.max = std::max(range.max, chart.rule_angle_deg);
  return {range.min - kBesideEnds, range.max + kBesideEnds};
}

double slowest(const LayoutChart& chart) {
  double most = 1;
  for (const LayoutLine& line : chart.lines) {
    for (const LayoutPoint& p : line.points) most = std::max(most, p.s_per_m.value_or(0));
  }
  return most;
}

bool rule_is_shown(const LayoutChart& chart, const Plot& plot) { return chart.rule_angle_deg > plot.x.min; }

void draw_rule(Svg& svg, const Plot& plot, const LayoutChart& chart) {
  svg.rect(plot.corner, plot.width, plot.height, R"(fill="#fff")");
  if (!rule_is_shown(chart, plot)) return;
  const double at = plot.page(chart.rule_angle_deg, 0).x;
  const double edge = plot.page(std::min(chart.rule_angle_deg + chart.margin_deg, plot.x.max), 0).x;
  svg.rect(plot.corner, at - plot.corner.x, plot.height, R"(class="invisible" fill="#f6dcdc")");
  svg.rect({at, plot.corner.y}, edge - at, plot.height, R"(class="margin" fill="#fbf1d2")");
  svg.line({at, plot.corner.y}, {at, plot.corner.y + plot.height},
           R"(class="rule" stroke="#b3261e" stroke-width="2")");
}

void draw_line(Svg& svg, const Plot& plot, const LayoutLine& line, const LineStyle& stroke, Value value) {
  PathData data;
  bool connected = false;
  for (const LayoutPoint& p : line.points) {
    const auto y = value(p);
    if (y && connected) data.line(plot.page(p.angle_deg, *y));
    if (y && !connected) data.move(plot.page(p.angle_deg, *y));
    connected = y.has_value();
  }
  svg.path(data,
           fmt::format(R"(class="layout" fill="none" stroke="{}" stroke-width="2" stroke-dasharray="{}")",
                       stroke.colour, stroke.dashes));
  for (const LayoutPoint& p : line.points) {
    const auto y = value(p);
    if (!y) continue;
    const Point at = plot.page(p.angle_deg, *y);
    svg.circle(at, stroke.point, fmt::format(R"(fill="{}")", stroke.colour));
    if (p.contact) {
      svg.circle(at, 8,
                 fmt::format(R"(class="contact" fill="none" stroke="{}" stroke-width="2")", kContactColour));
    }
    if (p.best) svg.circle(at, 11, R"(class="best" fill="none" stroke="#111" stroke-width="2")");
  }
}

void draw_plot(Svg& svg, const Plot& plot, const LayoutChart& chart, Value value) {
  draw_rule(svg, plot, chart);
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    draw_line(svg, plot, chart.lines[i], kStyles[i % 4], value);
  }
}

void draw_legend(Svg& svg, const LayoutChart& chart, bool rule_shown) {
  svg.open(R"(class="legend" font-size="12")");
  double x = 64;
  for (std::size_t i = 0; i < chart.lines.size(); ++i, x += 150) {
    const LineStyle& s = kStyles[i % 4];
    svg.line({x, 76}, {x + 34, 76},
             fmt::format(R"(stroke="{}" stroke-width="2" stroke-dasharray="{}")", s.colour, s.dashes));
    svg.circle({x + 17, 76}, s.point, fmt::format(R"(fill="{}")", s.colour));
    svg.text({x + 40, 80}, chart.lines[i].name, "");
  }
  svg.circle({75, 100}, 8, fmt::format(R"(fill="none" stroke="{}" stroke-width="2")", kContactColour));
  svg.text({90, 104}, "a mission ended in contact", "");
  svg.circle({275, 100}, 11, R"(fill="none" stroke="#111" stroke-width="2")");
  svg.text({292, 104}, "best layout", "");
  if (rule_shown) {
    svg.line({384, 92}, {384, 108}, R"(stroke="#b3261e" stroke-width="2")");
    svg.text({392, 104}, fmt::format("{} at {} degrees", kRule, number(chart.rule_angle_deg)), "");
    svg.rect({64, 116}, 22, 12, R"(fill="#f6dcdc" stroke="#c8c8c4")");
    svg.text({92, 126}, "left of the line: some walls ahead give no echo", "");
    svg.rect({384, 116}, 22, 12, R"(fill="#fbf1d2" stroke="#c8c8c4")");
    svg.text({412, 126}, fmt::format("less than {} degrees to spare", number(chart.margin_deg)), "");
  } else {
    svg.text({64, 126},
             fmt::format("{} at {} degrees, left of the chart: every layout here sees all walls ahead", kRule,
                         number(chart.rule_angle_deg)),
             R"(class="rule-note")");
  }
  svg.close();
}

}  // namespace

std::string layout_svg(const LayoutChart& chart) {
  const Range x = angles(chart);
  const Plot success{{64, 146}, kChartWidth - 94, 170, x, {-6, 106}};
  const Plot time{{64, 376}, kChartWidth - 94, 200, x, {0, 1.12 * slowest(chart)}};
  Svg svg(kChartWidth, kChartHeight, chart.title);
  svg.text({20, 30}, chart.title, R"(font-size="15" font-weight="bold")");
  svg.text({20, 50}, chart.subtitle, R"(fill="#444")");
  draw_legend(svg, chart, rule_is_shown(chart, success));
  draw_plot(svg, success, chart, percent);
  draw_plot_axes(svg, success, "side angle A / degrees", "goals reached / %", 9, 5);
  draw_plot(svg, time, chart, pace);
  draw_plot_axes(svg, time, "side angle A / degrees", "median time / (s/m)", 9, 6);
  return std::move(svg).finish();
}

}  // namespace whisker::report
