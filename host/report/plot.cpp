#include "host/report/plot.hpp"

#include <algorithm>

#include "host/report/axes.hpp"

namespace whisker::report {

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
