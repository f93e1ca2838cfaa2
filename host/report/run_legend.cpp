#include "host/report/run_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "host/report/palette.hpp"

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
  /// The middle of the next row's swatch.
  Point row(const std::string& label) {
    y_ += kRow;
    svg_.text({corner_.x + kSwatch + 8, y_ - 4}, label, "");
    return {corner_.x + kSwatch / 2, y_ - 8};
  }
  /// Two figures at the right end of the row before.
  void figures(const std::string& first, const std::string& second) {
    svg_.text({corner_.x + kLegendWidth - 48, y_ - 4}, first, R"(text-anchor="end")");
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
    column.figures(decimals(track.metres[k], 2) + " m", decimals(share, 0) + " %");
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
  if (columns == 1) classes.gap();
  Column marks(svg,
               columns == 1 ? Point{corner.x, classes.y()} : Point{corner.x + kLegendWidth + 40, corner.y});
  draw_marks(svg, marks, content);
  svg.close();
  return std::max(classes.y(), marks.y()) - corner.y;
}

}  // namespace whisker::report
