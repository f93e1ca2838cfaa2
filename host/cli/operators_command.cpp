#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/campaign_options.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/harness/worlds/meeting.hpp"
#include "host/lab/campaign/meeting.hpp"
#include "host/lab/guard/campaign.hpp"

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
                             double speed_mps, ProgressLine& line, const Interrupt& interrupt) {
  campaign::MeetingCount count;
  for (std::uint64_t i = 0; i < o.count && !interrupt.noted(); ++i) {
    const Scenario scenario = campaign::timed_meeting(course, speed_mps, o.seed + i, own, o.planner);
    const campaign::Meeting meeting = campaign::meet(scenario, o.planner);
    count.add(meeting);
    if (!o.contacts.empty() && meeting.verdict == Verdict::contact) {
      const std::string file = fmt::format("{}_{}.toml", scenario.name, kind(meeting));
      files::write((std::filesystem::path(o.contacts) / file).string(), to_toml(scenario));
    }
    if (i % 10 == 0) line.show(fmt::format("{} {:.2f} m/s: {} of {}", name(course), speed_mps, i, o.count));
  }
  return count;
}

int execute(const MoversOptions& o) {
  check_seeds(o.count, o.seed);
  std::error_code error;
  if (!o.contacts.empty() && !std::filesystem::is_directory(o.contacts, error)) {
    throw UsageError(fmt::format("--contacts {}: no such folder", o.contacts));
  }
  Scenario own;
  if (!o.robot.empty()) apply_robot_file(own, o.robot);
  bend_if_chosen(own.robot, o.planner);
  fmt::print("| course | m/s | missions | reached | said so | contacts | moving | shown | seen in time |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  const Interrupt interrupt;
  ProgressLine line;
  for (const worlds::Course course : worlds::kCourses) {
    for (const double speed_mps : kSpeeds) {
      const campaign::MeetingCount c = drive(o, own, course, speed_mps, line, interrupt);
      line.show("");
      if (interrupt.noted()) throw Interrupted(fmt::format(" in {} at {:.2f} m/s", name(course), speed_mps));
      fmt::print("| {} | {:.2f} | {} | {} | {} | {} | {} | {} | {} |\n", name(course), speed_mps, c.missions,
                 c.reached, c.said, c.contacts, c.moving, c.shown, c.seen);
    }
  }
  return 0;
}

constexpr std::uint64_t kMostDrives = 1000000;

struct OperatorsOptions {
  std::uint64_t count = 60;
  std::uint64_t seed = 1;
  std::string robot, hand;
  std::uint64_t hostile = 0;
  bool noise = false;
  const fuzzy::Bilinear::Table* table = nullptr;
};

Params robot_of(const OperatorsOptions& o) {
  Params robot;
  if (!o.robot.empty()) apply_robot_file(robot, o.robot);
  return robot;
}

std::string row(const guard::Plan& plan, const guard::Summary& s) {
  const std::string arrived =
      guard::arrives(plan.hand) || plan.hand == guard::Hand::blind ? fmt::format("{}", s.arrived) : "-";
  return fmt::format("| {} | {} | {} | {} | {} | {} | {:.3f} | {:.0f} % | {:.2f} |", name(plan.hand),
                     plan.ground.name, plan.mode.name, s.drives, arrived, s.contacts, s.speed_mps(),
                     s.mean_granted() * 100, s.path_m > 0 ? static_cast<double>(s.stops) / s.path_m : 0.0);
}

void drive_operators(const OperatorsOptions& o, const Interrupt& interrupt) {
  fmt::print("| operator | worlds | mode | drives | arrived | contacts | m/s | granted | stops/m |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  ProgressLine line;
  for (const guard::Hand hand : guard::kHands) {
    if (!o.hand.empty() && o.hand != name(hand)) continue;
    for (const guard::Ground& ground : guard::kGrounds) {
      for (const guard::Mode& mode : guard::kModes) {
        const guard::Plan plan{hand, ground, mode, robot_of(o), o.noise, o.seed, o.count, o.table};
        const guard::Summary summary = guard::drive_many(plan, [&](std::uint64_t i) {
          if (i % 10 == 0) line.show(fmt::format("{}, {}, {}: {}", name(hand), ground.name, mode.name, i));
          return !interrupt.noted();
        });
        line.show("");
        if (interrupt.noted()) return;
        fmt::print("{}\n", row(plan, summary));
      }
    }
  }
}

void drive_hostile(const OperatorsOptions& o, const Interrupt& interrupt) {
  const Params robot = robot_of(o);
  guard::Summary summary;
  ProgressLine line;
  for (std::uint64_t i = 0; i < o.hostile && !interrupt.noted(); ++i) {
    const guard::Result result = guard::hostile_drive(o.seed + i, o.noise, robot, o.table);
    summary.add(result);
    if (result.end == guard::End::contact) {
      line.show("");
      fmt::print("contact: seed {} at {:.2f} s\n", o.seed + i, result.time_s);
    }
    if (i % 50 == 0) line.show(fmt::format("hostile: {} of {}", i, o.hostile));
  }
  line.show("");
  fmt::print(
      "{} hostile drives of 20 s{}, seeds from {}: {} contacts, {} faults, {:.0f} m, smallest gap {:.4f} m\n",
      summary.drives, o.noise ? " with noise" : "", o.seed, summary.contacts, summary.faults, summary.path_m,
      summary.min_clearance_m);
}

int execute(const OperatorsOptions& o) {
  if (o.seed > INT64_MAX / 2 - kMostDrives) throw UsageError("--seed: seeds must be below 2^62");
  const Interrupt interrupt;
  if (o.hostile > 0) {
    drive_hostile(o, interrupt);
  } else {
    drive_operators(o, interrupt);
  }
  if (interrupt.noted()) throw Interrupted("");
  return 0;
}

}  // namespace

void add_movers(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("movers", "Drive past things that move and count what is touched");
  const auto o = std::make_shared<MoversOptions>();
  whole_number(cmd->add_option("--count", o->count, "How many missions a course and speed; 200 by default"),
               "N", kMostMeetings);
  whole_number(cmd->add_option("--seed", o->seed, "Mission i has seed S + i; 1 by default"), "S");
  add_planner(*cmd, o->planner);
  add_file(*cmd, "--robot", o->robot, "Parameters of your robot (TOML)");
  add_file(*cmd, "--contacts", o->contacts, "Write the scenario of each contact into this folder")
      ->type_name("FOLDER");
  cmd->callback([o, &status] { status = execute(*o); });
}

void add_operators(CLI::App& app, int& status) {
  CLI::App* cmd =
      app.add_subcommand("operators", "Let operators of all kinds drive, with the guard and without it");
  const auto o = std::make_shared<OperatorsOptions>();
  how_many(cmd->add_option("--count", o->count, "How many worlds a row; 60 by default"), "N", kMostDrives);
  whole_number(cmd->add_option("--seed", o->seed, "Drive i has seed S + i; 1 by default"), "S");
  cmd->add_option("--operator", o->hand, "Only this one: perfect, sloppy, blind, joystick or hostile")
      ->check(CLI::IsMember({"perfect", "sloppy", "blind", "joystick", "hostile"}))
      ->type_name("NAME");
  how_many(cmd->add_option("--hostile", o->hostile,
                           "Instead: this many drives of the adversary in worlds of all kinds"),
           "N", kMostDrives);
  add_switch(*cmd, "--noise", o->noise, "With the reference robot's sensor and odometry noise");
  add_file(*cmd, "--robot", o->robot, "Parameters of your robot (TOML)");
  add_assist_rules(*cmd, o->table);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
