#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/fuzzy/digest.hpp"
#include "host/cli/bench_bus.hpp"
#include "host/cli/bench_commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;

struct RulesOptions {
  BenchChoice bus;
  std::string file;
  std::vector<std::string> names;
  bool restore = false, json = false;
};

/// Why the controller did not activate the table.
std::string reason(can::RulesStatus status) {
  switch (status) {
    case can::RulesStatus::running: return "a mission runs: cancel it first; its response table is unchanged";
    case can::RulesStatus::moving: return "the wheels turn; its response table is unchanged";
    case can::RulesStatus::unsupported: return "it takes no table; its response table is unchanged";
    // With room for one table only, it drives with the built-in one now.
    case can::RulesStatus::wrong_hash: return "the table arrived damaged; send it again";
    case can::RulesStatus::receiving:
    case can::RulesStatus::activated:
    case can::RulesStatus::incomplete: break;
  }
  return "the table is incomplete";
}

can::RulesReply send(const RulesOptions& o, bench::BaseClient& client, const fuzzy::Bilinear::Table* table) {
  const can::RulesReply reply = client.send_rules(o.restore ? nullptr : table);
  if (reply.status == can::RulesStatus::activated) return reply;
  throw bench::NoAnswer(fmt::format("the controller says {}: {}",
                                    can::word_in<can::kRulesStatusWords>(static_cast<int>(reply.status)),
                                    reason(reply.status)));
}

int execute(const RulesOptions& o) {
  if (o.restore && !o.file.empty()) throw UsageError("bench rules: a file, or --restore");
  if (o.file.empty() && !o.names.empty()) throw UsageError("--map needs a file");
  const fuzzy::Bilinear::Table* const table = o.file.empty() ? nullptr : response_table(o.file, o.names);
  BenchBus bus(o.bus);
  const auto client = bus.base();
  const bool sends = o.restore || table != nullptr;
  const auto before = client->rules();
  can::RulesReply reply;
  if (sends) reply = send(o, *client, table);
  const auto now = sends ? client->rules() : before;
  const auto text = [](std::optional<std::uint32_t> hash) {
    return hash ? fmt::format("{:08x}", *hash) : "none";
  };
  if (o.json) {
    Json json = {{"bus", bus.name()}, {"robot", bus.robot()}, {"rules_hash", text(now)}};
    if (!now) json["rules_hash"] = nullptr;
    if (sends) json["kept"] = reply.kept != 0;
    fmt::print("{}\n", with_provenance(json.dump(), {}));
  } else if (sends) {
    fmt::print("response table: {} -> {}, {}\n", text(before), text(now),
               reply.kept != 0 ? "kept for the next start" : "until the controller restarts");
  } else {
    fmt::print("response table: {}\n", text(now));
  }
  return 0;
}

}  // namespace

void add_bench_rules(CLI::App& bench, int& status) {
  const auto o = std::make_shared<RulesOptions>();
  CLI::App* cmd = bench.add_subcommand(
      "rules", "Name the response table of the controller, or send it another one from a rule base");
  add_bench_bus(*cmd, o->bus);
  add_file(*cmd, "FILE", o->file,
           "Rule base (.fis, .fll, .fcl, .toml) with\ninputs D and R, outputs SA and SD");
  add_map_names(*cmd, o->names, "The file's name of D, R, SA or SD; may be repeated");
  add_switch(*cmd, "--restore", o->restore, "Drive with the controller's built-in table again");
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object and nothing else");
  cmd->callback([o, &status] { status = bench_status([&] { return execute(*o); }); });
}

}  // namespace whisker::cli
