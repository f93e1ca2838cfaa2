#include "host/lab/report/run_edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/lab/report/palette.hpp"

namespace whisker::report {
namespace {

constexpr double kMark = 5;         // px, half of a mark's size
constexpr double kLabelApart = 11;  // px

PathData diamond(Point c) {
  PathData data;
  data.move({c.x, c.y - kMark}).line({c.x + kMark, c.y}).line({c.x, c.y + kMark}).line({c.x - kMark, c.y});
  return data.close();
}

Point place(const View& view, const TickRecord& r) { return view.page({r.x_m, r.y_m}); }

struct Mark {
  Point at;
  std::size_t number;
};

/// Numbers beside marks, each at the first of eight positions that does not overlap other numbers or marks;
/// omitted if there is none.
void draw_numbers(Svg& svg, const std::vector<Mark>& marks) {
  constexpr Point kPlaces[] = {{10, -8}, {-10, -8}, {10, 14}, {-10, 14},
                               {14, 4},  {-14, 4},  {0, -11}, {0, 19}};
  std::vector<Point> taken;
  for (const Mark& mark : marks) taken.push_back(mark.at);
  for (const Mark& mark : marks) {
    for (const Point p : kPlaces) {
      const Point at{mark.at.x + p.x, mark.at.y + p.y};
      const Point middle{at.x, at.y - 4};
      const auto near = [&](Point q) { return std::hypot(q.x - middle.x, q.y - middle.y) < kLabelApart; };
      if (std::any_of(taken.begin(), taken.end(), near)) continue;
      taken.push_back(middle);
      svg.text(at, fmt::format("{}", mark.number), "");
      break;
    }
  }
}

}  // namespace

void draw_hit(Svg& svg, Point at) {
  svg.path(diamond(at), R"(class="hit" fill="#111" stroke="#fff" stroke-width="1")");
}

void draw_left(Svg& svg, Point at) {
  svg.path(diamond(at), R"(class="left" fill="#fff" stroke="#111" stroke-width="1.4")");
}

void draw_turned(Svg& svg, Point at) {
  PathData box;
  box.box({at.x - 4, at.y - 4}, 8, 8);
  svg.path(box, R"(class="turned" fill="#fff" stroke="#111" stroke-width="1.4")");
}

void draw_wall_lost(Svg& svg, Point at) {
  svg.path(diamond(at), R"(class="wall-lost" fill="#e69f00" stroke="#111" stroke-width="1.4")");
}

void draw_encounters(Svg& svg, const View& view, const std::vector<Encounter>& all) {
  if (all.empty()) return;
  std::vector<Mark> marks;
  svg.open(R"(class="encounters")");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Encounter& e = all[i];
    marks.push_back({place(view, *e.hit), i + 1});
    draw_hit(svg, marks.back().at);
    if (e.turned != nullptr) draw_turned(svg, place(view, *e.turned));
    if (e.end != Encounter::End::left && e.end != Encounter::End::wall_lost) continue;
    marks.push_back({place(view, *e.left), i + 1});
    e.end == Encounter::End::left ? draw_left(svg, marks.back().at) : draw_wall_lost(svg, marks.back().at);
  }
  svg.close();
  svg.open(
      R"(class="encounter-numbers" text-anchor="middle" font-size="11" font-weight="bold" stroke="#fff" stroke-width="3" stroke-linejoin="round" paint-order="stroke")");
  draw_numbers(svg, marks);
  svg.close();
}

}  // namespace whisker::report
