#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/fuzzy/digest.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/figures.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/cli/table_search.hpp"
#include "host/harness/file/file.hpp"
#include "host/lab/campaign/comparison.hpp"

namespace whisker::cli {
namespace {

struct CompareOptions {
  std::string a, b;
  std::vector<std::string> names;
  CampaignOptions campaign;
};

PlannerKind with_table(const CompareOptions& o, const std::string& file) {
  PlannerKind kind = o.campaign.planner;
  if (is_baseline(kind)) throw UsageError(fmt::format("rules compare: planner {} has no table", name(kind)));
  kind.table = response_table(file, o.names);
  kind.table_chosen = true;
  return kind;
}

/// False: interrupted.
bool drive_both(const Missions& missions, const PlannerKind (&kinds)[2], int jobs,
                std::vector<campaign::Pair>& pairs) {
  const auto drive = [&](std::uint64_t i, int side, double& jerk, const std::atomic<bool>& stop) {
    return drive_with_jerk(mission(missions, missions.first + i), kinds[side], jerk, stop);
  };
  return drive_pairs(missions.last - missions.first, jobs, drive, pairs);
}

using Json = nlohmann::ordered_json;

Json json_of(const CompareOptions& o, const campaign::Comparison& c, const PlannerKind (&kinds)[2]) {
  Json json = comparison_json(c);
  const char* const sides[] = {"a", "b"};
  for (const int side : {0, 1}) {
    Json named = {{"rules", side == 0 ? o.a : o.b}, {"rules_digest", rules_name(kinds[side]).value_or("")}};
    named.update(json[sides[side]]);
    json[sides[side]] = named;
  }
  return json;
}

int execute(const CompareOptions& o) {
  if (o.campaign.worlds.empty()) throw UsageError("rules compare: --worlds is required");
  const PlannerKind kinds[] = {with_table(o, o.a), with_table(o, o.b)};
  const Missions chosen = missions(o.campaign);
  std::vector<campaign::Pair> pairs;
  const bool whole = drive_both(chosen, kinds, o.campaign.jobs, pairs);
  if (pairs.empty()) throw Interrupted("");
  const campaign::Comparison c = campaign::compare(pairs);
  if (o.campaign.json) {
    print_object(json_of(o, c, kinds).dump(), {o.campaign.seed.value_or(1), name(chosen.planner)});
  } else {
    fmt::print("A = {}, B = {}: {} worlds, planner {}\n", o.a, o.b, c.worlds, name(o.campaign.planner));
    print_comparison(stdout, c);
  }
  if (!whole)
    throw Interrupted(fmt::format(" after {} of {} worlds", pairs.size(), chosen.last - chosen.first));
  return 0;
}

using fuzzy::Bilinear;

/// Of the file format; the playground refuses others (host/lab/web/src/playground/opened_table.ts).
constexpr int kFormat = 1;

std::string json_of(const rules::RuleBase& base, const rules::Response& response) {
  std::vector<std::int16_t> nodes;
  for (const auto& row : response.table.node)
    for (const Bilinear::Node& node : row) nodes.insert(nodes.end(), {node.turn, node.step});
  const Json json = {
      {"whisker_table", kFormat},
      {"name", base.name.empty() ? std::filesystem::path(base.file).filename().string() : base.name},
      {"hash", fmt::format("{:08x}", fuzzy::digest(response.table))},
      {"rows", Bilinear::kDistanceNodes},
      {"columns", Bilinear::kBiasNodes},
      {"symmetric", response.symmetric},
      {"turn_error", response.turn_error},
      {"step_error", response.step_error},
      {"nodes", nodes}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

int write_table(const std::string& rules_file, const std::vector<std::string>& names,
                const std::string& out) {
  if (rules_file.empty()) throw UsageError("table --json needs a FILE");
  const rules::RuleBase base = load_rules(rules_file);
  const std::string text = json_of(base, named_response(base, names));
  if (out.empty()) {
    fmt::print("{}", text);
  } else {
    files::write(out, text);
    fmt::print(words_beside({out}), "table: {}\n", out);
  }
  return 0;
}

void add_rules_compare(CLI::App& rules, int& status) {
  CLI::App* cmd = rules.add_subcommand("compare", "Drive with two response tables in the same worlds");
  const auto o = std::make_shared<CompareOptions>();
  add_file(*cmd, "A", o->a, "Rule base, or \"default\" for the core's own")->required();
  add_file(*cmd, "B", o->b, "The other")->required();
  add_map_names(*cmd, o->names, "The files' name of D, R, SA or SD; may be repeated");
  add_worlds(*cmd, o->campaign, "worlds", "--worlds")->type_name("KIND|DIR");
  add_switch(*cmd, "--noise", o->campaign.world.noise,
             "Sensor noise and odometry error, as in `whisker world`");
  add_planner_kind(*cmd, o->campaign.planner);
  add_file(*cmd, "--robot", o->campaign.robot,
           "Parameters of your robot (TOML), over those of the scenarios");
  add_jobs(*cmd, o->campaign);
  add_switch(*cmd, "--json", o->campaign.json, "Print the result as one JSON object and nothing else");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
