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
#include "host/cli/bench_commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/hil/error_names.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;

struct NodesOptions {
  BenchChoice bus;
  double for_s = 1;
  bool json = false;
};

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

int execute(const NodesOptions& o) {
  BenchBus bus(o.bus);
  bus.listen(o.for_s, nullptr);
  const std::uint64_t end_us = bus.clock().now_us() + static_cast<std::uint64_t>(o.bus.timeout_s * 1e6);
  while (any_unasked(bus) && bus.clock().now_us() < end_us) {
    ask_lone_nodes(bus);
    bus.listen(kAskAgain_s, [&] { return !any_unasked(bus); });
  }
  const std::uint64_t now_us = bus.clock().now_us();
  const auto& nodes = bus.survey().nodes();
  if (o.json) {
    Json json = {{"bus", bus.name()}, {"nodes", Json::array()}};
    for (const auto& [number, n] : nodes) json["nodes"].push_back(json_of(n, now_us));
    fmt::print("{}\n", with_provenance(json.dump(), {}));
  } else {
    for (const auto& [number, n] : nodes) fmt::print("{}\n", line_of(n, now_us));
  }
  if (nodes.empty())
    fmt::print(stderr, "whisker: {}: no node sent a heartbeat in {} s\n", bus.name(), o.for_s);
  return nodes.empty() ? kFailure : 0;
}

}  // namespace

void add_bench_nodes(CLI::App& bench, int& status) {
  CLI::App* cmd = bench.add_subcommand("nodes", "List the nodes on the bus");
  const auto o = std::make_shared<NodesOptions>();
  add_bench_line(*cmd, o->bus);
  cmd->add_option("--for", o->for_s, "Listen so long, s; 1 by default")
      ->transform(amount(3600))
      ->type_name("S");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->callback([o, &status] { status = bench_status([&] { return execute(*o); }); });
}

}  // namespace whisker::cli
