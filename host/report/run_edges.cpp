#include "host/report/run_edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/report/palette.hpp"

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

/// Numbers beside marks, each at the first of eight places that keeps it off the others and off all marks;
/// left out where there is none.
class Numbers {
 public:
  explicit Numbers(std::vector<Point> marks) : taken_(std::move(marks)) {}

  void draw(Svg& svg, Point mark, const std::string& text) {
    constexpr Point kPlaces[] = {{10, -8}, {-10, -8}, {10, 14}, {-10, 14},
                                 {14, 4},  {-14, 4},  {0, -11}, {0, 19}};
    for (const Point p : kPlaces) {
      const Point at{mark.x + p.x, mark.y + p.y};
      if (!free(at)) continue;
      taken_.push_back({at.x, at.y - 4});
      svg.text(at, text, "");
      return;
    }
  }

 private:
  bool free(Point text) const {
    return std::none_of(taken_.begin(), taken_.end(),
                        [&](Point p) { return std::hypot(p.x - text.x, p.y - (text.y - 4)) < kLabelApart; });
  }
  std::vector<Point> taken_;
};

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
  std::vector<Point> marks;
  svg.open(R"(class="encounters")");
  for (const Encounter& e : all) {
    marks.push_back(place(view, *e.hit));
    draw_hit(svg, marks.back());
    if (e.turned != nullptr) draw_turned(svg, place(view, *e.turned));
    if (e.end != Encounter::End::left && e.end != Encounter::End::wall_lost) continue;
    marks.push_back(place(view, *e.left));
    e.end == Encounter::End::left ? draw_left(svg, marks.back()) : draw_wall_lost(svg, marks.back());
  }
  svg.close();
  Numbers numbers(marks);
  svg.open(
      R"(class="encounter-numbers" text-anchor="middle" font-size="11" font-weight="bold" stroke="#fff" stroke-width="3" stroke-linejoin="round" paint-order="stroke")");
  std::size_t mark = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool leaves = all[i].end == Encounter::End::left || all[i].end == Encounter::End::wall_lost;
    for (int k = leaves ? 2 : 1; k > 0; --k) numbers.draw(svg, marks[mark++], fmt::format("{}", i + 1));
  }
  svg.close();
}

}  // namespace whisker::report
