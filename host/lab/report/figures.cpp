#include "host/lab/report/figures.hpp"

#include <cmath>

#include <fmt/format.h>

#include "host/lab/report/axes.hpp"
#include "host/lab/report/colour.hpp"

namespace whisker::report {
namespace {

/// Distinct in hue for colour-blind eyes; neighbours also differ in dashes for grey print.
struct Stroke {
  const char* colour;
  const char* dashes;
};
constexpr Stroke kStrokes[] = {
    {"#225aa0", "none"}, {"#c2690a", "7 3"}, {"#00795c", "none"}, {"#a0337a", "7 3"}, {"#3a3a3a", "none"}};

PathData membership(const Plot& plot, const Variable& v, std::size_t term) {
  const double centre = v.terms[term].centre;
  PathData data;
  if (term == 0) {
    data.move(plot.page(v.min, 1)).line(plot.page(centre, 1));
  } else {
    data.move(plot.page(v.terms[term - 1].centre, 0)).line(plot.page(centre, 1));
  }
  data.line(term + 1 == v.terms.size() ? plot.page(v.max, 1) : plot.page(v.terms[term + 1].centre, 0));
  return data;
}

constexpr double kSquare = 62;

/// D rises upwards, as on the axes of the response.
void draw_rule_base(Svg& svg, Point corner, const FuzzyPicture& picture, const Variable& output,
                    const std::vector<std::vector<Rule>>& rules, const ColourScale& scale, const char* name) {
  const std::size_t rows = picture.d.terms.size();
  const std::size_t columns = picture.r.terms.size();
  const double height = kSquare * static_cast<double>(rows);
  svg.open(fmt::format(R"(class="rule-base {}" text-anchor="middle")", name));
  svg.text({corner.x, corner.y - 14}, output.symbol + ": " + output.meaning,
           R"(text-anchor="start" font-size="13" font-weight="bold")");
  for (std::size_t i = 0; i < rows; ++i) {
    const double y = corner.y + height - kSquare * static_cast<double>(i + 1);
    svg.text({corner.x - 22, y + kSquare / 2 + 4}, picture.d.terms[i].name, "");
    for (std::size_t j = 0; j < columns; ++j) {
      const double x = corner.x + kSquare * static_cast<double>(j);
      const Rule& rule = rules[i][j];
      const char* ink = scale.ink(rule.value);
      svg.rect({x, y}, kSquare, kSquare,
               fmt::format(R"(fill="{}" stroke="#fbfbf9" stroke-width="2")", scale.at(rule.value)));
      svg.text({x + kSquare / 2, y + kSquare / 2 - 1}, rule.term,
               fmt::format(R"(font-weight="bold" fill="{}")", ink));
      svg.text({x + kSquare / 2, y + kSquare / 2 + 14}, decimals(rule.value, 2),
               fmt::format(R"(font-size="11" fill="{}")", ink));
    }
  }
  for (std::size_t j = 0; j < columns; ++j)
    svg.text({corner.x + kSquare * (static_cast<double>(j) + 0.5), corner.y + height + 18},
             picture.r.terms[j].name, "");
  svg.close();
}

constexpr int kCellsR = 32;  // over the thesis's ranges, cells of half a unit: every centre is a line
constexpr int kCellsD = 20;
constexpr double kWidth = 250;   ///< px from the front corner to the right corner, and to the left one
constexpr double kDepth = 118;   ///< px of these corners above the front corner
constexpr double kHeight = 190;  ///< px from the lowest to the highest output

/// A block over R (0 at the right corner, 1 at the front) and D (0 at the front, 1 at the left), output
/// upwards, so that the low corner of the turn factor is in front.
struct Block {
  Point front;
  Range r, d, out;

  Point at(double r01, double d01, double out01) const {
    return {front.x + kWidth * (1 - r01 - d01), front.y - kDepth * (1 - r01 + d01) - kHeight * out01};
  }
  double share(double value) const {
    return std::isfinite(value) ? (value - out.min) / (out.max - out.min) : 0.0;
  }
};

double between(Range range, double share) { return range.min + (range.max - range.min) * share; }

void draw_walls(Svg& svg, const Block& block) {
  PathData walls;
  walls.move(block.at(1, 1, 0))
      .line(block.at(0, 1, 0))
      .line(block.at(0, 1, 1))
      .line(block.at(1, 1, 1))
      .close();
  walls.move(block.at(0, 0, 0))
      .line(block.at(0, 1, 0))
      .line(block.at(0, 1, 1))
      .line(block.at(0, 0, 1))
      .close();
  svg.path(walls, R"(fill="#fff" stroke="#b8b8b4")");
  PathData lines;
  for (const double value : ticks(block.out, 4)) {
    const double z = block.share(value);
    lines.move(block.at(1, 1, z)).line(block.at(0, 1, z)).line(block.at(0, 0, z));
    const Point p = block.at(1, 1, z);
    svg.text({p.x - 6, p.y + 4}, decimals(value, 1), R"(text-anchor="end" font-size="11" fill="#444")");
  }
  svg.path(lines, R"(fill="none" stroke="#e0e0dc")");
}

void draw_floor(Svg& svg, const Block& block, const FuzzyPicture& picture) {
  PathData floor;
  floor.move(block.at(1, 1, 0)).line(block.at(1, 0, 0)).line(block.at(0, 0, 0));
  svg.path(floor, R"(fill="none" stroke="#8c8c88")");
  svg.open(R"(class="axes" font-size="11" fill="#444" text-anchor="middle")");
  for (const double value : ticks(block.r, 8)) {
    const Point p = block.at((value - block.r.min) / (block.r.max - block.r.min), 0, 0);
    svg.text({p.x + 10, p.y + 16}, decimals(value, 0), "");
  }
  for (const double value : ticks(block.d, 5)) {
    const Point p = block.at(1, (value - block.d.min) / (block.d.max - block.d.min), 0);
    svg.text({p.x - 10, p.y + 16}, decimals(value, 0), "");
  }
  const Point r = block.at(0.5, 0, 0);
  const Point d = block.at(1, 0.5, 0);
  svg.text({r.x + 34, r.y + 36}, picture.r.symbol, R"(font-weight="bold")");
  svg.text({d.x - 34, d.y + 36}, picture.d.symbol, R"(font-weight="bold")");
  svg.close();
}

/// From the far corner to the near one, so that near cells cover far ones.
void draw_surface(Svg& svg, const Block& block, const std::function<double(double, double)>& f,
                  const ColourScale& scale) {
  const auto value = [&](int i, int j) {
    return f(between(block.d, static_cast<double>(j) / kCellsD),
             between(block.r, static_cast<double>(i) / kCellsR));
  };
  const auto corner = [&](int i, int j) {
    return block.at(static_cast<double>(i) / kCellsR, static_cast<double>(j) / kCellsD,
                    block.share(value(i, j)));
  };
  svg.open(
      R"(class="surface" stroke="#000" stroke-opacity="0.22" stroke-width="0.5" stroke-linejoin="round")");
  for (int i = 0; i < kCellsR; ++i) {
    for (int j = kCellsD - 1; j >= 0; --j) {
      PathData cell;
      cell.move(corner(i, j))
          .line(corner(i + 1, j))
          .line(corner(i + 1, j + 1))
          .line(corner(i, j + 1))
          .close();
      const double mean = (value(i, j) + value(i + 1, j) + value(i + 1, j + 1) + value(i, j + 1)) / 4;
      svg.path(cell, fmt::format(R"(fill="{}")", scale.at(mean)));
    }
  }
  svg.close();
}

void draw_block(Svg& svg, Point front, const FuzzyPicture& picture, const Variable& output,
                const std::function<double(double, double)>& f, const ColourScale& scale) {
  const Block block{
      front, {picture.r.min, picture.r.max}, {picture.d.min, picture.d.max}, {output.min, output.max}};
  svg.text({front.x - kWidth - 20, front.y - 2 * kDepth - kHeight - 16},
           output.symbol + ": " + output.meaning, R"(font-size="13" font-weight="bold")");
  draw_walls(svg, block);
  draw_surface(svg, block, f, scale);
  draw_floor(svg, block, picture);
}

}  // namespace

std::string membership_svg(const Variable& variable, const std::string& title) {
  check(variable);
  const Plot plot{{64, 80}, 560, 190, {variable.min, variable.max}, {0, 1}};
  Svg svg(650, 324, title);
  svg.text({20, 30}, title, R"(font-size="15" font-weight="bold")");
  svg.rect(plot.corner, plot.width, plot.height, R"(fill="#fff")");
  svg.line(plot.page(variable.min, 0.5), plot.page(variable.max, 0.5),
           R"(stroke="#c8c8c4" stroke-dasharray="2 3")");
  draw_plot_axes(svg, plot, variable.symbol + ": " + variable.meaning, "membership", 10, 4);
  for (std::size_t i = 0; i < variable.terms.size(); ++i) {
    const Stroke& stroke = kStrokes[i % 5];
    const Point peak = plot.page(variable.terms[i].centre, 1);
    svg.path(membership(plot, variable, i),
             fmt::format(R"(class="term" fill="none" stroke="{}" stroke-width="2.2" stroke-dasharray="{}")",
                         stroke.colour, stroke.dashes));
    svg.circle(peak, 3, fmt::format(R"(fill="{}")", stroke.colour));
    svg.text({peak.x, peak.y - 22}, variable.terms[i].name,
             fmt::format(R"(text-anchor="middle" font-weight="bold" fill="{}")", stroke.colour));
    svg.text({peak.x, peak.y - 8}, number(variable.terms[i].centre),
             R"(text-anchor="middle" font-size="11" fill="#444")");
  }
  return std::move(svg).finish();
}

std::string rules_svg(const FuzzyPicture& picture, const std::string& title) {
  check(picture);
  const double width = kSquare * static_cast<double>(picture.r.terms.size());
  const double height = kSquare * static_cast<double>(picture.d.terms.size());
  Svg svg(2 * width + 190, height + 142, title);
  svg.text({20, 30}, title, R"(font-size="15" font-weight="bold")");
  draw_rule_base(svg, {72, 84}, picture, picture.sa, picture.turn,
                 ColourScale::diverging(picture.sa.min, picture.sa.max), "turn");
  draw_rule_base(svg, {72 + width + 92, 84}, picture, picture.sd, picture.step,
                 ColourScale::sequential(picture.sd.min, picture.sd.max), "step");
  svg.text({20, height + 126},
           "Across: " + picture.r.symbol + ", " + picture.r.meaning + ". Up: " + picture.d.symbol + ", " +
               picture.d.meaning + ".",
           R"(fill="#555")");
  return std::move(svg).finish();
}

std::string surface_svg(const FuzzyPicture& picture, const std::string& title) {
  check(picture);
  Svg svg(1130, 590, title);
  svg.text({20, 30}, title, R"(font-size="15" font-weight="bold")");
  draw_block(svg, {296, 512}, picture, picture.sa, picture.sa_at,
             ColourScale::diverging(picture.sa.min, picture.sa.max));
  draw_block(svg, {850, 512}, picture, picture.sd, picture.sd_at,
             ColourScale::sequential(picture.sd.min, picture.sd.max));
  svg.text({20, 572},
           picture.r.symbol + ": " + picture.r.meaning + "; " + picture.d.symbol + ": " + picture.d.meaning,
           R"(fill="#555")");
  return std::move(svg).finish();
}

std::vector<std::pair<std::string, std::string>> thesis_figures(const FuzzyPicture& picture) {
  check(picture);
  return {
      {"figure2.svg", membership_svg(picture.d, "Figure 2: membership functions of " + picture.d.symbol)},
      {"figure3.svg", membership_svg(picture.r, "Figure 3: membership functions of " + picture.r.symbol)},
      {"figure4.svg", membership_svg(picture.sa, "Figure 4: membership functions of " + picture.sa.symbol)},
      {"figure5.svg", membership_svg(picture.sd, "Figure 5: membership functions of " + picture.sd.symbol)},
      {"figure6.svg", rules_svg(picture, "Figure 6: the fuzzy control rules")},
      {"figure7.svg", surface_svg(picture, "Figure 7: the response surface")},
  };
}

}  // namespace whisker::report
