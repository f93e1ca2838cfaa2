#include <cstdio>
#include <memory>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/cli/bench_bus.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/live_view.hpp"
#include "host/cli/logged_run.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/harness/hil/candump.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/harness/run/make_record.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/lab/bench/bus_state.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kUsual_s = 60;

struct WatchOptions {
  BenchChoice bus;
  std::string file, robot;
  ViewChoice view;
  std::optional<double> for_s;
  double every_s = 1;
  bool json = false, nodes = false;
};

Json node_json(const BenchBus& bus, can::Party party) {
  if (!bus.alive(party)) return nullptr;
  const can::Heartbeat& beat = bus.survey().find(bus.robot(), party)->beat;
  return {{"state", can::word_in<can::kNodeStateWords>(static_cast<int>(beat.state))},
          {"errors", hil::error_names(beat.errors)}};
}

Json range_json(const std::optional<hal::RangeReading>& r) {
  if (!r) return nullptr;
  if (r->status == hal::RangeStatus::ok) return r->mm / 1000.0;
  return can::word_in<can::kRangeWords>(static_cast<int>(r->status));
}

/// null: has not been on the bus.
Json state_json(const BenchBus& bus, const bench::BusState& s) {
  Json json = {{"controller", node_json(bus, can::Party::controller)},
               {"base", node_json(bus, can::Party::base)},
               {"outcome", nullptr},
               {"state", nullptr},
               {"why", nullptr},
               {"fault", nullptr},
               {"guard", nullptr},
               {"wheel_mps", nullptr},
               {"counts", nullptr},
               {"range_m", Json::array()}};
  if (s.status) {
    json["outcome"] = can::word_in<can::kOutcomeWords>(static_cast<int>(s.status->outcome));
    json["state"] = planning::name(s.status->state);
    json["why"] = planning::name(s.status->why);
    json["fault"] = name(static_cast<Fault>(s.status->fault < kFaults ? s.status->fault : 0));
  }
  if (s.guard) {
    json["guard"] = {{"reason", can::kGuardReasonWords[s.guard->reason]},
                     {"armed", s.guard->armed != 0},
                     {"asked_mps", s.guard->asked_forward / 1e4},
                     {"asked_radps", s.guard->asked_turning / 1e3},
                     {"granted_forward", s.guard->granted_forward / 100.0},
                     {"granted_turning", s.guard->granted_turning / 100.0}};
  }
  if (s.command) {
    const bool drives = s.command->mode == can::DriveMode::drive;
    const auto mps = [&](std::int16_t x) { return drives ? x / 10000.0 : 0.0; };
    json["wheel_mps"] = {mps(s.command->speeds.left), mps(s.command->speeds.right)};
  }
  if (s.wheels && s.wheels->valid != 0) json["counts"] = {s.wheels->counts.left, s.wheels->counts.right};
  for (const auto& beam : s.beams) json["range_m"].push_back(range_json(beam));
  return json;
}

std::string words(const Json& j) {
  const auto text = [](const Json& x) {
    return x.is_null() ? std::string("-") : x.is_string() ? x.get<std::string>() : x.dump();
  };
  const auto node = [&](const Json& n) {
    if (n.is_null()) return std::string("-");
    const std::string errors = n["errors"];
    return text(n["state"]) + (errors.empty() ? "" : " (" + errors + ")");
  };
  const std::string guard =
      j["guard"].is_null()
          ? ""
          : fmt::format("; guard {}, granted {}, {}", text(j["guard"]["reason"]),
                        text(j["guard"]["granted_forward"]), text(j["guard"]["granted_turning"]));
  return fmt::format("controller {}, base {}; {}: {}, {}{}{}; wheels {} m/s; ranges {}",
                     node(j["controller"]), node(j["base"]), text(j["outcome"]), text(j["state"]),
                     text(j["why"]),
                     j["fault"].is_null() || j["fault"] == "none" ? "" : ", fault " + text(j["fault"]), guard,
                     text(j["wheel_mps"]), text(j["range_m"]));
}

/// What is worth a line at once.
std::string occasion(const Json& j) {
  std::string all;
  for (const char* key : {"controller", "base", "outcome", "state", "why", "fault"}) all += j[key].dump();
  if (!j["guard"].is_null()) all += j["guard"]["reason"].dump();
  return all;
}

/// Feeds a live page with what the bus carries.
class BusView {
 public:
  BusView(LiveView& view, const BenchBus& bus, const Params& params)
      : view_(view),
        run_(bus.name(), std::nullopt, false),
        seen_(bus.robot(), params,
              {[this](const can::Mission& m, const Params& p, bool heard) { begin(m, p, heard); },
               [this](const can::InputSet& set, const Status& status) { step(set, status); }}) {
    run_.begin({}, params);
    view_.feed().begin(run_.log().setting());
    view_.feed().say("waits for a tick of the robot");
    view_.start();
  }

  void on_frame(const hal::CanFrame& frame) { seen_.on_frame(frame); }
  void end() {
    if (!over_) view_.feed().end(run_.end().result());
    over_ = true;
  }

 private:
  void begin(const can::Mission& mission, const Params& params, bool heard) {
    over_ = false;
    run_.begin(mission, params);
    view_.feed().begin(run_.log().setting());
    view_.feed().say(heard ? "" : "start, goal and parameters are unknown: the mission began before");
  }
  void step(const can::InputSet& set, const Status& status) {
    if (over_) return;
    const TickRecord& record = run_.step(set, status, nullptr, nullptr);
    view_.feed().add({record, status.health, nullptr, nullptr});
    if (status.health.fault != Fault::none || verdict_of(status.decision.outcome)) end();
  }

  LiveView& view_;
  LoggedRun run_;
  bench::BusRun seen_;
  bool over_ = false;
};

int watch(const WatchOptions& o) {
  Params params;
  if (!o.robot.empty()) apply_robot_file(params, o.robot);
  const auto view = o.view.open();
  BenchBus bus(o.bus);
  bench::BusState state;
  const std::uint64_t start_us = bus.clock().now_us();
  std::uint64_t due_us = start_us;
  // Every node that is there has sent a heartbeat by then.
  const auto settle_us = static_cast<std::uint64_t>(BenchBus::kListen_s * 1e6);
  std::string last;
  const auto tell = [&] {
    const std::uint64_t now_us = bus.clock().now_us();
    Json json = state_json(bus, state);
    const std::string now = occasion(json);
    if (now == last && now_us < due_us) return false;
    const bool both = !json["controller"].is_null() && !json["base"].is_null();
    if (!both && now_us - start_us < settle_us) return false;
    if (state.frames == 0) return false;
    last = now;
    due_us = now_us + static_cast<std::uint64_t>(o.every_s * 1e6);
    json["t_s"] = static_cast<double>((now_us - start_us) / 1000) * 1e-3;
    fmt::print("{}\n",
               o.json ? json.dump() : fmt::format("{:8.3f} {}", json["t_s"].get<double>(), words(json)));
    std::fflush(stdout);
    return false;
  };
  std::optional<BusView> page;
  if (view) page.emplace(*view, bus, params);
  bus.listen(o.for_s.value_or(kUsual_s), tell, [&](const hal::CanFrame& frame) {
    state.on_frame(frame, bus.robot());
    if (page) page->on_frame(frame);
  });
  if (page) page->end();
  if (view) view->stay(bus.interrupt());
  if (!last.empty()) return 0;
  throw bench::NoAnswer(
      fmt::format("{}: robot {} was silent for {} s", bus.name(), bus.robot(), o.for_s.value_or(kUsual_s)));
}

int record(const WatchOptions& o) {
  check_outputs({o.file});
  BenchBus bus(o.bus);
  hil::Recorder recorder(o.file, o.bus.can.empty() ? "slcan" : bus.name());
  const double for_s = o.for_s.value_or(kUsual_s);
  std::uint64_t frames = 0;
  const auto note = [&](const hal::CanFrame& frame) {
    recorder.write(frame);
    ++frames;
  };
  try {
    bus.listen(for_s, nullptr, note);
  } catch (const bench::Interrupted&) {
    // Ctrl-C is the usual end of a record without --for.
  }
  recorder.close();
  if (frames == 0) throw bench::NoAnswer(fmt::format("{}: no frame in {} s", bus.name(), for_s));
  fmt::print(words_beside({o.file}), "{} frames: {}\n", frames, o.file);
  const std::uint32_t overrun = bus.port().counts().overrun;
  if (overrun > 0) fmt::print(stderr, "whisker: {}: frames were lost {} times\n", bus.name(), overrun);
  return overrun > 0 ? kFailure : 0;
}

int execute(const WatchOptions& o) {
  if (o.nodes) return list_nodes(o.bus, o.for_s.value_or(1), o.json);
  return o.file.empty() ? watch(o) : record(o);
}

}  // namespace

void add_bench_watch(CLI::App& bench, int& status) {
  CLI::App* cmd = bench.add_subcommand("watch", "Print what the robot does: a line at each change");
  const auto o = std::make_shared<WatchOptions>();
  add_bench_bus(*cmd, o->bus);
  amount(cmd->add_option("--for", o->for_s, "End after this time, s; 60 by default"), "S", BenchBus::kMost_s);
  amount(cmd->add_option("--every", o->every_s, "And a line after this time, s; 1 by default"), "S",
         BenchBus::kMost_s);
  add_file(*cmd, "--robot", o->robot, "Parameters of the robot (TOML), for the page");
  add_view(*cmd, o->view);
  add_switch(*cmd, "--json", o->json, "Print one JSON object a line");
  CLI::Option* const nodes =
      cmd->add_flag("--nodes", o->nodes, "List the nodes on the bus instead, after 1 s");
  add_file(
      *cmd, "--log", o->file,
      "Write all frames instead, as of candump -L, for whisker replay, until Ctrl-C; - for standard output")
      ->excludes(nodes)
      ->excludes("--json");
  cmd->callback([o, &status] { status = bench_status([&] { return execute(*o); }); });
}

}  // namespace whisker::cli
