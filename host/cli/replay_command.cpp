#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/can/ids.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/logged_run.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/hil/replay.hpp"
#include "host/page/page.hpp"
#include "host/page/recording.hpp"
#include "host/report/file.hpp"
#include "host/report/trace.hpp"

namespace whisker::cli {
namespace {

struct ReplayOptions {
  std::string log;
  hil::ReplayOptions replay;
  std::string trace;  // "": none
  std::string html;   // "": none
  bool json = false;
};

/// The contents of the log's last mission.
class Show {
 public:
  explicit Show(const ReplayOptions& o) : run_(o.log) {}

  void watch(hil::ReplayOptions& replay) {
    replay.begins = [this](const can::Mission& mission, const Params& params) {
      run_.begin(mission, params);
      recording_.emplace(params);
    };
    replay.stepped = [this](const can::InputSet& set, const Status& status,
                            const perception::LocalGrid* local_grid, const RecordingGuide* guide) {
      recording_->add({run_.step(set, status, guide), status.health, local_grid, guide});
    };
  }

  void write(const ReplayOptions& o, PlannerKind planner) const {
    if (!o.trace.empty()) report::write_trace(o.trace, run_.scenario(), run_.records());
    if (o.html.empty()) return;
    const page::StoredRun stored =
        page::stored({run_.scenario(), planner, run_.scenario().seed}, recording_->ticks(), run_.result());
    report::write_file(o.html, page::run_page(stored, controller_picture(planner)));
  }

 private:
  LoggedRun run_;
  std::optional<page::Recording> recording_;
};

hil::ReplayResult replayed(const ReplayOptions& o, const hil::ReplayOptions& replay) {
  std::ifstream log(o.log);
  if (!log || log.peek() == std::ifstream::traits_type::eof()) {
    throw UsageError(fmt::format("{}: {}", o.log, log ? "is empty" : std::strerror(errno)));
  }
  try {
    return hil::replay(log, replay);
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
  fmt::print("{}\n", with_provenance(json.dump(), provenance));
}

int execute(const ReplayOptions& o) {
  check_outputs({o.trace, o.html}, {o.log}, o.json);
  Show show(o);
  hil::ReplayOptions replay = o.replay;
  if (!o.trace.empty() || !o.html.empty()) show.watch(replay);
  Provenance provenance;
  provenance.planner = name(o.replay.planner);
  provenance.robot_name = o.log;
  replay.begins = [&provenance, also = replay.begins](const can::Mission& mission, const Params& params) {
    provenance.robot_digest = robot_digest(params);
    if (also) also(mission, params);
  };
  const hil::ReplayResult r = replayed(o, replay);
  if (r.cut > 0)
    fmt::print(stderr, "whisker: {}: line {}, the last, is cut off and left out\n", o.log, r.cut);
  if (r.compared == 0) throw UsageError(fmt::format("{}: no commands of a robot with their inputs", o.log));
  if (r.guard && !(o.trace.empty() && o.html.empty())) {
    throw UsageError(fmt::format("{}: the log of a guard node has no planner to show", o.log));
  }
  provenance.rules_digest = rules_name(r.planner);
  show.write(o, r.planner);
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

void add_replay(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("replay", "Check that the core gives the commands of a recorded run");
  const auto o = std::make_shared<ReplayOptions>();
  add_file(*cmd, "LOG", o->log, "As written by candump -L, or by --record")->required();
  cmd->add_option("--node", o->replay.robot, "Number of the robot; the first one in the log by default")
      ->check(CLI::Range(1, static_cast<int>(can::kRobots)))
      ->type_name("N");
  add_planner(*cmd, o->replay.planner);
  add_file(*cmd, "--trace", o->trace, "Write the last mission as CSV; the true pose is the estimate");
  add_file(*cmd, "--html", o->html, "Write the last mission as a page for a browser, without the world");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->footer("\nExit status of replay: 0 the same commands, 1 others, 2 bad input or usage.");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
