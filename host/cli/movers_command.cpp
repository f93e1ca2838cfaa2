#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/campaign/meeting.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/report/file.hpp"
#include "host/scenario/load.hpp"
#include "host/scenario/write.hpp"
#include "host/worlds/meeting.hpp"

namespace whisker::cli {
namespace {

constexpr double kSpeeds[] = {0.05, 0.1, 0.2, 0.3};
constexpr std::uint64_t kMostMeetings = 1000000;

struct MoversOptions {
  std::uint64_t count = 200;
  std::uint64_t seed = 1;
  PlannerKind planner = kDefaultPlanner;
  std::string robot;
  std::string contacts;
};

const char* kind(const campaign::Meeting& contact) {
  campaign::MeetingCount count;
  count.add(contact);
  return count.seen > 0 ? "seen" : count.shown > 0 ? "shown" : count.moving > 0 ? "moving" : "standing";
}

/// own: a scenario with the robot, its sensors and its noise.
campaign::MeetingCount drive(const MoversOptions& o, const Scenario& own, worlds::Course course,
                             double speed_mps, ProgressLine& line) {
  campaign::MeetingCount count;
  for (std::uint64_t i = 0; i < o.count; ++i) {
    Scenario scenario = worlds::meeting(course, speed_mps, o.seed + i, own.robot);
    scenario.sensor = own.sensor;
    scenario.noise = own.noise;
    bend_if_chosen(scenario.robot, o.planner);
    const campaign::Meeting meeting = campaign::meet(scenario, o.planner);
    count.add(meeting);
    if (!o.contacts.empty() && meeting.verdict == Verdict::contact) {
      const std::string file = fmt::format("{}_{}.toml", scenario.name, kind(meeting));
      report::write_file((std::filesystem::path(o.contacts) / file).string(), to_toml(scenario));
    }
    if (i % 10 == 0) line.show(fmt::format("{} {:.2f} m/s: {} of {}", name(course), speed_mps, i, o.count));
  }
  return count;
}

int execute(const MoversOptions& o) {
  if (o.count == 0) throw UsageError("--count 0: nothing to do");
  if (o.seed > INT64_MAX - o.count) throw UsageError("--seed and --count: seeds must be below 2^63");
  std::error_code error;
  if (!o.contacts.empty() && !std::filesystem::is_directory(o.contacts, error)) {
    throw UsageError(fmt::format("--contacts {}: no such folder", o.contacts));
  }
  Scenario own;
  if (!o.robot.empty()) apply_robot_file(own, o.robot);
  fmt::print("| course | m/s | missions | reached | said so | contacts | moving | shown | seen in time |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  ProgressLine line;
  for (const worlds::Course course : worlds::kCourses) {
    for (const double speed_mps : kSpeeds) {
      const campaign::MeetingCount c = drive(o, own, course, speed_mps, line);
      line.show("");
      fmt::print("| {} | {:.2f} | {} | {} | {} | {} | {} | {} | {} |\n", name(course), speed_mps, c.missions,
                 c.reached, c.said, c.contacts, c.moving, c.shown, c.seen);
    }
  }
  return 0;
}

}  // namespace

void add_movers(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("movers", "Drive past things that move and count what is touched");
  const auto o = std::make_shared<MoversOptions>();
  cmd->add_option("--count", o->count, "How many missions a course and speed; 200 by default")
      ->transform(whole_number(kMostMeetings))
      ->type_name("N");
  cmd->add_option("--seed", o->seed, "Mission i has seed S + i; 1 by default")
      ->transform(whole_number())
      ->type_name("S");
  add_planner(*cmd, o->planner);
  add_file(*cmd, "--robot", o->robot, "Parameters of your robot (TOML)");
  add_file(*cmd, "--contacts", o->contacts, "Write the scenario of each contact into this folder")
      ->type_name("FOLDER");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
