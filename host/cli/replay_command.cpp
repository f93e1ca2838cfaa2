#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "firmware/can/ids.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/hil/replay.hpp"

namespace whisker::cli {
namespace {

struct Options {
  std::string log;
  hil::ReplayOptions replay;
  bool json = false;
};

hil::ReplayResult replayed(const Options& o) {
  std::ifstream log(o.log);
  if (!log || log.peek() == std::ifstream::traits_type::eof()) {
    throw UsageError(fmt::format("{}: {}", o.log, log ? "is empty" : std::strerror(errno)));
  }
  try {
    return hil::replay(log, o.replay);
  } catch (const std::runtime_error& e) {
    throw UsageError(fmt::format("{}: {}", o.log, e.what()));
  }
}

void print_json(const hil::ReplayResult& r) {
  nlohmann::ordered_json json;
  json["same"] = r.difference.empty();
  json["robot"] = r.robot;
  json["frames"] = r.frames;
  json["damaged"] = r.damaged;
  json["missions"] = r.missions;
  json["steps"] = r.steps;
  json["compared"] = r.compared;
  json["unknown_sets"] = r.unknown;
  json["missing_answers"] = r.missing;
  json["hash"] = fmt::format("{:016x}", r.hash);
  json["difference"] = r.difference;
  fmt::print("{}\n", json.dump());
}

int execute(const Options& o) {
  const hil::ReplayResult r = replayed(o);
  if (r.compared == 0) throw UsageError(fmt::format("{}: no commands of a robot with their inputs", o.log));
  if (o.json) {
    print_json(r);
  } else {
    fmt::print("robot {}: {} steps in {} mission{}, {} answers compared, command hash {:016x}\n", r.robot,
               r.steps, r.missions, r.missions == 1 ? "" : "s", r.compared, r.hash);
    if (r.unknown > 0)
      fmt::print("{} answers are to input sets that the log does not have whole\n", r.unknown);
    fmt::print("{}\n", r.difference.empty() ? "the core gives the recorded commands" : r.difference);
  }
  return r.difference.empty() ? 0 : kFailure;
}

}  // namespace

void add_replay(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("replay", "Check that the core gives the commands of a recorded run");
  const auto o = std::make_shared<Options>();
  add_file(*cmd, "LOG", o->log, "As written by candump -L, or by --record")->required();
  cmd->add_option("--node", o->replay.robot, "Number of the robot; the first one in the log by default")
      ->check(CLI::Range(1, static_cast<int>(can::kRobots)))
      ->type_name("N");
  add_planner(*cmd, o->replay.planner);
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->footer("\nExit status of replay: 0 the same commands, 1 others, 2 bad input or usage.");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
