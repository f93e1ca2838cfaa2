#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
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
#include "host/harness/file/file.hpp"
#include "host/lab/campaign/comparison.hpp"
#include "host/lab/campaign/mission.hpp"

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

/// One mission with the kind's table, which bends the course.
campaign::Row drive_with_jerk(campaign::Mission mission, PlannerKind kind, double& jerk,
                              const std::atomic<bool>& stop) {
  bend_if_chosen(mission.scenario.robot, kind);
  campaign::JerkMeter meter;
  const auto note = [&](const TickRecord& r) { meter.add(r.t_s, (r.v_left_mps + r.v_right_mps) / 2); };
  campaign::Row row = campaign::drive(mission.scenario, kind, stop, campaign::kWayRadius, note);
  jerk = meter.rms();
  row.world = mission.world;
  return row;
}

/// False: interrupted.
bool drive_both(const Missions& missions, const PlannerKind (&kinds)[2], int jobs,
                std::vector<campaign::Pair>& pairs) {
  const std::uint64_t count = missions.last - missions.first;
  std::vector<double> jerks(2 * count);
  std::vector<campaign::Row> rows;
  const bool whole = make_many(
      2 * count, jobs,
      [&](std::uint64_t i, const std::atomic<bool>& stop) {
        return drive_with_jerk(mission(missions, missions.first + i / 2), kinds[i % 2], jerks[i], stop);
      },
      [&](const campaign::Row& row) { rows.push_back(row); });
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2)
    pairs.push_back({rows[i], rows[i + 1], jerks[i], jerks[i + 1]});
  return whole;
}

using Json = nlohmann::ordered_json;
using campaign::Estimate;

std::string bounds(const std::optional<Estimate>& e, double scale, int digits, bool sign) {
  if (!e) return "-";
  const auto number = [&](double x) {
    return sign ? fmt::format("{:+.{}f}", scale * x, digits) : fmt::format("{:.{}f}", scale * x, digits);
  };
  if (!e->low || !e->high) return number(e->value);
  return fmt::format("{} [{}, {}]", number(e->value), number(*e->low), number(*e->high));
}

/// Lines for people.
void print_comparison(const campaign::Comparison& c) {
  fmt::print("truly there, %    A {}, B {}\n", bounds(c.there_a, 100, 1, false),
             bounds(c.there_b, 100, 1, false));
  fmt::print("by estimate, %    A {}, B {}; only A {}, only B {}\n", bounds(c.success_a, 100, 1, false),
             bounds(c.success_b, 100, 1, false), c.only_a, c.only_b);
  fmt::print("contacts          A {}, B {}\n", c.contacts_a, c.contacts_b);
  fmt::print("over the {} worlds that both reach, with 95 % bounds:\n", c.both);
  fmt::print("time, B / A       {}\n", bounds(c.time, 1, 3, false));
  fmt::print("path, B / A       {}\n", bounds(c.path, 1, 3, false));
  fmt::print("jerk, B / A       {}\n", bounds(c.jerk, 1, 3, false));
  fmt::print("stops per m, B-A  {}\n", bounds(c.stops, 1, 3, true));
  fmt::print("flips per m, B-A  {}\n", bounds(c.flips, 1, 3, true));
  fmt::print("clearance, B-A    {} mm\n", bounds(c.clearance, 1000, 2, true));
}

Json estimate_json(const Estimate& e) {
  const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  return {{"value", e.value}, {"low", number(e.low)}, {"high", number(e.high)}};
}

Json or_null(const std::optional<Estimate>& e) { return e ? estimate_json(*e) : Json(nullptr); }

Json side(const Estimate& there, const Estimate& success, std::uint64_t contacts, std::uint64_t alone) {
  return {{"truly_there", estimate_json(there)},
          {"success", estimate_json(success)},
          {"contacts", contacts},
          {"succeeds_alone", alone}};
}

/// Without names of the two.
Json comparison_json(const campaign::Comparison& c) {
  return {{"worlds", c.worlds},
          {"both_reach", c.both},
          {"a", side(c.there_a, c.success_a, c.contacts_a, c.only_a)},
          {"b", side(c.there_b, c.success_b, c.contacts_b, c.only_b)},
          {"time_ratio", or_null(c.time)},
          {"path_ratio", or_null(c.path)},
          {"jerk_ratio", or_null(c.jerk)},
          {"stops_per_m_difference", or_null(c.stops)},
          {"flips_per_m_difference", or_null(c.flips)},
          {"clearance_m_difference", or_null(c.clearance)}};
}

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
    print_comparison(c);
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
