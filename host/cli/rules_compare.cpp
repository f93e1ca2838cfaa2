#include "host/cli/rules_compare.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/campaign/comparison.hpp"
#include "host/campaign/mission.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/many_runs.hpp"
#include "host/cli/options.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"

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
bool drive_pairs(const Missions& missions, const PlannerKind (&kinds)[2], int jobs,
                 std::vector<campaign::Pair>& pairs) {
  const std::uint64_t count = missions.last - missions.first;
  std::vector<double> jerks(2 * count);
  std::vector<campaign::Row> rows;
  const bool whole = make_many(
      2 * count, jobs,
      [&](std::uint64_t i, const std::atomic<bool>& stop) {
        campaign::Mission m = mission(missions, missions.first + i / 2);
        bend_if_chosen(m.scenario.robot, kinds[i % 2]);
        campaign::JerkMeter jerk;
        const auto note = [&](const TickRecord& r) { jerk.add(r.t_s, (r.v_left_mps + r.v_right_mps) / 2); };
        campaign::Row row = campaign::drive(m.scenario, kinds[i % 2], stop, campaign::kWayRadius, note);
        jerks[i] = jerk.rms();
        return row;
      },
      [&](const campaign::Row& row) { rows.push_back(row); });
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2)
    pairs.push_back({rows[i], rows[i + 1], jerks[i], jerks[i + 1]});
  return whole;
}

std::string bounds(const std::optional<campaign::Estimate>& e, double scale, int digits, bool sign) {
  if (!e) return "-";
  const auto number = [&](double x) {
    return sign ? fmt::format("{:+.{}f}", scale * x, digits) : fmt::format("{:.{}f}", scale * x, digits);
  };
  if (!e->low || !e->high) return number(e->value);
  return fmt::format("{} [{}, {}]", number(e->value), number(*e->low), number(*e->high));
}

void print_words(const CompareOptions& o, const campaign::Comparison& c) {
  fmt::print("A = {}, B = {}: {} worlds, planner {}\n", o.a, o.b, c.worlds, name(o.campaign.planner));
  fmt::print("success, %        A {}, B {}; only A {}, only B {}\n", bounds(c.success_a, 100, 1, false),
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

using Json = nlohmann::ordered_json;

Json json_of(const std::optional<campaign::Estimate>& e) {
  if (!e) return nullptr;
  const auto or_null = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  return {{"value", e->value}, {"low", or_null(e->low)}, {"high", or_null(e->high)}};
}

Json json_of(const CompareOptions& o, const campaign::Comparison& c, const PlannerKind (&kinds)[2]) {
  const auto side = [](const std::string& file, PlannerKind kind, const campaign::Estimate& success,
                       std::uint64_t contacts, std::uint64_t alone) {
    return Json{{"rules", file},
                {"rules_digest", rules_name(kind).value_or("")},
                {"success", json_of(success)},
                {"contacts", contacts},
                {"succeeds_alone", alone}};
  };
  return {{"worlds", c.worlds},
          {"both_reach", c.both},
          {"a", side(o.a, kinds[0], c.success_a, c.contacts_a, c.only_a)},
          {"b", side(o.b, kinds[1], c.success_b, c.contacts_b, c.only_b)},
          {"time_ratio", json_of(c.time)},
          {"path_ratio", json_of(c.path)},
          {"jerk_ratio", json_of(c.jerk)},
          {"stops_per_m_difference", json_of(c.stops)},
          {"flips_per_m_difference", json_of(c.flips)},
          {"clearance_m_difference", json_of(c.clearance)}};
}

int execute(const CompareOptions& o) {
  if (o.campaign.worlds.empty()) throw UsageError("rules compare: --worlds is required");
  const PlannerKind kinds[] = {with_table(o, o.a), with_table(o, o.b)};
  const Missions chosen = missions(o.campaign);
  std::vector<campaign::Pair> pairs;
  const bool whole = drive_pairs(chosen, kinds, o.campaign.jobs, pairs);
  if (!whole) {
    fmt::print(stderr, "whisker: interrupted\n");
    return kInterrupted;
  }
  const campaign::Comparison c = campaign::compare(pairs);
  if (o.campaign.json) {
    Provenance p;
    p.planner = name(chosen.planner);
    p.seed = o.campaign.seed.value_or(1);
    fmt::print("{}\n", with_provenance(json_of(o, c, kinds).dump(), p));
  } else {
    print_words(o, c);
  }
  return 0;
}

}  // namespace

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
