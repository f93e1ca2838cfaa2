#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/fuzzy/digest.hpp"
#include "firmware/params/words.hpp"
#include "host/cli/bench_bus.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/reader.hpp"
#include "host/harness/scenario/violations.hpp"
#include "host/lab/bench/param_values.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

struct ParamOptions {
  BenchChoice bus;
  Names names;
  std::string file;
  bool all = false, json = false;
};

/// Passes errors in the words of a parameter on as errors of usage.
template <class F>
auto as_usage(const F& parse) {
  try {
    return parse();
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

/// Its index on the bus, and its key.
std::pair<int, const char*> name_of(std::size_t place) {
  static const std::vector<ParamEntry> list = param_list(Params{});
  return {list[place].number, list[place].key};
}

void take(Params& params, std::size_t place, bench::ParamClient& client) {
  const auto& [number, key] = name_of(place);
  const auto index = static_cast<std::uint8_t>(number);
  const auto raw = client.read(index);
  if (!raw) throw bench::NoAnswer(fmt::format("the controller has no parameter {}", key));
  if (!in_own_range(index, *raw)) throw bench::NoAnswer(fmt::format("{} has no valid value", key));
  set_raw_param(params, index, *raw);
}

}  // namespace

Params read_all(bench::ParamClient& client) {
  Params params;
  for (std::size_t i = 0; i < robot_keys().size(); ++i) take(params, i, client);
  return params;
}

namespace {

Json value_json(const ParamEntry& e, std::int64_t raw) {
  if (e.boolean) return raw != 0;
  const std::string text = e.word != nullptr ? bench::value_text(e, raw) : e.text_of(raw);
  return e.word != nullptr ? Json(text) : Json::parse(text);
}

Json entry_json(const ParamEntry& e, std::size_t place) {
  Json json = {{"name", e.key}, {"value", value_json(e, e.raw)}, {"unit", e.unit.symbol}};
  if (e.word == nullptr) {
    json["low"] = value_json(e, e.low);
    json["high"] = value_json(e, e.high);
  } else {
    json["words"] = bench::words_of(place);
  }
  json["default"] = value_json(e, param_list(Params{})[place].raw);
  json["index"] = e.number;
  json["raw"] = e.raw;
  return json;
}

int save(const ParamOptions& o) {
  check_outputs({o.file});
  BenchBus bus(o.bus);
  const auto client = bus.client();
  const Params params = read_all(*client);
  const bench::SeenNode* const node = bus.survey().find(bus.robot(), can::Party::controller);
  const std::uint32_t v = node != nullptr ? node->version.value_or(0) : 0;
  const std::string origin =
      fmt::format("Parameters of robot {} on {}, firmware {}; unit and range behind each", bus.robot(),
                  bus.name(), version_text(v));
  files::write(o.file, bench::saved_toml(params, origin));
  fmt::print(words_beside({o.file}), "{} parameters: {}\n", robot_keys().size(), o.file);
  return 0;
}

int get(const ParamOptions& o) {
  if (!o.file.empty()) return save(o);
  if (o.all != o.names.empty()) throw UsageError("bench get: name parameters, or --all");
  std::vector<std::size_t> places;
  for (const std::string& name : o.names) places.push_back(as_usage([&] { return bench::place_of(name); }));
  for (std::size_t i = 0; o.all && i < robot_keys().size(); ++i) places.push_back(i);
  BenchBus bus(o.bus);
  const auto client = bus.client();
  Params params;
  for (const std::size_t place : places) take(params, place, *client);
  const std::vector<ParamEntry> list = param_list(params), usual = param_list(Params{});
  Json json = {{"bus", bus.name()}, {"robot", bus.robot()}, {"parameters", Json::array()}};
  for (const std::size_t place : places) {
    const ParamEntry& e = list[place];
    if (o.json) {
      json["parameters"].push_back(entry_json(e, place));
    } else {
      fmt::print("{:<28} {:<18} {}; default {}\n", e.key, bench::value_text(e, e.raw),
                 bench::range_text(e, place), bench::value_text(e, usual[place].raw));
    }
  }
  if (o.json) print_object(json.dump());
  return 0;
}

std::vector<bench::Change> changes(const Params& from, const Params& to) {
  std::vector<bench::Change> all;
  for (int i = 0; i < kParams; ++i) {
    const std::uint32_t before = raw_param(from, i), after = raw_param(to, i);
    if (before != after) all.push_back({static_cast<std::uint8_t>(i), before, after});
  }
  return all;
}

void print_written(const ParamOptions& o, const BenchBus& bus, const Params& from, const Params& to) {
  const std::vector<ParamEntry> before = param_list(from), after = param_list(to);
  Json json = {{"bus", bus.name()}, {"robot", bus.robot()}, {"written", Json::array()}};
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].raw == after[i].raw) continue;
    const ParamEntry& e = after[i];
    json["written"].push_back({{"name", e.key},
                               {"from", value_json(e, before[i].raw)},
                               {"to", value_json(e, e.raw)},
                               {"unit", e.unit.symbol}});
    if (!o.json) {
      fmt::print("{}: {} -> {}\n", e.key, bench::value_text(e, before[i].raw), bench::value_text(e, e.raw));
    }
  }
  if (o.json) {
    print_object(json.dump());
  } else if (json["written"].empty()) {
    fmt::print("the robot has these values already\n");
  }
}

/// Throws UsageError for values that do not fit together.
void check_relations(const Params& params) {
  for (const Violation& v : violations(params).all) {
    std::string fits;
    for (const std::string& fit : v.fits) fits += (fits.empty() ? "; it would fit with " : " or ") + fit;
    throw UsageError(fmt::format("the values do not fit together: {}{}", relation(v.fault).words, fits));
  }
}

/// refused: throws for the parameter that the controller refuses, with this sentence.
void write(bench::ParamClient& client, const Params& from, const Params& to,
           const std::function<void(std::size_t, const std::string&)>& refused) {
  const std::vector<ParamEntry> list = param_list(to);
  const auto name_of = [&](std::uint8_t i) { return std::string(list[i].key); };
  const std::vector<bench::Change> diff = changes(from, to);
  if (diff.empty()) return;
  const bench::Written result = bench::write_all(client, diff, name_of);
  if (result.committed) return;
  const char* const word = can::word_in<can::kParamStatusWords>(static_cast<int>(result.status));
  if (result.status == can::ParamStatus::busy) {
    throw bench::NoAnswer("a mission runs (busy): nothing was written; cancel it first");
  }
  if (result.refused) {
    const ParamEntry& e = list[*result.refused];
    refused(*result.refused, fmt::format("the controller says {}: {}; nothing was written", word,
                                         bench::outside_text(*result.refused, e.text(), e.raw)));
  }
  const auto fault = static_cast<ParamFault>(result.relation);
  throw UsageError(
      fmt::format("the controller says {}: {}; nothing was written", word, relation(fault).words));
}

/// From a robot file.
int restore(const ParamOptions& o, const std::string& file) {
  Params alone;
  apply_robot_file(alone, file);
  BenchBus bus(o.bus);
  const auto client = bus.client();
  const Params from = read_all(*client);
  Params to = from;
  apply_robot_file(to, file);
  write(*client, from, to, [&](std::size_t place, const std::string& words) {
    const toml::table root = parse_toml(read_file(file), file);
    const toml::table* const own = root["robot"].as_table();
    const char* const key = param_list(to)[place].key;
    const toml::node* const at = own != nullptr && own->contains(key) ? own->get(key) : root.get(key);
    const auto where = at != nullptr ? at->source().begin : toml::source_position{1, 1};
    throw InputError(file, where.line, where.column, words);
  });
  print_written(o, bus, from, to);
  return 0;
}

int set(const ParamOptions& o) {
  if (o.names.size() == 1 && o.names.front().find('=') == std::string::npos)
    return restore(o, o.names.front());
  std::vector<bench::Assignment> wanted;
  for (const std::string& text : o.names) {
    wanted.push_back(as_usage([&] { return bench::parse_assignment(text); }));
  }
  BenchBus bus(o.bus);
  const auto client = bus.client();
  const Params from = read_all(*client);
  Params to = from;
  for (const bench::Assignment& a : wanted) set_param(to, a.place, a.raw);
  check_relations(to);
  write(*client, from, to, [](std::size_t, const std::string& words) { throw UsageError(words); });
  print_written(o, bus, from, to);
  return 0;
}

CLI::App* add(CLI::App& bench, int& status, const char* name, const char* about,
              const std::shared_ptr<ParamOptions>& o, int (*execute)(const ParamOptions&)) {
  CLI::App* cmd = bench.add_subcommand(name, about);
  add_bench_bus(*cmd, o->bus);
  cmd->callback([o, execute, &status] { status = bench_status([&] { return execute(*o); }); });
  return cmd;
}

void add_json(CLI::App& cmd, ParamOptions& o) {
  add_switch(cmd, "--json", o.json, "Print the result as one JSON object and nothing else");
}

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
    print_object(json.dump());
  } else if (sends) {
    fmt::print("response table: {} -> {}, {}\n", text(before), text(now),
               reply.kept != 0 ? "kept for the next start" : "until the controller restarts");
  } else {
    fmt::print("response table: {}\n", text(now));
  }
  return 0;
}

}  // namespace

void add_bench_params(CLI::App& bench, int& status) {
  const auto reads = std::make_shared<ParamOptions>();
  CLI::App* cmd = add(bench, status, "get", "Read parameters of the controller", reads, get);
  cmd->add_option("NAME", reads->names, "Names as in a robot file")->type_name("NAME");
  add_switch(*cmd, "--all", reads->all, "All of them");
  add_file(*cmd, "--out", reads->file, "Write all of them to a robot file (TOML) instead")
      ->excludes("NAME")
      ->excludes("--all");
  add_json(*cmd, *reads);

  const auto sets = std::make_shared<ParamOptions>();
  cmd = add(bench, status, "set",
            "Write parameters, or what differs from a robot file: all of it, or nothing", sets, set);
  cmd->add_option("NAME=VALUE|FILE", sets->names, "Values in the units of a robot file, or such a file")
      ->required();
  add_json(*cmd, *sets);
}

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
