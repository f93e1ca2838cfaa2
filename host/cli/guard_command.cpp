#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/keys.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/contact.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/lab/guard/drive.hpp"
#include "host/lab/guard/operators.hpp"
#include "host/lab/guard/recorded.hpp"
#include "host/lab/guard/trace.hpp"
#include "host/lab/page/guard_recording.hpp"

namespace whisker::cli {
namespace {

constexpr double kMostSeconds = 3600;
constexpr double kMostVouched_m = 10;
constexpr double kStanding_mps = 1e-3;
constexpr std::uint64_t kShownEach = 1000;

struct GuardOptions {
  std::string file, robot, commands, hand = "perfect", trace, html;
  std::optional<std::uint64_t> seed;
  bool keys = false, bare = false, json = false;
  double time_s = 120, vouched_m = 0;
  const fuzzy::Bilinear::Table* table = nullptr;
};

int exit_status(guard::End end) {
  switch (end) {
    case guard::End::arrived:
    case guard::End::ended: return kReached;
    case guard::End::contact: return kContact;
    case guard::End::fault: return kFault;
    case guard::End::time: return kGaveUp;
  }
  return kFailure;
}

std::unique_ptr<guard::Operator> operator_of(const GuardOptions& o, const Scenario& s,
                                             const std::optional<Interrupt>& interrupt) {
  if (interrupt) return std::make_unique<Keys>(s.robot.wheels.max_speed.raw() * 1e-6, 1.5, *interrupt);
  if (!o.commands.empty()) return std::make_unique<guard::Recorded>(guard::load_commands(o.commands));
  auto hand = guard::make_operator(*guard::hand_named(o.hand), s, s.seed);
  if (!hand) throw UsageError(fmt::format("{}: no path with the margin of operator {}", o.file, o.hand));
  return hand;
}

std::string hand_words(const GuardOptions& o) {
  if (o.keys) return "the arrow keys";
  if (!o.commands.empty()) return o.commands == "-" ? "commands of a pipe" : "commands of " + o.commands;
  return o.hand + " operator";
}

void print(const guard::Result& r, std::FILE* out) {
  fmt::print(out,
             "{}{} after {:.2f} s and {:.2f} m; smallest gap {:.3f} m; {:.1f} % of the asked speed granted\n",
             name(r.end), r.end == guard::End::fault ? fmt::format(" {}", name(r.fault)) : "", r.time_s,
             r.path_m, r.min_clearance_m, r.granted * 100);
  for (int i = 0; i < kGuardReasons; ++i) {
    const auto ticks = r.reasons[static_cast<std::size_t>(i)];
    if (ticks != 0) fmt::print(out, "  {:<16} {} ticks\n", name(static_cast<GuardReason>(i)), ticks);
  }
}

int execute(const GuardOptions& o) {
  if (o.keys && !o.commands.empty()) throw UsageError("--keys and --commands: choose one");
  check_outputs({o.trace, o.html}, {o.file, o.robot, o.commands == "-" ? "" : o.commands}, o.json);
  Scenario scenario = load_scenario(o.file, o.robot);
  if (o.seed) scenario.seed = *o.seed;
  const std::string warning = start_warning(scenario);
  if (!warning.empty()) fmt::print(stderr, "whisker: {}\n", warning);
  load_event_tables(scenario, o.file);
  // A drive of keys cannot be repeated: a signal ends it as q does.
  std::optional<Interrupt> interrupt;
  if (o.keys) interrupt.emplace();
  auto hand = operator_of(o, scenario, interrupt);
  const auto* const keys = dynamic_cast<Keys*>(hand.get());
  const auto* const recorded = dynamic_cast<guard::Recorded*>(hand.get());
  bool stands = false;
  double now_s = 0;
  std::uint64_t ticks = 0;
  const double timeout_s = scenario.robot.guard.command_timeout.raw() * 1e-3;
  std::string rows = fmt::format("{}\n", guard::kTraceHeader);
  page::GuardRecording recording({scenario, hand_words(o), !o.bare, o.vouched_m});
  ProgressLine line;
  guard::Options options;
  options.guarded = !o.bare;
  options.time_s = o.time_s;
  options.vouched_m = o.vouched_m;
  options.table = o.table;
  options.until_goal = o.commands.empty();
  options.ended = [&] {
    if (recorded != nullptr) return stands && now_s > recorded->last_s() + timeout_s;
    return keys != nullptr && (keys->ended() || interrupt->noted());
  };
  options.watch = [&](const guard::Moment& m) {
    if (!o.trace.empty()) rows += guard::trace_row(m, scenario.robot.rangefinders) + "\n";
    if (!o.html.empty()) recording.add(m);
    now_s = m.t_s;
    stands = std::abs(m.v_left_mps) < kStanding_mps && std::abs(m.v_right_mps) < kStanding_mps;
    if (keys == nullptr && ++ticks % kShownEach == 0) {
      line.show(fmt::format("{:.0f} s of at most {:.0f} s, at {:.2f}, {:.2f} m", m.t_s, o.time_s, m.pose.at.x,
                            m.pose.at.y));
    }
    if (keys == nullptr || m.status == nullptr) return;
    line.show(fmt::format(
        "asked {:5.2f} m/s {:5.2f} rad/s, granted {:3.0f} % {:3.0f} %, {:<16} at {:.2f}, {:.2f} m",
        m.asked.forward_mps, m.asked.turning_radps, m.status->forward.raw() / 163.84,
        m.status->turning.raw() / 163.84, name(m.status->reason), m.pose.at.x, m.pose.at.y));
  };
  const guard::Result result = guard::drive(scenario, *hand, options);
  hand.reset();
  line.show("");
  if (!o.trace.empty()) files::write(o.trace, rows);
  if (!o.html.empty()) files::write(o.html, page::guard_page(recording.stored(result)));
  if (o.json) {
    print_object(
        guard::result_json(result),
        {scenario.seed, {}, robot_name(scenario.robot, o.robot, o.file), robot_digest(scenario.robot)});
  } else {
    std::FILE* const out = words_beside({o.trace, o.html});
    print(result, out);
    if (!o.html.empty()) fmt::print(out, "page: {}\n", o.html);
  }
  if (interrupt && interrupt->noted()) throw Interrupted(fmt::format(" after {:.2f} s", result.time_s));
  return exit_status(result.end);
}

}  // namespace

void add_guard(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("guard", "Drive the simulated robot yourself; the guard keeps it safe");
  const auto o = std::make_shared<GuardOptions>();
  add_file(*cmd, "SCENARIO", o->file, "Scenario file (TOML)")->required();
  add_file(*cmd, "--robot", o->robot, "Parameters of your robot (TOML), over those of the scenario");
  add_file(*cmd, "--commands", o->commands, "Commands from this CSV file, or - : t_s,v_mps,omega_radps");
  add_switch(*cmd, "--keys", o->keys, "Drive with the arrow keys, in real time; q ends");
  cmd->add_option("--operator", o->hand,
                  "Otherwise who commands: perfect (default), sloppy, blind, joystick\nor hostile")
      ->check(CLI::IsMember({"perfect", "sloppy", "blind", "joystick", "hostile"}))
      ->type_name("NAME");
  whole_number(cmd->add_option("--seed", o->seed, "Seed of noise and operator, instead of the scenario's"),
               "N");
  amount(
      cmd->add_option("--vouch", o->vouched_m, "You vouch for this radius around the start, m; 0 by default"),
      "R", kMostVouched_m);
  amount(cmd->add_option("--time", o->time_s, "Ends after this time, s; 120 by default"), "T", kMostSeconds);
  add_switch(*cmd, "--bare", o->bare, "Without the guard: the wheels do what is asked");
  add_assist_rules(*cmd, o->table);
  add_file(*cmd, "--trace", o->trace, "Write one CSV row per control tick");
  add_file(*cmd, "--html", o->html, "Write a replay of the drive: one page for a browser");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
