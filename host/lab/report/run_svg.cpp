#include "host/lab/report/run_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/lab/report/axes.hpp"
#include "host/lab/report/result.hpp"
#include "host/lab/report/run_edges.hpp"
#include "host/lab/report/run_legend.hpp"
#include "host/lab/report/run_map.hpp"
#include "host/lab/report/run_scene.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::report {
namespace {

constexpr double kLeft = 62;
constexpr double kEdge = 20;
constexpr double kBelowPlot = 52;
constexpr double kMinWidth = 620;

struct Layout {
  View view;
  bool legend_below = false;
  Point legend;
  double width = 0;
  double height = 0;
};

/// Draws the legend only to measure it.
double legend_height(int columns, const LegendContent& content) {
  Svg scratch(1, 1, "");
  return draw_legend(scratch, {}, columns, content);
}

Layout lay_out(const Box& box, double top, const LegendContent& content, bool with_legend) {
  Layout layout;
  const double x = box.max().x - box.min().x;
  const double y = box.max().y - box.min().y;
  layout.legend_below = x > 1.4 * y;
  layout.view = fit(box, {kLeft, top}, layout.legend_below ? 860 : 600, layout.legend_below ? 620 : 640);
  if (!with_legend) {
    layout.width = std::max(layout.view.right() + kEdge, kMinWidth);
    layout.height = layout.view.bottom() + kBelowPlot;
    return layout;
  }
  const double legend = legend_height(layout.legend_below ? 2 : 1, content);
  if (layout.legend_below) {
    layout.legend = {kLeft, layout.view.bottom() + kBelowPlot};
    layout.width = layout.view.right() + kEdge;
    layout.height = layout.legend.y + legend + kEdge;
  } else {
    layout.legend = {layout.view.right() + 28, top};
    layout.width = layout.legend.x + kLegendWidth + kEdge;
    layout.height = std::max(layout.view.bottom() + kBelowPlot, top + legend + kEdge);
  }
  layout.width = std::max(layout.width, kMinWidth);
  return layout;
}

Box box_of(const Scenario& scenario, const std::vector<TickRecord>& records, const RunPicture& options) {
  Box box = scene_box(scenario, records);
  if (options.beside == nullptr) return box;
  const Box other = scene_box(scenario, *options.beside);
  box.add(other.min());
  box.add(other.max());
  return box;
}

/// The last record with a drawable position, or null.
const TickRecord* last_placed(const std::vector<TickRecord>& records) {
  const auto it = std::find_if(records.rbegin(), records.rend(), [](const TickRecord& r) {
    return drawable({r.x_m, r.y_m});
  });
  return it == records.rend() ? nullptr : &*it;
}

sim::Pose pose(const TickRecord& r) {
  return {{r.x_m, r.y_m}, std::isfinite(r.heading_rad) ? r.heading_rad : 0.0};
}

std::string name_of(const Scenario& scenario) {
  return scenario.name.empty() ? "unnamed scenario" : shortened(scenario.name, 70);
}

}  // namespace

std::string run_svg(const RunLog& log, const RunPicture& options) {
  const Scenario& scenario = log.setting().scenario;
  const std::vector<TickRecord>& records = log.ticks().records;
  const RunResult& result = log.result();
  const TickRecord* end = last_placed(records);
  const auto entries = danger_entries(records, options.cones);
  LegendContent content;
  content.track = summarise(records);
  content.encounters = encounters(records);
  content.goal = scenario.goal.at;
  content.looks = options.looks && content.track.looks > 0;
  content.cones = !entries.empty();
  content.end = end != nullptr;
  content.contact = result.verdict == Verdict::contact;
  content.obstacles = !scenario.discs.empty() || !scenario.polygons.empty();
  content.walls = !scenario.walls.empty();
  content.movers = !scenario.movers.empty();
  content.hand_overs = hand_overs(records);
  if (end != nullptr && log.map()) content.map = &*log.map();

  const double top = options.subtitle.empty() ? 66 : 84;
  const Layout layout = lay_out(box_of(scenario, records, options), top, content, options.legend);
  const View& view = layout.view;
  const double body = metres(scenario.robot.body.radius);
  const std::string words = verdict_words(result);

  Svg svg(layout.width, layout.height, name_of(scenario) + ": " + words);
  svg.text({kEdge, 28}, name_of(scenario), R"(class="name" font-size="17" font-weight="bold")");
  svg.text({kEdge, 49}, shortened(words, 110),
           fmt::format(R"(class="verdict" font-size="{}")", options.legend ? "13" : "11.5"));
  if (!options.subtitle.empty())
    svg.text({kEdge, 68}, shortened(options.subtitle, 120),
             fmt::format(R"(class="subtitle" font-size="{}" fill="#555")", options.legend ? "12" : "11"));

  svg.open_clipped("plot", view.corner, view.width(), view.height());
  draw_world(svg, view, scenario, end != nullptr ? end->t_s : 0.0);
  if (content.map != nullptr) draw_map(svg, view, *content.map, *end);
  draw_straight_way(svg, view, scenario);
  draw_goal(svg, view, scenario.goal);
  for (const TickRecord* entry : entries) draw_cones(svg, view, scenario.robot.rangefinders, *entry);
  draw_body(
      svg, view, body, scenario.start,
      R"(class="body start" fill="#fff" fill-opacity="0.7" stroke="#222" stroke-width="1.2" stroke-dasharray="3 2")");
  draw_path(svg, view, records, options.path_tolerance);
  if (content.looks) draw_looks(svg, view, records);
  if (end != nullptr)
    draw_body(svg, view, body, pose(*end),
              R"(class="body end" fill="#c9d8e4" fill-opacity="0.65" stroke="#222" stroke-width="1.5")");
  if (content.map != nullptr) draw_way_points(svg, view, records);
  draw_encounters(svg, view, content.encounters);
  draw_hand_overs(svg, view, content.hand_overs);
  if (content.contact) draw_contact(svg, view, body, end != nullptr ? pose(*end) : scenario.start);
  draw_labels(svg, view, scenario, end, result.verdict);
  svg.close();
  draw_axes(svg, view);
  if (options.legend) draw_legend(svg, layout.legend, layout.legend_below ? 2 : 1, content);
  return std::move(svg).finish();
}

}  // namespace whisker::report
