#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/can/table_hash.hpp"
#include "firmware/planning/planner.hpp"
#include "host/cli/bench_bus.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/keys.hpp"
#include "host/cli/live_view.hpp"
#include "host/cli/logged_run.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/harness/hil/overheard.hpp"
#include "host/harness/hil/planners.hpp"
#include "host/harness/run/make_record.hpp"
#include "host/lab/bench/operator_client.hpp"
#include "host/lab/guard/operator.hpp"
#include "host/lab/guard/recorded.hpp"
#include "host/lab/report/result.hpp"

namespace whisker::cli {
namespace {

struct HandDrive {
  guard::Operator& hand;
  std::function<bool(double t_s)> done;  ///< the hand has no more to ask
  double vouched_m = 0;
  double for_s = 600;
  bool shown = false;  ///< a line on the terminal says what is granted
  bool json = false;
};

void print(Verdict verdict, const std::string& detail, double time_s, bool json) {
  if (json) {
    const nlohmann::ordered_json result = {
        {"outcome", report::outcome(verdict)}, {"detail", detail}, {"time_s", time_s}};
    print_object(result.dump());
  } else {
    fmt::print("{} ({}) by its own estimate, after {:.1f} s\n", report::outcome(verdict), detail, time_s);
  }
}

/// Orders the goal as an operator, and follows the drive. Returns the exit status. After for_s, and after an
/// interruption, it cancels. Throws bench::NoAnswer.
int drive_through(BenchBus& bus, const planning::Goal& goal, double for_s, bool json) {
  const auto client = bus.third_party();
  client->drive_to(goal);
  fmt::print(stderr, "robot {} on {}: drives\n", bus.robot(), bus.name());
  std::optional<can::NavStatus> told;
  while (!(told = client->ended())) {
    const bool interrupted = bus.interrupt().noted();
    if (interrupted || client->time_s() >= for_s) {
      client->cancel();
      if (interrupted) throw bench::Interrupted("interrupted");
      print(Verdict::gave_up, "time_limit", client->time_s(), json);
      return exit_status(Verdict::gave_up);
    }
    bus.clock().wait_a_ms();
  }
  const Status status = hil::status_of(*told);
  if (status.health.fault != Fault::none) {
    print(Verdict::fault, name(status.health.fault), client->time_s(), json);
    return exit_status(Verdict::fault);
  }
  const auto verdict = verdict_of(status.decision.outcome);
  if (!verdict) throw bench::NoAnswer("the goal was cancelled");
  print(*verdict, planning::name(status.decision.why), client->time_s(), json);
  return exit_status(*verdict);
}

class Drive {
 public:
  Drive(BenchBus& bus, const BenchChoice& choice, const HandDrive& drive)
      : bus_(bus),
        choice_(choice),
        drive_(drive),
        link_(bus.port(), bus.robot(), drive.hand, drive.vouched_m,
              static_cast<std::uint8_t>(choice.bus.identity().boot)) {}

  int run() {
    start_us_ = alive_us_ = bus_.clock().now_us();
    while (!poll()) bus_.clock().wait_a_ms();
    line_.show("");
    print();
    if (!failed() && bus_.interrupt().noted()) throw Interrupted("");
    return failed() ? kFault : 0;
  }

 private:
  const bench::SeenNode* node() const { return bus_.survey().find(bus_.robot(), can::Party::controller); }
  double since_s(std::uint64_t then_us) {
    return static_cast<double>(bus_.clock().now_us() - then_us) * 1e-6;
  }
  Fault fault() const {
    const auto& status = link_.seen().status;
    return status && status->fault < kFaults ? static_cast<Fault>(status->fault) : Fault::none;
  }
  bool failed() const { return link_.started() && fault() != Fault::none; }

  /// True: it is over.
  bool poll() {
    link_.poll(bus_.clock().now_us());
    check_table();
    if (link_.disturbed()) {
      throw bench::NoAnswer(fmt::format("{}: another operator drives robot {}", bus_.name(), bus_.robot()));
    }
    tell();
    const bool interrupted = bus_.interrupt().noted();
    if (interrupted && !link_.started()) throw bench::Interrupted("interrupted");
    const bool ends =
        interrupted || (link_.started() && drive_.done(link_.time_s())) || link_.time_s() >= drive_.for_s;
    if (ends) link_.end();
    if (failed() || (ends && link_.stands())) return true;
    check_patience();
    return false;
  }

  void check_table() {
    if (!node()->table_hash) return;
    if (*node()->table_hash != can::kTableHash) {
      throw bench::NoAnswer(fmt::format("{}: the guard node speaks with the table {:08x}, not {:08x}",
                                        bus_.name(), *node()->table_hash, can::kTableHash));
    }
    link_.trust_table();
  }

  std::string words() {
    if (!bus_.alive(can::Party::controller)) return "not heard";
    const can::Heartbeat& beat = node()->beat;
    switch (beat.state) {
      case can::NodeState::off_bus:
      case can::NodeState::waiting: return "waits for the base";
      case can::NodeState::ready: return "waits for the base's order";
      case can::NodeState::running: break;
      case can::NodeState::safe_stop: return "safe stop: " + hil::error_names(beat.errors);
      case can::NodeState::e_stopped: return "E-stop";
    }
    const auto& guard = link_.seen().guard;
    return guard && guard->armed != 0 ? "drives" : "waits until nothing is asked of it";
  }

  void tell() {
    std::string now = words();
    if (now != said_) fmt::print(stderr, "guard {} on {}: {}\n", bus_.robot(), bus_.name(), now);
    said_ = std::move(now);
    const auto& guard = link_.seen().guard;
    if (!drive_.shown || !link_.started() || !guard) return;
    line_.show(fmt::format("granted {:3} % {:3} %, {:<16}", guard->granted_forward, guard->granted_turning,
                           can::kGuardReasonWords[guard->reason]));
  }

  void check_patience() {
    const bool drove = link_.driven() != driven_;
    driven_ = link_.driven();
    const bool there = bus_.alive(can::Party::controller);
    // Who is held up sends no heartbeat in time, but what it drives is heard.
    const bool drives = said_ == "drives" || said_ == "not heard";
    if (drives ? drove : there && !link_.started()) alive_us_ = bus_.clock().now_us();
    double waited_s = since_s(alive_us_);
    if (!link_.started() && since_s(start_us_) >= drive_.for_s) waited_s = drive_.for_s;
    if (waited_s < choice_.timeout_s && waited_s < drive_.for_s) return;
    throw bench::NoAnswer(fmt::format("{}: the guard node of robot {}: {} for {:.3g} s", bus_.name(),
                                      bus_.robot(), said_, waited_s));
  }

  void print() const {
    if (drive_.json) {
      const nlohmann::ordered_json json = {{"outcome", failed() ? "fault" : "ended"},
                                           {"fault", name(fault())},
                                           {"time_s", link_.time_s()},
                                           {"pose", nullptr}};
      print_object(json.dump());
      return;
    }
    fmt::print("{} after {:.2f} s, through the guard node\n",
               failed() ? fmt::format("fault {}", name(fault())) : "ended", link_.time_s());
  }

  BenchBus& bus_;
  const BenchChoice& choice_;
  const HandDrive& drive_;
  bench::OperatorLink link_;
  ProgressLine line_;
  std::string said_;
  std::uint64_t start_us_ = 0, alive_us_ = 0, driven_ = 0;
};

/// Returns the exit status. Throws bench::NoAnswer if the guard node has another table, another operator
/// sends, or the robot may not drive for longer than the time-out once it has driven.
int operate(BenchBus& bus, const BenchChoice& choice, const HandDrive& drive) {
  return Drive(bus, choice, drive).run();
}

constexpr double kFarthest_m = 1000;

struct SeatOptions {
  BenchChoice bus;
  double x_m = 0, y_m = 0, tolerance_m = 0.1, for_s = 600;
  PlannerKind planner = kDefaultPlanner;
  ViewChoice view;
  std::string commands;
  double speed_mps = 0.3, turn_radps = 1.5, vouched_m = 0;
  bool keys = false, json = false;
  bool own_core = false;  ///< an option chooses what the core on this computer does
};

planning::Goal goal_of(const SeatOptions& o) {
  const auto um = [](double m) { return Length::from_raw(static_cast<std::int32_t>(std::lround(m * 1e6))); };
  return {{um(o.x_m), um(o.y_m)}, um(o.tolerance_m)};
}

int goal(const SeatOptions& o) {
  if (!(std::fabs(o.x_m) <= kFarthest_m && std::fabs(o.y_m) <= kFarthest_m)) {
    throw UsageError(fmt::format("bench goal: at most {} m from the origin", kFarthest_m));
  }
  if (!(o.tolerance_m > 0)) throw UsageError("bench goal: --tolerance must be above 0");
  const auto view = o.view.open(o.planner);
  BenchBus bus(o.bus);
  bus.meet();
  if (bus.has(can::Party::controller) && bus.has(can::Party::base)) {
    if (o.own_core) {
      throw UsageError(
          "bench goal: the robot's own controller drives it: no --planner, --rules or --view (bench watch "
          "has one)");
    }
    return drive_through(bus, goal_of(o), o.for_s, o.json);
  }
  check_place(bus, o.bus);
  hil::RecordingPlanners planners(o.planner);
  LoggedRun run(bus.name(), o.planner);
  can::Identity identity = o.bus.bus.identity();
  identity.rules = rules_digest(o.planner);
  if (view) view->start();
  bench::GoalSeat::Listener listener;
  listener.begins = [&](const can::Mission& mission, const Params& params) {
    run.begin(mission, params);
    if (view) view->feed().begin(run.log().setting());
  };
  listener.stepped = [&](const can::InputSet& set, const Status& status) {
    const TickRecord& record = run.step(set, status, planners.local_grid(), planners.guide());
    if (view) view->feed().add({record, status.health, planners.local_grid(), planners.guide()});
  };
  bench::GoalSeat seat(bus.port(), identity, planners, goal_of(o), listener);
  const auto over = [&] {
    const Status& s = seat.status();
    return s.health.fault != Fault::none || verdict_of(s.decision.outcome).has_value();
  };
  sit(bus, o.bus, seat, o.for_s, over, [&] { return bus.interrupt().noted(); });
  RunResult result = run.end().result();
  if (view) view->feed().end(result);
  result.min_clearance_m = std::numeric_limits<double>::quiet_NaN();  // unknown
  if (o.json) {
    print_object(
        report::result_json(result, ""),
        {{}, name(o.planner), {}, robot_digest(run.log().setting().scenario.robot), rules_name(o.planner)});
  } else {
    fmt::print("{}{} by its own estimate, after {:.1f} s and {:.2f} m, {:.3f} m from the goal\n",
               report::outcome(result.verdict), result.detail.empty() ? "" : " (" + result.detail + ")",
               result.time_s, result.path_m, *result.believed_distance_m);
  }
  if (view) view->stay(bus.interrupt());
  return exit_status(result.verdict);
}

/// Listens until it is known who is there. Throws bench::NoAnswer if the guard node has an operator.
bool has_guard_node(BenchBus& bus, double timeout_s) {
  bool taken = false;
  const auto hear = [&](const hal::CanFrame& frame) {
    taken = taken || bench::from_operator(frame, bus.robot());
  };
  const auto guards = [&] {
    const bench::SeenNode* const node = bus.survey().find(bus.robot(), can::Party::controller);
    return node != nullptr && node->guards;
  };
  const auto anyone = [&] { return bus.has(can::Party::controller) || bus.has(can::Party::base); };
  bus.meet(hear);
  bus.listen(timeout_s, anyone, hear);
  // A node that has just come has a heartbeat first.
  if (bus.has(can::Party::controller)) bus.listen(BenchBus::kListen_s, guards, hear);
  if (!guards()) return false;
  if (!taken) return true;
  throw bench::NoAnswer(fmt::format("{}: another operator drives robot {}", bus.name(), bus.robot()));
}

int drive(const SeatOptions& o) {
  if (o.keys != o.commands.empty()) throw UsageError("bench drive: choose --keys or --commands");
  std::unique_ptr<guard::Recorded> recorded;
  if (!o.keys) recorded = std::make_unique<guard::Recorded>(guard::load_commands(o.commands));
  BenchBus bus(o.bus);
  std::unique_ptr<Keys> keys;
  if (o.keys) keys = std::make_unique<Keys>(o.speed_mps, o.turn_radps, bus.interrupt());
  guard::Operator& hand = keys ? static_cast<guard::Operator&>(*keys) : *recorded;
  const auto done = [&](double t_s) { return keys ? keys->ended() : t_s > recorded->last_s(); };
  if (has_guard_node(bus, o.bus.timeout_s))
    return operate(bus, o.bus, {hand, done, o.vouched_m, o.for_s, o.keys, o.json});
  check_place(bus, o.bus);
  bench::GuardSeat seat(bus.port(), o.bus.bus.identity(), hand, o.vouched_m);
  ProgressLine line;
  const auto over = [&] {
    const GuardStatus& s = seat.status();
    const bool ends = done(seat.time_s()) || seat.time_s() >= o.for_s || bus.interrupt().noted();
    if (ends) seat.end();
    if (keys) {
      line.show(fmt::format("granted {:3.0f} % {:3.0f} %, {:<16} at {:.2f}, {:.2f} m",
                            s.forward.raw() / 163.84, s.turning.raw() / 163.84, name(s.reason),
                            s.pose.at.x.raw() * 1e-6, s.pose.at.y.raw() * 1e-6));
    }
    return s.health.fault != Fault::none || (ends && seat.stands());
  };
  const auto interrupted = [&] { return bus.interrupt().noted() && !seat.started(); };
  sit(bus, o.bus, seat, BenchBus::kMost_s, over, interrupted);
  line.show("");
  const GuardStatus& s = seat.status();
  const bool failed = s.health.fault != Fault::none;
  if (o.json) {
    const nlohmann::ordered_json json = {
        {"outcome", failed ? "fault" : "ended"},
        {"fault", name(s.health.fault)},
        {"time_s", seat.time_s()},
        {"pose", {{"x_m", s.pose.at.x.raw() / 1e6}, {"y_m", s.pose.at.y.raw() / 1e6}}}};
    print_object(json.dump());
  } else {
    fmt::print("{} after {:.2f} s, at {:.3f}, {:.3f} m by its own estimate\n",
               failed ? fmt::format("fault {}", name(s.health.fault)) : "ended", seat.time_s(),
               s.pose.at.x.raw() * 1e-6, s.pose.at.y.raw() * 1e-6);
  }
  if (!failed && bus.interrupt().noted()) throw Interrupted("");
  return failed ? kFault : 0;
}

}  // namespace

void add_bench_drive(CLI::App& bench, int& status) {
  const auto goes = std::make_shared<SeatOptions>();
  CLI::App* cmd = bench.add_subcommand(
      "goal", "Drive to a goal: the robot's controller, or where it has none, the core on this computer");
  cmd->add_option("X", goes->x_m, "Goal in the frame of the base's start, m")->required()->type_name("X");
  cmd->add_option("Y", goes->y_m, "The same")->required()->type_name("Y");
  add_bench_bus(*cmd, goes->bus);
  amount(cmd->add_option("--tolerance", goes->tolerance_m, "Reached within this distance, m; 0.1 by default"),
         "M", 10);
  amount(cmd->add_option("--for", goes->for_s, "End after this time, s; 600 by default"), "S",
         BenchBus::kMost_s);
  add_planner(*cmd, goes->planner);
  add_view(*cmd, goes->view);
  add_switch(*cmd, "--json", goes->json, "Print the result as one JSON object and nothing else");
  cmd->callback([cmd, o = goes, &status] {
    for (const char* const option : {"--planner", "--rules", "--view"}) o->own_core |= cmd->count(option) > 0;
    status = bench_status([&] { return goal(*o); });
  });

  const auto drives = std::make_shared<SeatOptions>();
  cmd = bench.add_subcommand("drive", "Drive a real base by hand; the guard on this computer keeps it safe");
  add_bench_bus(*cmd, drives->bus);
  add_switch(*cmd, "--keys", drives->keys, "With the arrow keys; q ends");
  add_file(*cmd, "--commands", drives->commands, "Commands from this CSV file, or - : t_s,v_mps,omega_radps");
  amount(cmd->add_option("--speed", drives->speed_mps, "Of the keys ahead, m/s; 0.3 by default"), "V", 3.2);
  amount(cmd->add_option("--turn", drives->turn_radps, "Of the keys aside, rad/s; 1.5 by default"), "W", 20);
  amount(cmd->add_option("--vouch", drives->vouched_m,
                         "You vouch for this radius around the start, m; 0 by default"),
         "R", 10);
  amount(cmd->add_option("--for", drives->for_s, "End after this time, s; 600 by default"), "S",
         BenchBus::kMost_s);
  add_switch(*cmd, "--json", drives->json, "Print the result as one JSON object and nothing else");
  cmd->callback([o = drives, &status] { status = bench_status([&] { return drive(*o); }); });
}

}  // namespace whisker::cli
