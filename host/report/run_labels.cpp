#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "host/report/palette.hpp"
#include "host/report/run_scene.hpp"
#include "host/report/units.hpp"

namespace whisker::report {
namespace {

struct Label {
  Point at;
  double gap;  ///< px from the place to the text
  std::string_view text;
  const char* colour;
};

bool overlap(const Label& a, const Label& b) {
  return std::fabs(a.at.x - b.at.x) < 48 && std::fabs(a.at.y - b.at.y) < 14 + std::fabs(a.gap - b.gap);
}

void draw(Svg& svg, const View& view, const Label& label) {
  const bool below = label.at.y - label.gap < view.corner.y + 14;
  const double y = below ? label.at.y + label.gap + 11 : label.at.y - label.gap;
  const char* anchor = label.at.x < view.corner.x + 30  ? "start"
                       : label.at.x > view.right() - 30 ? "end"
                                                        : "middle";
  const double shift = anchor[0] == 's' ? -6 : anchor[0] == 'e' ? 6 : 0;
  svg.text({label.at.x + shift, y}, label.text,
           fmt::format(R"(text-anchor="{}" fill="{}")", anchor, label.colour));
}

}  // namespace

void draw_labels(Svg& svg, const View& view, const Scenario& scenario, const TickRecord* end,
                 Verdict verdict) {
  const double body = std::max(metres(scenario.robot.body.radius) * view.pixels_per_metre, 8.0);
  const double circle = std::max(scenario.goal.tolerance_m * view.pixels_per_metre, 8.0);
  std::vector<Label> labels;
  const auto add = [&](const Label& label) {
    for (const Label& other : labels)
      if (overlap(label, other)) return;
    labels.push_back(label);
  };
  if (end != nullptr && verdict == Verdict::contact)
    add({view.page({end->x_m, end->y_m}), body + 10, "contact", kContactColour});
  add({view.page(scenario.goal.at), circle + 5, "goal", kGoalColour});
  add({view.page(scenario.start.at), body + 5, "start", "#222"});
  if (end != nullptr) add({view.page({end->x_m, end->y_m}), body + 5, "end", "#222"});
  svg.open(
      R"(class="labels" font-weight="bold" stroke="#fff" stroke-width="3" stroke-linejoin="round" paint-order="stroke")");
  for (const Label& label : labels) draw(svg, view, label);
  svg.close();
}

}  // namespace whisker::report
