#include "host/lab/report/run_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host/lab/report/palette.hpp"
#include "host/lab/report/run_edges.hpp"
#include "host/lab/report/run_map.hpp"

namespace whisker::report {
namespace {

constexpr double kRow = 20;
constexpr double kSwatch = 30;

class Column {
 public:
  Column(Svg& svg, Point corner) : svg_(svg), corner_(corner), y_(corner.y) {}

  void heading(const char* text) {
    y_ += 14;
    svg_.text({corner_.x, y_}, text, R"(font-weight="bold")");
    y_ += 4;
  }
  /// Returns the centre of the new row's swatch.
  Point row(const std::string& label) {
    y_ += kRow;
    svg_.text({corner_.x + kSwatch + 8, y_ - 4}, label, "");
    return {corner_.x + kSwatch / 2, y_ - 8};
  }
  /// Two figures at the right end of the current row, with their right edges `apart` px apart.
  void figures(const std::string& first, const std::string& second, double apart) {
    svg_.text({corner_.x + kLegendWidth - apart, y_ - 4}, first, R"(text-anchor="end")");
    svg_.text({corner_.x + kLegendWidth, y_ - 4}, second, R"(text-anchor="end")");
  }
  void note(const std::string& text) {
    y_ += 16;
    svg_.text({corner_.x, y_ - 3}, text, R"(font-size="11" fill="#555")");
  }
  void gap() { y_ += 8; }
  double y() const { return y_; }

 private:
  Svg& svg_;
  Point corner_;
  double y_;
};

void draw_classes(Svg& svg, Column& column, const TrackSummary& track) {
  column.heading("Path, and its share");
  for (std::size_t k = 0; k < kDoings; ++k) {
    const Look& look = kLooks[k];
    const double share = track.total_m > 0 ? 100 * track.metres[k] / track.total_m : 0;
    const Point c = column.row(look.label);
    column.figures(decimals(track.metres[k], 2) + " m", decimals(share, 0) + " %", 48);
    svg.line({c.x - kSwatch / 2, c.y}, {c.x + kSwatch / 2, c.y},
             fmt::format(R"(class="key {}" stroke="{}" stroke-width="{}" stroke-dasharray="{}")", look.name,
                         look.colour, number(look.width), look.dashes));
  }
  if (track.danger_entries > 0)
    column.note(fmt::format("danger area entered {} time{}, longest t = {}", track.danger_entries,
                            track.danger_entries == 1 ? "" : "s", track.longest_danger));
  if (track.without_place > 0)
    column.note(fmt::format("{} records without a position left out", track.without_place));
}

std::string distance_text(const TickRecord& r, sim::Vec2 goal) {
  if (!r.inside) return "?";
  return decimals(std::hypot(r.est_x_m - goal.x, r.est_y_m - goal.y), 2) + " m";
}

std::string end_text(const Encounter& e, sim::Vec2 goal) {
  switch (e.end) {
    case Encounter::End::none: return "-";
    case Encounter::End::unreachable: return "closed loop";
    case Encounter::End::left:
    case Encounter::End::wall_lost: return distance_text(*e.left, goal);
  }
  return "?";
}

void draw_edges(Column& column, const LegendContent& content) {
  constexpr std::size_t kRows = 8;
  constexpr double kApart = 76;
  const std::size_t all = content.encounters.size();
  if (all == 0) return;
  column.gap();
  column.heading("Distance to the goal");
  column.figures("at hit", "on leaving", kApart);
  for (std::size_t i = 0; i < std::min(all, kRows); ++i) {
    const Encounter& e = content.encounters[i];
    column.row(fmt::format("boundary {}", i + 1));
    column.figures(distance_text(*e.hit, content.goal), end_text(e, content.goal), kApart);
  }
  if (all > kRows) column.note(fmt::format("and {} more boundaries", all - kRows));
}

bool any(const std::vector<Encounter>& all, Encounter::End end) {
  return std::any_of(all.begin(), all.end(), [&](const Encounter& e) { return e.end == end; });
}

void draw_edge_marks(Svg& svg, Column& column, const std::vector<Encounter>& all) {
  if (all.empty()) return;
  draw_hit(svg, column.row("hit: the path to the goal is blocked"));
  if (any(all, Encounter::End::left)) draw_left(svg, column.row("left the boundary: on to the goal"));
  if (any(all, Encounter::End::wall_lost)) draw_wall_lost(svg, column.row("lost the wall: on to the goal"));
  if (std::any_of(all.begin(), all.end(), [](const Encounter& e) { return e.turned != nullptr; }))
    draw_turned(svg, column.row("closed loop: now the other way"));
}

void draw_map_marks(Svg& svg, Column& column, const LegendContent& content) {
  if (content.map == nullptr) return;
  for (const MapLook& look : kMapLooks) {
    const Point c = column.row(look.label);
    svg.rect({c.x - 8, c.y - 6}, 16, 12, look.fill);
  }
  Point c = column.row("map: window at the end");
  svg.rect({c.x - 8, c.y - 6}, 16, 12,
           fmt::format(R"(fill="none" stroke="{}" stroke-width="0.8")", kMapColour));
  c = column.row("way points of the map");
  PathData dots;
  dots.dot({c.x - 8, c.y}).dot(c).dot({c.x + 8, c.y});
  svg.path(dots, fmt::format(R"({} stroke-width="4")", kMapDots));
  if (!content.map->way.empty()) {
    c = column.row("last planned path");
    PathData plan;
    for (const int i : {-2, -1, 0, 1, 2}) plan.dot({c.x + 5.0 * i, c.y});
    svg.path(plan, fmt::format(R"({} stroke-width="2.4")", kMapDots));
  }
}

void draw_hand_over_marks(Svg& svg, Column& column, const std::vector<HandOver>& all) {
  const auto any = [&](bool to_edges) {
    return std::any_of(all.begin(), all.end(), [&](const HandOver& h) { return h.to_edges == to_edges; });
  };
  if (any(true)) draw_to_edges(svg, column.row("fallback to boundary following"));
  if (any(false)) draw_to_map(svg, column.row("the map resumes"));
}

void draw_marks(Svg& svg, Column& column, const LegendContent& content) {
  column.heading("Marks");
  Point c = column.row("robot at the start");
  svg.circle(c, 6, R"(fill="#fff" stroke="#222" stroke-width="1.2" stroke-dasharray="3 2")");
  if (content.end) {
    c = column.row("robot at the end");
    svg.circle(c, 6, R"(fill="#c9d8e4" stroke="#222" stroke-width="1.5")");
  }
  if (content.contact) {
    c = column.row("contact");
    PathData cross;
    cross.move({c.x - 6, c.y - 6}).line({c.x + 6, c.y + 6}).move({c.x - 6, c.y + 6}).line({c.x + 6, c.y - 6});
    svg.path(cross, fmt::format(R"(stroke="{}" stroke-width="3" stroke-linecap="round")", kContactColour));
  }
  c = column.row("goal and its tolerance");
  svg.circle(c, 6, fmt::format(R"(fill="#bfe6d6" stroke="{}" stroke-width="1.5")", kGoalColour));
  c = column.row("straight line from start to goal");
  svg.line({c.x - kSwatch / 2, c.y}, {c.x + kSwatch / 2, c.y}, kStraightWay);
  draw_edge_marks(svg, column, content.encounters);
  draw_map_marks(svg, column, content);
  draw_hand_over_marks(svg, column, content.hand_overs);
  if (content.looks) {
    c = column.row(
        fmt::format("looked here ({} look{})", content.track.looks, content.track.looks == 1 ? "" : "s"));
    PathData dots;
    dots.dot({c.x - 8, c.y}).dot(c).dot({c.x + 8, c.y});
    svg.path(dots, kLookDot);
  }
  if (content.cones) {
    c = column.row("beams on entering a danger area");
    PathData sector;
    sector.move({c.x - 13, c.y})
        .line({c.x + 12, c.y - 6})
        .line({c.x + 13, c.y})
        .line({c.x + 12, c.y + 6})
        .close();
    svg.path(sector, R"(fill="#e69f00" fill-opacity="0.2" stroke="#8a6000" stroke-width="0.7")");
  }
  if (content.obstacles) svg.circle(column.row("obstacle"), 6, kObstacle);
  if (content.walls) {
    c = column.row("wall");
    svg.line({c.x - 12, c.y}, {c.x + 12, c.y}, kWall);
  }
  if (content.movers) {
    c = column.row("moving disc (dashed: at the start)");
    svg.circle(c, 6, R"(fill="#e3d3bf" stroke="#7a5c3a")");
  }
}

}  // namespace

double draw_legend(Svg& svg, Point corner, int columns, const LegendContent& content) {
  svg.open(R"(class="legend")");
  Column classes(svg, corner);
  draw_classes(svg, classes, content.track);
  draw_edges(classes, content);
  if (columns == 1) classes.gap();
  Column marks(svg,
               columns == 1 ? Point{corner.x, classes.y()} : Point{corner.x + kLegendWidth + 40, corner.y});
  draw_marks(svg, marks, content);
  svg.close();
  return std::max(classes.y(), marks.y()) - corner.y;
}

}  // namespace whisker::report
