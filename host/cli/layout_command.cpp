#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/params/relations.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/sensor_models.hpp"
#include "host/harness/scenario/sensor_text.hpp"
#include "host/harness/scenario/text.hpp"
#include "host/lab/campaign/layouts.hpp"
#include "host/lab/campaign/mission.hpp"
#include "host/lab/report/layout_svg.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::cli {
namespace {

struct LayoutTrade {
  std::string sensor;  ///< the name of its model
  Sensor what;
  Params robot;  ///< without a layout
  campaign::LayoutGrid grid;
  std::uint64_t count = 0;  ///< missions of a layout in each kind of world
  std::uint64_t seed = 1;
  std::vector<campaign::LayoutScore> ranked;  ///< not empty, best first
};

using campaign::LayoutScore;
using report::degrees;
using report::metres;
using Json = nlohmann::ordered_json;

constexpr const char* kWorlds = "30 discs, U-traps, mazes and rooms";

/// Without the remainder of the fixed-point unit.
double tidy(double x) { return campaign::rounded(x); }

std::string pace(const std::optional<double>& s_per_m) {
  return s_per_m ? fmt::format("{:.1f}", *s_per_m) : "-";
}

std::string row(const LayoutScore& s) {
  std::string text = fmt::format("{:6.1f} {:7.3f} {:7.1f} {:+7.1f} {:6.0f} % {:6.0f} % {:>6}",
                                 s.layout.side_angle_deg, s.layout.offset_m, s.needed_incidence_deg,
                                 s.margin_deg, 100 * s.success.value, 100 * s.contact.value, pace(s.s_per_m));
  for (const auto& world : s.world_s_per_m) text += fmt::format(" {:>6}", pace(world));
  return text + fmt::format(" {:6.0f}\n", s.unseen.width() * 1e3);
}

Json estimate(const campaign::Estimate& e) {
  const auto bound = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  return {{"value", e.value}, {"low", bound(e.low)}, {"high", bound(e.high)}};
}

Json score_json(const LayoutScore& s) {
  const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  Json worlds = Json::object();
  for (int k = 0; k < campaign::kLayoutKinds; ++k) {
    worlds[name(campaign::kLayoutWorlds[k])] = number(s.world_s_per_m[k]);
  }
  return {{"side_angle_deg", s.layout.side_angle_deg},
          {"offset_m", s.layout.offset_m},
          {"needed_incidence_deg", tidy(s.needed_incidence_deg)},
          {"margin_deg", tidy(s.margin_deg)},
          {"unseen_strip_m", tidy(s.unseen.width())},
          {"missions", s.missions},
          {"success", estimate(s.success)},
          {"contact", estimate(s.contact)},
          {"s_per_m", number(s.s_per_m)},
          {"world_s_per_m", worlds}};
}

std::string place(const campaign::Layout& layout) {
  return fmt::format("range_side_angle_deg = {}, range_offset_m = {:.3f}", layout.side_angle_deg,
                     layout.offset_m);
}

/// The mountings that check() refuses: "cone_too_narrow 3, beams_crossed 1".
std::string refused_words(const campaign::LayoutGrid& grid) {
  std::string text;
  for (int i = 0; i < kParamFaults; ++i) {
    const std::uint64_t count = grid.refusals[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", relation(static_cast<ParamFault>(i)).name, count);
  }
  return text;
}

/// Lines for people, each ending in a newline.
std::string layout_words(const LayoutTrade& t) {
  const RangefinderParams& r = t.robot.rangefinders;
  std::string offsets;
  for (const double offset : t.grid.offsets_m) {
    offsets += fmt::format("{}{:.3f}", offsets.empty() ? "" : ", ", offset);
  }
  std::string text = fmt::format(
      "{} on a body of {:.3f} m: cone {:.1f} degrees, walls echo up to L = {:.0f} degrees, {:.2f} to {:.2f} "
      "m, "
      "{} Hz, {} ms\n",
      t.sensor, metres(t.robot.body.radius), degrees(r.cone), degrees(r.incidence), metres(r.min_range),
      metres(r.max_range), r.rate_hz, r.latency.raw());
  text += fmt::format("side angles {} to {} degrees, offsets {} m; check() refuses {} of {}{}\n",
                      t.grid.angles_deg.front(), t.grid.angles_deg.back(), offsets, t.grid.refused,
                      t.grid.refused + t.grid.layouts.size(),
                      t.grid.refused == 0 ? "" : ": " + refused_words(t.grid));
  text += fmt::format("missions of a layout in each of {1}: {0}, seeds {2} to {3}\n\n", t.count, kWorlds,
                      t.seed, t.seed + t.count - 1);
  text += " angle  offset  L from  margin  success  contact    s/m  discs u-trap   maze  rooms unseen\n";
  text += "   deg       m     deg     deg                                                        mm\n";
  for (const LayoutScore& s : t.ranked) text += row(s);
  text += fmt::format("\nbest: {}\nwhy: {}\n", place(t.ranked.front().layout), campaign::reason(t.ranked));
  for (const double offset : t.grid.offsets_m) {
    const auto best = std::find_if(t.ranked.begin(), t.ranked.end(),
                                   [&](const LayoutScore& s) { return s.layout.offset_m == offset; });
    if (best != t.ranked.end() && best != t.ranked.begin()) {
      text += fmt::format("best with this offset: {}\n", place(best->layout));
    }
  }
  return text;
}

/// One JSON object without provenance.
std::string layout_json(const LayoutTrade& t) {
  const RangefinderParams& r = t.robot.rangefinders;
  Json layouts = Json::array(), worlds = Json::array(), refusals = Json::object();
  for (const LayoutScore& s : t.ranked) layouts.push_back(score_json(s));
  for (const worlds::Kind kind : campaign::kLayoutWorlds) worlds.push_back(name(kind));
  for (int i = 0; i < kParamFaults; ++i) {
    const std::uint64_t count = t.grid.refusals[static_cast<std::size_t>(i)];
    if (count != 0) refusals[relation(static_cast<ParamFault>(i)).name] = count;
  }
  const Json json = {{"sensor", t.sensor},
                     {"body_radius_m", metres(t.robot.body.radius)},
                     {"cone_deg", tidy(degrees(r.cone))},
                     {"incidence_deg", tidy(degrees(r.incidence))},
                     {"rule_angle_deg", tidy(campaign::rule_angle_deg(t.robot, false))},
                     {"worlds", worlds},
                     {"missions_per_world", t.count},
                     {"angles_deg", t.grid.angles_deg},
                     {"offsets_m", t.grid.offsets_m},
                     {"refused", t.grid.refused},
                     {"refusals", refusals},
                     {"layouts", layouts},
                     {"best", layouts.front()},
                     {"why", campaign::reason(t.ranked)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The chart.
std::string layout_picture(const LayoutTrade& t) {
  report::LayoutChart chart;
  chart.title =
      fmt::format("Where to mount three {} on a body of {:.3f} m", t.sensor, metres(t.robot.body.radius));
  chart.subtitle = fmt::format("{} missions a point in {}; cone {:.1f} degrees, L = {:.0f} degrees",
                               t.count * campaign::kLayoutKinds, kWorlds, degrees(t.robot.rangefinders.cone),
                               degrees(t.robot.rangefinders.incidence));
  chart.rule_angle_deg = campaign::rule_angle_deg(t.robot, false);
  chart.margin_deg = kIncidenceMargin;
  for (const double offset : t.grid.offsets_m) {
    report::LayoutLine line{fmt::format("offset {:.3f} m", offset), {}};
    for (const LayoutScore& s : t.ranked) {
      if (s.layout.offset_m != offset) continue;
      line.points.push_back(
          {s.layout.side_angle_deg, s.success.value, s.s_per_m, s.contacts > 0, &s == t.ranked.data()});
    }
    std::sort(line.points.begin(), line.points.end(),
              [](const auto& a, const auto& b) { return a.angle_deg < b.angle_deg; });
    if (!line.points.empty()) chart.lines.push_back(line);
  }
  return report::layout_svg(chart);
}

/// The best layout as a robot file with its [sensor].
std::string layout_robot_file(const LayoutTrade& t) {
  const LayoutScore& best = t.ranked.front();
  return fmt::format(
      "# Three {} where `whisker robot layout` puts them: side angle {} degrees, offset {:.3f} m.\n{}{}",
      t.sensor, best.layout.side_angle_deg, best.layout.offset_m, robot_toml(best.layout.robot),
      sensor_toml(t.what));
}

constexpr double kSmallestBody = 0.02, kLargestBody = 1;  // m
constexpr double kLargestAngle = 85;                      // deg
constexpr double kFarthestClear = 60;                     // m
constexpr std::uint64_t kMostOfAKind = 1000;              // of a layout in a kind of world

struct LayoutOptions {
  std::string sensor;
  std::optional<double> body;
  std::optional<double> clear;
  std::string robot;
  std::vector<double> angles;  ///< empty: the grid's
  std::uint64_t count = 5;
  std::uint64_t seed = 1;
  PlannerKind planner = kDefaultPlanner;
  CampaignOptions campaign;  ///< of which only --jobs
  std::string svg;
  std::string out;
  bool json = false;
};

const SensorModel& model_of(const LayoutOptions& o) {
  const SensorModel* model = find_sensor_model(o.sensor);
  if (model != nullptr) return *model;
  const auto names = sensor_model_names();
  throw UsageError(
      fmt::format("--sensor: no sensor model '{}'{}", o.sensor, did_you_mean(lower_case(o.sensor), names)));
}

LayoutTrade trade_of(const LayoutOptions& o) {
  LayoutTrade t;
  const SensorModel& model = model_of(o);
  t.sensor = model.name;
  t.count = o.count;
  t.seed = o.seed;
  if (!o.robot.empty()) apply_robot_file(t.robot, t.what, o.robot);
  if (o.body && *o.body < kSmallestBody) {
    throw UsageError(fmt::format("--body {}: below {} m", *o.body, kSmallestBody));
  }
  if (o.body) t.robot = campaign::scaled(t.robot, *o.body / (t.robot.body.radius.raw() * 1e-6));
  if (o.clear) set_si(t.robot.rangefinders.clear_range, *o.clear);
  t.robot = campaign::equipped(t.robot, model);
  apply(model, t.what);
  t.grid = campaign::layout_grid(t.robot, o.angles);
  if (t.grid.layouts.empty()) {
    std::size_t first = 0;
    while (t.grid.refusals[first] == 0) ++first;
    throw UsageError(fmt::format("{}: check() refuses all {} layouts ({}): {}", t.sensor, t.grid.refused,
                                 refused_words(t.grid), relation(static_cast<ParamFault>(first)).words));
  }
  return t;
}

/// Every layout drives the same worlds. False: interrupted.
bool drive_all(const LayoutOptions& o, LayoutTrade& t) {
  const std::uint64_t each = campaign::kLayoutKinds * o.count, all = t.grid.layouts.size() * each;
  std::vector<campaign::Row> rows;
  const bool whole = make_many(
      all, o.campaign.jobs,
      [&](std::uint64_t i, const std::atomic<bool>& stop) {
        const campaign::Layout& layout = t.grid.layouts[i / each];
        const worlds::Kind kind = campaign::kLayoutWorlds[i % each / o.count];
        Scenario scenario = campaign::layout_scenario(layout, t.what, kind, o.seed + i % o.count);
        bend_if_chosen(scenario.robot, o.planner);
        return campaign::drive(scenario, o.planner, stop,
                               campaign::kWayRadius * campaign::size_of(layout.robot));
      },
      [&](const campaign::Row& row) {
        rows.push_back(row);
        if (rows.size() < each) return;
        t.ranked.push_back(campaign::score(t.grid.layouts[t.ranked.size()], t.what, rows));
        rows.clear();
      });
  campaign::rank(t.ranked);
  return whole;
}

int execute(const LayoutOptions& o) {
  check_outputs({o.svg, o.out}, {o.robot}, o.json);
  check_seeds(o.count, o.seed);
  LayoutTrade trade = trade_of(o);
  const bool whole = drive_all(o, trade);
  const Interrupted interrupted(
      fmt::format(" after {} of {} layouts", trade.ranked.size(), trade.grid.layouts.size()));
  if (!whole && trade.ranked.empty()) throw interrupted;
  // A chart and a robot are of all layouts.
  if (whole && !o.svg.empty()) files::write(o.svg, layout_picture(trade));
  if (whole && !o.out.empty()) files::write(o.out, layout_robot_file(trade));
  if (o.json) {
    print_object(layout_json(trade),
                 {o.seed, name(o.planner), o.robot.empty() ? "reference" : o.robot,
                  robot_digest(trade.ranked.front().layout.robot), rules_name(o.planner)});
    return whole ? 0 : throw interrupted;
  }
  std::FILE* const out = words_beside({o.svg, o.out});
  fmt::print(out, "{}", layout_words(trade));
  if (!whole) throw interrupted;
  if (!o.svg.empty()) fmt::print(out, "chart: {}\n", o.svg);
  if (!o.out.empty()) fmt::print(out, "robot: {}\n", o.out);
  return 0;
}

constexpr const char* kFooter = R"(
Side angles 25 to 65 degrees in steps of 5, and the angle at which A + cone/2 + L = 95; offsets 0,
1/2 and 9/10 of the body's radius. Sorted, best first: walls seen, contacts, goals, time.
Exit status of robot layout: 0 a layout was found, 130 interrupted, 2 bad input or usage,
1 anything else.)";

}  // namespace

void add_robot_layout(CLI::App& robot, int& status) {
  CLI::App* cmd = robot.add_subcommand("layout", "Find where to mount three rangefinders of a kind");
  const auto o = std::make_shared<LayoutOptions>();
  add_name(*cmd, "--sensor", o->sensor, "Sensor model, as in [sensor] of a scenario: hc-sr04, vl53l1x, ...")
      ->required()
      ->type_name("NAME");
  amount(cmd->add_option("--body", o->body, "Radius of the body in m; the robot's lengths scale with it"),
         "R", kLargestBody);
  amount(cmd->add_option("--clear", o->clear, "Readings clear ground up to M m, where the cone is wider"),
         "M", kFarthestClear);
  add_file(*cmd, "--robot", o->robot, "The rest of your robot (TOML)");
  amount(cmd->add_option("--angles", o->angles, "Only these side angles, in degrees"), "A", kLargestAngle);
  whole_number(cmd->add_option("--count", o->count,
                               "Missions of a layout in each of four kinds of world; 5 by default"),
               "N", kMostOfAKind);
  whole_number(cmd->add_option("--seed", o->seed, "Of the first world of each kind; 1 by default"), "S");
  add_planner(*cmd, o->planner);
  add_jobs(*cmd, o->campaign);
  add_file(*cmd, "--svg", o->svg, "Draw success and time over the side angle");
  add_switch(*cmd, "--json", o->json, "Print the trade as one JSON object and nothing else");
  add_file(*cmd, "--out", o->out, "Write the best layout as a robot file, with its [sensor]");
  cmd->footer(kFooter);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
