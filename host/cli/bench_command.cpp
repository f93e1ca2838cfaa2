#include <algorithm>
#include <ctime>
#include <memory>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/can/codec.hpp"
#include "firmware/can/table_hash.hpp"
#include "host/cli/bench_bus.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/lab/bench/param_client.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;

const char* role(const bench::SeenNode& n) {
  return n.party == can::Party::base ? "base" : n.guards ? "guard" : "controller";
}

double age_s(const bench::SeenNode& n, std::uint64_t now_us) {
  return static_cast<double>(now_us - n.heard_us) * 1e-6;
}

constexpr double kAskAgain_s = 0.2;

/// It has sent no Info, and none will come unless it is asked for.
bool unasked(const bench::SeenNode& n, BenchBus& bus) {
  const bool partner = bus.survey().find(n.robot, can::other(n.party)) != nullptr;
  return !partner && !(n.table_hash && n.version);
}

bool any_unasked(BenchBus& bus) {
  const auto& nodes = bus.survey().nodes();
  return std::any_of(nodes.begin(), nodes.end(), [&](const auto& n) { return unasked(n.second, bus); });
}

/// A node without a partner answers an InfoRequest in its partner's name, which is free. Two of them: a node
/// ignores the first if it repeats the counter of an earlier request.
void ask_lone_nodes(BenchBus& bus) {
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  const auto counter = static_cast<std::uint8_t>(t.tv_nsec / 1000 % can::kAliveModulus);
  for (const auto& [number, n] : bus.survey().nodes()) {
    if (!unasked(n, bus) || n.matches()) continue;
    const can::Party partner = can::other(n.party);
    for (std::uint8_t i = 0; i < 2; ++i) {
      const auto next = static_cast<std::uint8_t>((counter + i) % can::kAliveModulus);
      bus.send(can::encode(can::InfoRequest{}, can::node_of(n.robot, partner), next));
    }
  }
}

Json json_of(const bench::SeenNode& n, std::uint64_t now_us) {
  Json errors = Json::array();
  for (int bit = 0; bit < 16; ++bit) {
    if ((n.beat.errors >> bit & 1) != 0) errors.push_back(hil::error_names(std::uint16_t(1U << bit)));
  }
  const auto hex = [](const std::optional<std::uint32_t>& x) {
    return x ? Json(fmt::format("{:08x}", *x)) : Json(nullptr);
  };
  return {{"robot", n.robot},
          {"role", role(n)},
          {"node", n.node()},
          {"state", can::word_in<can::kNodeStateWords>(static_cast<int>(n.beat.state))},
          {"errors", errors},
          {"protocol", n.beat.protocol},
          {"table_hash", hex(n.table_hash)},
          {"same_table", n.table_hash ? Json(*n.table_hash == can::kTableHash) : Json(nullptr)},
          {"firmware", n.version ? Json(version_text(*n.version)) : Json(nullptr)},
          {"rules_hash", hex(n.rules)},
          {"boot", n.beat.boot},
          {"uptime_s", n.beat.uptime_s},
          {"age_s", age_s(n, now_us)}};
}

std::string line_of(const bench::SeenNode& n, std::uint64_t now_us) {
  const std::string errors = hil::error_names(n.beat.errors);
  return fmt::format(
      "robot {} {:<10} node {:<2}  {:<9}  protocol {}  table {:<8}  firmware {:<7}  boot {:04x}  up {:3} s  "
      "heard {:.2f} s ago{}",
      n.robot, role(n), n.node(), can::word_in<can::kNodeStateWords>(static_cast<int>(n.beat.state)),
      n.beat.protocol, n.table_hash ? fmt::format("{:08x}", *n.table_hash) : "unknown",
      n.version ? version_text(*n.version) : "unknown", n.beat.boot, n.beat.uptime_s, age_s(n, now_us),
      errors.empty() ? "" : ": " + errors);
}

struct OrderOptions {
  BenchChoice bus;
  bool clear = false, cancel = false;
};

/// Repeats the order until all nodes of the robot are e_stopped, or none.
int press(const OrderOptions& o, std::uint8_t command) {
  BenchBus bus(o.bus);
  const bool stop = command == can::kStopCommand;
  // A stop must not wait for anything.
  bus.listen(stop ? 0.001 : BenchBus::kListen_s, nullptr);
  for (double waited = 0; waited < o.bus.timeout_s; waited += BenchBus::kAgain_s) {
    bus.order(command);
    bus.listen(BenchBus::kAgain_s, nullptr);
    const auto [stopped, all] = bus.stopped_of_all();
    if (all == 0 || stopped != (stop ? all : 0)) continue;
    // Their heartbeats from before have passed.
    bus.listen(BenchBus::kAgain_s, nullptr);
    if (bus.stopped_of_all() != std::pair(stopped, all)) continue;
    fmt::print("robot {}: {}\n", bus.robot(), stop ? "E-stop" : "the E-stop is cleared; it starts nothing");
    return 0;
  }
  const auto [stopped, all] = bus.stopped_of_all();
  if (all == 0) {
    throw bench::NoAnswer(fmt::format("{}: {}robot {} was silent for {} s", bus.name(),
                                      stop ? "the E-stop was sent, but " : "", bus.robot(), o.bus.timeout_s));
  }
  throw bench::NoAnswer(fmt::format("{}: {} of {} nodes of robot {} {} after {} s{}", bus.name(),
                                    stop ? all - stopped : stopped, all, bus.robot(),
                                    stop ? "did not stop" : "stay stopped", o.bus.timeout_s,
                                    stop ? "" : ": the wheels must stand"));
}

int cancel(const OrderOptions& o) {
  BenchBus bus(o.bus);
  bus.client()->cancel();
  fmt::print("robot {}: cancelled\n", bus.robot());
  return 0;
}

int execute(const OrderOptions& o) {
  return o.cancel ? cancel(o) : press(o, o.clear ? can::kClearCommand : can::kStopCommand);
}

}  // namespace

int list_nodes(const BenchChoice& choice, double for_s, bool json_wanted) {
  BenchBus bus(choice);
  bus.listen(for_s, nullptr);
  const std::uint64_t end_us = bus.clock().now_us() + static_cast<std::uint64_t>(choice.timeout_s * 1e6);
  while (any_unasked(bus) && bus.clock().now_us() < end_us) {
    ask_lone_nodes(bus);
    bus.listen(kAskAgain_s, [&] { return !any_unasked(bus); });
  }
  const std::uint64_t now_us = bus.clock().now_us();
  const auto& nodes = bus.survey().nodes();
  if (json_wanted) {
    Json json = {{"bus", bus.name()}, {"nodes", Json::array()}};
    for (const auto& [number, n] : nodes) json["nodes"].push_back(json_of(n, now_us));
    print_object(json.dump());
  } else {
    for (const auto& [number, n] : nodes) fmt::print("{}\n", line_of(n, now_us));
  }
  if (nodes.empty()) fmt::print(stderr, "whisker: {}: no node sent a heartbeat in {} s\n", bus.name(), for_s);
  return nodes.empty() ? kFailure : 0;
}

int bench_status(const std::function<int()>& run) {
  try {
    return run();
  } catch (const bench::Interrupted&) {
    throw Interrupted("");
  }
}

void add_bench(CLI::App& app, int& status) {
  CLI::App* bench = app.add_subcommand("bench", "Look at a real robot on its bus, and set its parameters");
  bench->require_subcommand(1);
  add_bench_watch(*bench, status);
  add_bench_params(*bench, status);
  add_bench_rules(*bench, status);
  add_bench_orders(*bench, status);
  add_bench_drive(*bench, status);
  add_bench_calibrate(*bench, status);
  add_bench_selftest(*bench, status);
  for (CLI::App* command : bench->get_subcommands({})) {
    command->footer(
        R"(Exit status of bench: 0 done, 2 bad input or usage, or a value that is refused, 130 interrupted,
1 no answer, or anything else.)");
  }
}

void add_bench_orders(CLI::App& bench, int& status) {
  CLI::App* cmd =
      bench.add_subcommand("stop", "E-stop of the robot: the wheels brake and stand until it is cleared");
  const auto o = std::make_shared<OrderOptions>();
  add_bench_bus(*cmd, o->bus);
  CLI::Option* const clear =
      cmd->add_flag("--clear", o->clear, "Clear the E-stop instead, once the wheels stand; starts nothing");
  cmd->add_flag("--cancel", o->cancel,
                "Only stop the mission and clear its goal; the robot's base may be on the bus")
      ->excludes(clear);
  cmd->callback([o, &status] { status = bench_status([&] { return execute(*o); }); });
}

}  // namespace whisker::cli
