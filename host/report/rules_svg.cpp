#include <fmt/format.h>

#include "host/report/colour.hpp"
#include "host/report/figures.hpp"

namespace whisker::report {
namespace {

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

}  // namespace

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

}  // namespace whisker::report
