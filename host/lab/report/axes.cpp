#include "host/lab/report/axes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace whisker::report {
namespace {

constexpr double kLeastGridPixels = 42;
constexpr double kFarthest = 1e5;

double grid_step(const View& view) {
  const double least = kLeastGridPixels / view.pixels_per_metre;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double lead : {1.0, 2.0, 5.0})
    if (decade * lead >= least) return decade * lead;
  return decade * 10;
}

void widen(double& low, double& high, double span) {
  const double missing = span - (high - low);
  if (missing <= 0) return;
  low -= missing / 2;
  high += missing / 2;
}

void draw_scale_bar(Svg& svg, const View& view) {
  const double metres = round_step(view.width() / 4 / view.pixels_per_metre);
  const double length = metres * view.pixels_per_metre;
  const double y = view.bottom() + 32;
  const Point right{view.right(), y};
  const Point left{view.right() - length, y};
  PathData bar;
  bar.move({left.x, y - 4})
      .line({left.x, y + 4})
      .move(left)
      .line(right)
      .move({right.x, y - 4})
      .line({right.x, y + 4});
  svg.open(R"(class="scale-bar")").path(bar, R"(fill="none" stroke="#222" stroke-width="1.5")");
  svg.text({left.x - 6, y + 4}, fmt::format("{} m", decimals(metres, step_decimals(metres))),
           R"(text-anchor="end")");
  svg.close();
}

}  // namespace

bool drawable(sim::Vec2 p) { return std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest; }

void Box::add(sim::Vec2 p, double radius) {
  const sim::Vec2 r{radius, radius};
  const sim::Vec2 low = p - r;
  const sim::Vec2 high = p + r;
  if (!drawable(low) || !drawable(high)) return;
  min_ = empty_ ? low : sim::Vec2{std::min(min_.x, low.x), std::min(min_.y, low.y)};
  max_ = empty_ ? high : sim::Vec2{std::max(max_.x, high.x), std::max(max_.y, high.y)};
  empty_ = false;
}

double round_step(double x) {
  const double decade = std::pow(10.0, std::floor(std::log10(x)));
  // Small slack: 10^floor(log10(x)) may come out slightly above x.
  const double lead = x / decade + 1e-9;
  return decade * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

int step_decimals(double step) {
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
}

std::vector<double> multiples(double step, double from, double to) {
  std::vector<double> all;
  const double slack = 1e-9;
  for (double k = std::ceil(from / step - slack); k <= to / step + slack; ++k) all.push_back(k * step);
  return all;
}

Point View::page(sim::Vec2 p) const {
  return {corner.x + (p.x - min.x) * pixels_per_metre, corner.y + (max.y - p.y) * pixels_per_metre};
}

View fit(const Box& box, Point corner, double max_width, double max_height) {
  View view;
  view.corner = corner;
  view.min = box.min();
  view.max = box.max();
  const double air = 0.03 * std::max(view.max.x - view.min.x, view.max.y - view.min.y);
  view.min = view.min - sim::Vec2{air, air};
  view.max = view.max + sim::Vec2{air, air};
  widen(view.min.x, view.max.x, std::max(1.0, (view.max.y - view.min.y) / 4));
  widen(view.min.y, view.max.y, std::max(0.25, (view.max.x - view.min.x) / 4));
  view.pixels_per_metre =
      std::min(max_width / (view.max.x - view.min.x), max_height / (view.max.y - view.min.y));
  return view;
}

void draw_grid(Svg& svg, const View& view) {
  const double step = grid_step(view);
  PathData lines;
  for (const double x : multiples(step, view.min.x, view.max.x))
    lines.move(view.page({x, view.min.y})).line(view.page({x, view.max.y}));
  for (const double y : multiples(step, view.min.y, view.max.y))
    lines.move(view.page({view.min.x, y})).line(view.page({view.max.x, y}));
  svg.path(lines, R"(class="grid" fill="none" stroke="#e4e4e0" stroke-width="1")");
}

void draw_axes(Svg& svg, const View& view) {
  const double step = grid_step(view);
  const int places = step_decimals(step);
  svg.rect(view.corner, view.width(), view.height(), R"(class="frame" fill="none" stroke="#8c8c88")");
  svg.open(R"(class="x-axis" text-anchor="middle" font-size="11" fill="#444")");
  for (const double x : multiples(step, view.min.x, view.max.x))
    svg.text({view.page({x, 0}).x, view.bottom() + 15}, decimals(x, places), "");
  svg.close();
  svg.open(R"(class="y-axis" text-anchor="end" font-size="11" fill="#444")");
  for (const double y : multiples(step, view.min.y, view.max.y))
    svg.text({view.corner.x - 6, view.page({0, y}).y + 4}, decimals(y, places), "");
  svg.close();
  svg.text({view.corner.x + view.width() / 2, view.bottom() + 35}, "x / m", R"(text-anchor="middle")");
  svg.text_upwards({view.corner.x - 38, view.corner.y + view.height() / 2}, "y / m");
  draw_scale_bar(svg, view);
}

std::vector<double> ticks(Range range, int count) {
  const auto [low, high] = std::minmax(range.min, range.max);
  return multiples(round_step((high - low) / count * 1.001), low, high);
}

void draw_plot_axes(Svg& svg, const Plot& plot, const std::string& x_name, const std::string& y_name,
                    int x_ticks, int y_ticks) {
  const double bottom = plot.corner.y + plot.height;
  svg.rect(plot.corner, plot.width, plot.height, R"(class="frame" fill="none" stroke="#8c8c88")");
  svg.open(R"(class="x-axis" text-anchor="middle" font-size="11" fill="#444")");
  const std::vector<double> xs = ticks(plot.x, x_ticks);
  const int x_places = xs.size() < 2 ? 1 : step_decimals(xs[1] - xs[0]);
  for (const double x : xs) {
    const double px = plot.page(x, plot.y.min).x;
    svg.line({px, bottom}, {px, bottom + 4}, R"(stroke="#8c8c88")");
    svg.text({px, bottom + 16}, decimals(x, x_places), "");
  }
  svg.close().open(R"(class="y-axis" text-anchor="end" font-size="11" fill="#444")");
  const std::vector<double> ys = ticks(plot.y, y_ticks);
  const int y_places = ys.size() < 2 ? 1 : step_decimals(ys[1] - ys[0]);
  for (const double y : ys) {
    const double py = plot.page(plot.x.min, y).y;
    svg.line({plot.corner.x - 4, py}, {plot.corner.x, py}, R"(stroke="#8c8c88")");
    svg.text({plot.corner.x - 7, py + 4}, decimals(y, y_places), "");
  }
  svg.close();
  svg.text({plot.corner.x + plot.width / 2, bottom + 33}, x_name, R"(text-anchor="middle")");
  svg.text_upwards({plot.corner.x - 34, plot.corner.y + plot.height / 2}, y_name);
}

}  // namespace whisker::report
