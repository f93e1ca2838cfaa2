#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/apps/command_hash.hpp"
#include "firmware/can/ids.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/logged_run.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/hil/replay.hpp"
#include "host/harness/run/make_record.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/lab/page/page.hpp"
#include "host/lab/report/trace.hpp"

namespace whisker::cli {
namespace {

sim::Vec2 metres(const Vec& v) { return {v.x.raw() * 1e-6, v.y.raw() * 1e-6}; }

/// Differences of wrapping 24-bit counters.
std::int32_t change(std::uint32_t from, std::uint32_t to) {
  constexpr auto kHalf = static_cast<std::int32_t>(hal::kEncoderModulus / 2);
  const auto forward = static_cast<std::int32_t>((to - from) % hal::kEncoderModulus);
  return forward < kHalf ? forward : forward - 2 * kHalf;
}

struct ReplayOptions {
  std::string log;
  hil::ReplayOptions replay;
  std::string trace;  // "": none
  std::string html;   // "": none
  bool json = false;
};

hil::ReplayResult replayed(const ReplayOptions& o, const hil::ReplayOptions& replay) {
  std::ifstream log(o.log);
  if (!log || log.peek() == std::ifstream::traits_type::eof()) {
    throw UsageError(fmt::format("{}: {}", o.log, log ? "is empty" : std::strerror(errno)));
  }
  try {
    return hil::replay(log, o.log, replay);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw UsageError(fmt::format("{}: {}", o.log, e.what()));
  }
}

void print_json(const hil::ReplayResult& r, const Provenance& provenance) {
  nlohmann::ordered_json json;
  json["same"] = r.difference.empty();
  json["robot"] = r.robot;
  json["guard"] = r.guard;
  json["frames"] = r.frames;
  json["damaged"] = r.damaged;
  json["missions"] = r.missions;
  json["steps"] = r.steps;
  json["compared"] = r.compared;
  json["unknown_sets"] = r.unknown;
  json["missing_answers"] = r.missing;
  json["hash"] = fmt::format("{:016x}", r.hash);
  json["difference"] = r.difference;
  json["cut_line"] = r.cut;
  json["skipped"] = r.skipped;
  print_object(json.dump(), provenance);
}

int execute(const ReplayOptions& o) {
  check_outputs({o.trace, o.html}, {o.log}, o.json);
  const bool shown = !(o.trace.empty() && o.html.empty());
  LoggedRun run(o.log, o.replay.planner);
  Provenance provenance;
  provenance.planner = name(o.replay.planner);
  provenance.robot_name = o.log;
  hil::ReplayOptions replay = o.replay;
  replay.begins = [&](const can::Mission& mission, const Params& params) {
    provenance.robot_digest = robot_digest(params);
    run.begin(mission, params);
  };
  if (shown) {
    replay.stepped = [&run](const can::InputSet& set, const Status& status,
                            const perception::LocalGrid* local_grid,
                            const RecordingGuide* guide) { run.step(set, status, local_grid, guide); };
  }
  const hil::ReplayResult r = replayed(o, replay);
  if (r.cut > 0)
    fmt::print(stderr, "whisker: {}: line {}, the last, is cut off and left out\n", o.log, r.cut);
  std::string skipped;
  for (const auto& [kind, count] : r.skipped)
    skipped += fmt::format("{}{} {}", skipped.empty() ? "" : ", ", count, kind);
  if (!skipped.empty())
    fmt::print(stderr, "whisker: {}: frames that are not a robot's are left out: {}\n", o.log, skipped);
  if (r.compared == 0) throw UsageError(fmt::format("{}: no commands of a robot with their inputs", o.log));
  if (r.guard && shown) {
    throw UsageError(fmt::format("{}: the log of a guard node has no planner to show", o.log));
  }
  provenance.rules_digest = rules_name(r.planner);
  if (shown) {
    const RunLog& log = run.end();
    if (!o.trace.empty()) report::write_trace(o.trace, log);
    if (!o.html.empty())
      files::write(o.html, page::run_page(page::stored(log), controller_picture(r.planner)));
  }
  if (o.json) {
    print_json(r, provenance);
  } else {
    std::FILE* const out = words_beside({o.trace, o.html});
    fmt::print(out, "robot {}: {} steps in {} mission{}, {} answers compared, command hash {:016x}\n",
               r.robot, r.steps, r.missions, r.missions == 1 ? "" : "s", r.compared, r.hash);
    if (r.unknown > 0)
      fmt::print(out, "{} answers are to input sets that the log does not have whole\n", r.unknown);
    fmt::print(out, "{}\n",
               !r.difference.empty() ? r.difference
               : r.guard             ? "the guard gives the recorded commands"
                                     : "the core gives the recorded commands");
    if (!o.trace.empty()) fmt::print(out, "trace:   {}\n", o.trace);
    if (!o.html.empty()) fmt::print(out, "page:    {}\n", o.html);
  }
  return r.difference.empty() ? 0 : kFailure;
}

}  // namespace

void LoggedRun::begin(const can::Mission& mission, const Params& params) {
  Scenario scenario;
  scenario.name = name_;
  scenario.start = {metres(mission.start.at), radians(mission.start.heading)};
  scenario.goal = {metres(mission.goal.at), mission.goal.tolerance.raw() * 1e-6};
  scenario.robot = params;
  const std::uint64_t seed = scenario.seed;
  log_.emplace(RunSetting{std::move(scenario), planner_, seed, inside_});
  fault_ = Fault::none;
  outcome_ = planning::Outcome::none;
}

const TickRecord& LoggedRun::step(const can::InputSet& set, const Status& status,
                                  const perception::LocalGrid* local_grid, const RecordingGuide* guide) {
  const std::vector<TickRecord>& records = log_->ticks().records;
  if (records.empty()) first_tick_ = set.tick;
  const double period_s = set.period_ms * 1e-3;
  TickRecord r = make_record(status, guide, set.ranges, (set.tick - first_tick_) * period_s);
  r.x_m = r.est_x_m;
  r.y_m = r.est_y_m;
  r.heading_rad = r.est_heading_rad;
  r.inside = inside_;
  if (!records.empty() && set.counts_valid) {
    const double elapsed_s = r.t_s - records.back().t_s;
    const double metres_a_count = 1.0 / log_->setting().scenario.robot.wheels.counts_per_metre;
    r.v_left_mps = change(counts_.left, set.counts.left) * metres_a_count / elapsed_s;
    r.v_right_mps = change(counts_.right, set.counts.right) * metres_a_count / elapsed_s;
  }
  if (set.counts_valid) counts_ = set.counts;
  fault_ = status.health.fault;
  outcome_ = status.decision.outcome;
  log_->add({r, status.health, local_grid, guide});
  return records.back();
}

const RunLog& LoggedRun::end() {
  const std::vector<TickRecord>& records = log_->ticks().records;
  Scenario& scenario = log_->setting().scenario;
  RunResult result;
  if (fault_ != Fault::none) {
    result.verdict = Verdict::fault;
    result.detail = name(fault_);
  } else if (const auto verdict = verdict_of(outcome_)) {
    result.verdict = *verdict;
    result.detail = planning::name(records.back().why);
  } else {
    result.detail = "log_ends";
  }
  CommandHash hash;
  sim::Vec2 before = scenario.start.at;
  for (const TickRecord& r : records) {
    hash.add(r.command);
    const sim::Vec2 at{r.x_m, r.y_m};
    const sim::Vec2 step = at - before;
    result.path_m += std::sqrt(sim::dot(step, step));
    before = at;
  }
  const sim::Vec2 left = scenario.goal.at - before;
  result.final_distance_m = std::numeric_limits<double>::quiet_NaN();
  result.believed_distance_m = std::sqrt(sim::dot(left, left));
  result.min_clearance_m = kEmptyWorldClearance;
  if (!records.empty()) scenario.time_limit_s = records.back().t_s;
  result.time_s = scenario.time_limit_s;
  result.ticks = records.size();
  result.hash = hash.value();
  log_->end(std::move(result));
  return *log_;
}

void add_replay(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("replay", "Check that the core gives the commands of a recorded run");
  const auto o = std::make_shared<ReplayOptions>();
  add_file(*cmd, "LOG", o->log, "As written by candump -L, or by --record")->required();
  within(
      cmd->add_option("--node", o->replay.robot, "Number of the robot; the first one in the log by default"),
      "N", 1, static_cast<int>(can::kRobots));
  add_planner(*cmd, o->replay.planner);
  add_file(*cmd, "--trace", o->trace, "Write the last mission as CSV; the true pose is the estimate");
  add_file(*cmd, "--html", o->html, "Write the last mission as a page for a browser, without the world");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->footer("\nExit status of replay: 0 the same commands, 1 others, 2 bad input or usage.");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
