#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/params/relations.hpp"
#include "host/campaign/layouts.hpp"
#include "host/campaign/mission.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/layout_output.hpp"
#include "host/cli/many_runs.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/report/file.hpp"
#include "host/scenario/load.hpp"
#include "host/scenario/params_text.hpp"
#include "host/scenario/sensor_models.hpp"

namespace whisker::cli {
namespace {

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
  throw UsageError(fmt::format("--sensor: no sensor model '{}'{}", o.sensor, did_you_mean(o.sensor, names)));
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
  if (!whole) {
    fmt::print(stderr, "whisker: interrupted after {} of {} layouts\n", t.ranked.size(),
               t.grid.layouts.size());
    return false;
  }
  campaign::rank(t.ranked);
  return true;
}

int execute(const LayoutOptions& o) {
  check_outputs({o.svg, o.out}, {o.robot}, o.json);
  if (o.count == 0) throw UsageError("--count 0: nothing to do");
  if (o.seed > INT64_MAX - o.count) throw UsageError("--seed and --count: seeds must be below 2^63");
  LayoutTrade trade = trade_of(o);
  if (!drive_all(o, trade)) return kInterrupted;
  if (!o.svg.empty()) report::write_file(o.svg, layout_picture(trade));
  if (!o.out.empty()) report::write_file(o.out, layout_robot_file(trade));
  if (o.json) {
    Provenance p;
    p.seed = o.seed;
    p.planner = name(o.planner);
    p.rules_digest = rules_name(o.planner);
    p.robot_name = o.robot.empty() ? "reference" : o.robot;
    p.robot_digest = robot_digest(trade.ranked.front().layout.robot);
    fmt::print("{}\n", with_provenance(layout_json(trade), p));
    return 0;
  }
  std::FILE* const out = words_beside({o.svg, o.out});
  fmt::print(out, "{}", layout_words(trade));
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
  cmd->add_option("--body", o->body, "Radius of the body in m; the robot's lengths scale with it")
      ->transform(amount(kLargestBody))
      ->type_name("R");
  cmd->add_option("--clear", o->clear, "Readings clear ground up to M m, where the cone is wider")
      ->transform(amount(kFarthestClear))
      ->type_name("M");
  add_file(*cmd, "--robot", o->robot, "The rest of your robot (TOML)");
  cmd->add_option("--angles", o->angles, "Only these side angles, in degrees")
      ->transform(amount(kLargestAngle))
      ->type_name("A");
  cmd->add_option("--count", o->count, "Missions of a layout in each of four kinds of world; 5 by default")
      ->transform(whole_number(kMostOfAKind))
      ->type_name("N");
  cmd->add_option("--seed", o->seed, "Of the first world of each kind; 1 by default")
      ->transform(whole_number())
      ->type_name("S");
  add_planner(*cmd, o->planner);
  add_jobs(*cmd, o->campaign);
  add_file(*cmd, "--svg", o->svg, "Draw success and time over the side angle");
  add_switch(*cmd, "--json", o->json, "Print the trade as one JSON object and nothing else");
  add_file(*cmd, "--out", o->out, "Write the best layout as a robot file, with its [sensor]");
  cmd->footer(kFooter);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
