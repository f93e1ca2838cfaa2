#include "host/lab/report/table_svg.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "host/lab/report/axes.hpp"
#include "host/lab/report/colour.hpp"

namespace whisker::report {
namespace {

constexpr double kSide = 400;
constexpr double kCell = 2.5;
constexpr int kCells = 160;  // kSide / kCell
constexpr int kLevels = 49;  // odd, so that zero has its own level in the middle of a diverging scale

using Function = std::function<double(double, double)>;

/// The colour level of each cell, so that neighbours of one colour become one rectangle.
int level(double value, const ColourScale& scale) {
  const double share = (value - scale.min()) / (scale.max() - scale.min());
  if (!std::isfinite(share)) return 0;
  return static_cast<int>(std::fmin(std::fmax(share * kLevels, 0), kLevels - 1));
}

void draw_cells(Svg& svg, const Plot& plot, const Function& f, const ColourScale& scale) {
  std::array<PathData, kLevels> levels;
  for (int row = 0; row < kCells; ++row) {
    const double d = plot.y.max - (plot.y.max - plot.y.min) * (row + 0.5) / kCells;
    const auto level_at = [&](int column) {
      return level(f(d, plot.x.min + (plot.x.max - plot.x.min) * (column + 0.5) / kCells), scale);
    };
    const double y = plot.corner.y + row * kCell;
    for (int from = 0; from < kCells;) {
      const int here = level_at(from);
      int to = from + 1;
      while (to < kCells && level_at(to) == here) ++to;
      const double left = plot.corner.x + from * kCell;
      const double right = plot.corner.x + to * kCell;
      levels[static_cast<std::size_t>(here)].box({left, y}, right - left, kCell);
      from = to;
    }
  }
  svg.open(R"(class="cells" shape-rendering="crispEdges")");
  for (std::size_t i = 0; i < kLevels; ++i) {
    const double value = scale.min() + (scale.max() - scale.min()) * (static_cast<double>(i) + 0.5) / kLevels;
    svg.path(levels[i], fmt::format(R"(fill="{}")", scale.at(value)));
  }
  svg.close();
}

void draw_rules(Svg& svg, const Plot& plot, const FuzzyPicture& picture,
                const std::vector<std::vector<Rule>>& rules, bool sign) {
  constexpr double kHalf = 22;
  PathData grid;
  for (const Term& r : picture.r.terms)
    grid.move(plot.page(r.centre, plot.y.min)).line(plot.page(r.centre, plot.y.max));
  for (const Term& d : picture.d.terms)
    grid.move(plot.page(plot.x.min, d.centre)).line(plot.page(plot.x.max, d.centre));
  svg.path(grid, R"(fill="none" stroke="#000" stroke-opacity="0.25" stroke-dasharray="2 3")");
  svg.open(R"(class="rules" text-anchor="middle" font-size="11")");
  for (std::size_t i = 0; i < rules.size(); ++i) {
    for (std::size_t j = 0; j < rules[i].size(); ++j) {
      const Point c = plot.page(picture.r.terms[j].centre, picture.d.terms[i].centre);
      svg.rect({c.x - kHalf, c.y - 15}, 2 * kHalf, 30, R"(rx="4" fill="#fff" fill-opacity="0.82")");
      svg.text({c.x, c.y - 2}, rules[i][j].term, R"(font-weight="bold")");
      svg.text({c.x, c.y + 11},
               fmt::format("{}{}", sign && rules[i][j].value > 0 ? "+" : "", decimals(rules[i][j].value, 2)),
               "");
    }
  }
  svg.close();
}

void draw_term_names(Svg& svg, const Plot& plot, const FuzzyPicture& picture) {
  svg.open(R"(class="terms" font-size="10" fill="#666" text-anchor="middle")");
  for (const Term& r : picture.r.terms) svg.text({plot.page(r.centre, 0).x, plot.corner.y - 5}, r.name, "");
  svg.close().open(R"(class="terms" font-size="10" fill="#666")");
  for (const Term& d : picture.d.terms)
    svg.text({plot.corner.x + plot.width + 4, plot.page(0, d.centre).y + 4}, d.name, "");
  svg.close();
}

void draw_map(Svg& svg, Point corner, const FuzzyPicture& picture, const Variable& output, const Function& f,
              const ColourScale& scale, bool sign) {
  // R increases to the left, so that the left side of the map means nearer on the left.
  const Plot plot{corner, kSide, kSide, {picture.r.max, picture.r.min}, {picture.d.min, picture.d.max}};
  svg.open(fmt::format(R"(class="map {}")", sign ? "turn" : "step"));
  svg.text({corner.x, corner.y - 26}, output.symbol + ": " + output.meaning,
           R"(font-size="14" font-weight="bold")");
  draw_cells(svg, plot, f, scale);
  draw_rules(svg, plot, picture, sign ? picture.turn : picture.step, sign);
  draw_plot_axes(svg, plot, picture.r.symbol + ": " + picture.r.meaning,
                 picture.d.symbol + ": " + picture.d.meaning, 8, 10);
  draw_term_names(svg, plot, picture);
  draw_colour_bar(svg, {corner.x + kSide + 28, corner.y}, 16, kSide, scale, 5);
  svg.close();
}

}  // namespace

std::string table_svg(const FuzzyPicture& picture) {
  check(picture);
  const std::string title = "Control response: turn and step by distance and side difference";
  Svg svg(1090, 590, title);
  svg.text({20, 30}, title, R"(font-size="17" font-weight="bold")");
  draw_map(svg, {60, 84}, picture, picture.sa, picture.sa_at,
           ColourScale::diverging(picture.sa.min, picture.sa.max), true);
  draw_map(svg, {602, 84}, picture, picture.sd, picture.sd_at,
           ColourScale::sequential(picture.sd.min, picture.sd.max), false);
  svg.text({20, 548},
           "Left: the left side is nearer. Each label stands at a rule's centre: the output term and its "
           "value. Blue turns right, orange turns left; darker is a longer step.",
           R"(class="caption" fill="#555")");
  if (!picture.source.empty())
    svg.text({20, 568}, "Surface: " + picture.source, R"(class="caption" fill="#555")");
  return std::move(svg).finish();
}

}  // namespace whisker::report
