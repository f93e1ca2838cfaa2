#include <fmt/format.h>

#include "host/report/figures.hpp"
#include "host/report/plot.hpp"

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

}  // namespace whisker::report
