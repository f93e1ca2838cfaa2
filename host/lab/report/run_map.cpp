#include "host/lab/report/run_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "host/lab/report/palette.hpp"

namespace whisker::report {
namespace {

using planning::CellState;
using sim::Vec2;

constexpr double kRing = 8;     // px
constexpr double kApart = 2.5;  // px

/// Converts a point from the robot's believed frame into the true one.
Vec2 truly(const TickRecord& r, Vec2 believed) {
  const double turn = r.heading_rad - r.est_heading_rad;
  const Vec2 d = believed - Vec2{r.est_x_m, r.est_y_m};
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  return Vec2{r.x_m, r.y_m} + Vec2{c * d.x - s * d.y, s * d.x + c * d.y};
}

/// Merges the cells of one state into few boxes: runs of a row, extended over rows with the same run.
PathData boxes(const MapPicture& map, CellState state) {
  std::vector<bool> taken(map.cells.size());
  const auto index = [&](std::int32_t x, std::int32_t y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(map.columns) + static_cast<std::size_t>(x);
  };
  const auto open = [&](std::int32_t x, std::int32_t y) {
    return map.at(x, y) == state && !taken[index(x, y)];
  };
  const auto open_row = [&](std::int32_t x, std::int32_t end, std::int32_t y) {
    for (; x < end; ++x)
      if (!open(x, y)) return false;
    return true;
  };
  PathData data;
  for (std::int32_t y = 0; y < map.rows; ++y) {
    for (std::int32_t x = 0; x < map.columns; ++x) {
      if (!open(x, y)) continue;
      std::int32_t right = x + 1;
      while (right < map.columns && open(right, y)) ++right;
      std::int32_t top = y + 1;
      while (top < map.rows && open_row(x, right, top)) ++top;
      for (std::int32_t j = y; j < top; ++j)
        for (std::int32_t i = x; i < right; ++i) taken[index(i, j)] = true;
      data.box({static_cast<double>(x), static_cast<double>(y)}, right - x, top - y);
    }
  }
  return data;
}

Point place(const View& view, const TickRecord& r) { return view.page({r.x_m, r.y_m}); }

}  // namespace

void draw_map(Svg& svg, const View& view, const MapPicture& map, const TickRecord& believer) {
  const auto page = [&](double x, double y) {
    return view.page(truly(believer, Vec2{map.corner.x + x, map.corner.y + y} * map.cell_m));
  };
  const Point zero = page(0, 0);
  const Point right = page(1, 0);
  const Point up = page(0, 1);
  // In units of cells the numbers are short.
  svg.open(fmt::format(R"-(class="map" transform="matrix({:.5g} {:.5g} {:.5g} {:.5g} {:.6g} {:.6g})")-",
                       right.x - zero.x, right.y - zero.y, up.x - zero.x, up.y - zero.y, zero.x, zero.y));
  for (const MapLook& look : kMapLooks) {
    svg.path(boxes(map, look.state), fmt::format(R"(class="{}" {})", look.name, look.fill));
  }
  PathData window;
  window.box({}, map.columns, map.rows);
  const double cell = std::hypot(right.x - zero.x, right.y - zero.y);
  svg.path(window, fmt::format(R"(class="window" fill="none" stroke="{}" stroke-width="{:.3g}")", kMapColour,
                               0.8 / cell));
  PathData way;
  for (const planning::Cell p : map.way) way.dot({p.x + 0.5, p.y + 0.5});
  svg.path(way, fmt::format(R"(class="plan" {} stroke-width="{:.3g}")", kMapDots, 2.4 / cell));
  svg.close();
}

void draw_way_points(Svg& svg, const View& view, const std::vector<TickRecord>& records) {
  std::set<std::pair<long, long>> taken;
  PathData dots;
  for (const TickRecord& r : records) {
    if (r.guide != Guidance::place || !drawable({r.x_m, r.y_m})) continue;
    const Point p = view.page(truly(r, {r.way_x_m, r.way_y_m}));
    if (taken.emplace(std::lround(p.x / kApart), std::lround(p.y / kApart)).second) dots.dot(p);
  }
  svg.path(dots, fmt::format(R"(class="way-points" {} stroke-width="4")", kMapDots));
}

void draw_to_edges(Svg& svg, Point at) {
  svg.circle(at, kRing,
             fmt::format(R"(class="to-edges" fill="none" stroke="{}" stroke-width="2")", kMapColour));
}

void draw_to_map(Svg& svg, Point at) {
  svg.circle(
      at, kRing,
      fmt::format(R"(class="to-map" fill="none" stroke="{}" stroke-width="2" stroke-dasharray="3 2.5")",
                  kMapColour));
}

void draw_hand_overs(Svg& svg, const View& view, const std::vector<HandOver>& all) {
  for (const HandOver& h : all) {
    if (!drawable({h.at->x_m, h.at->y_m})) continue;
    h.to_edges ? draw_to_edges(svg, place(view, *h.at)) : draw_to_map(svg, place(view, *h.at));
  }
}

}  // namespace whisker::report
