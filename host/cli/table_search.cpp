#include "host/cli/table_search.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "firmware/fuzzy/digest.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/lab/campaign/mission.hpp"
#include "host/lab/campaign/ordered.hpp"
#include "host/lab/guard/campaign.hpp"

namespace whisker::cli {
namespace {

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

Json or_null(const std::optional<Estimate>& e) { return e ? estimate_json(*e) : Json(nullptr); }

Json side(const Estimate& there, const Estimate& success, std::uint64_t contacts, std::uint64_t alone) {
  return {{"truly_there", estimate_json(there)},
          {"success", estimate_json(success)},
          {"contacts", contacts},
          {"succeeds_alone", alone}};
}

constexpr std::uint64_t kTriesPerChild = 100;

constexpr Verdict verdict_of(guard::End end) {
  switch (end) {
    case guard::End::arrived: return Verdict::reached;
    case guard::End::contact: return Verdict::contact;
    case guard::End::fault: return Verdict::fault;
    case guard::End::time:
    case guard::End::ended: break;
  }
  return Verdict::gave_up;
}

/// The sloppy operator in this world, with the guard's assist.
campaign::Row drive_operator(const campaign::Mission& mission, const fuzzy::Bilinear::Table& table,
                             const std::atomic<bool>& stop) {
  guard::Plan plan;
  plan.hand = guard::Hand::sloppy;
  plan.mode = guard::kAssisting;
  plan.table = &table;
  const auto result = guard::drive_one(plan, mission.scenario, [&] { return stop.load(); });
  if (!result)
    throw UsageError(
        fmt::format("--assist: no path for the operator in {}, seed {}", mission.world, mission.seed));
  if (result->end == guard::End::ended) throw campaign::Stopped{};
  campaign::Row row;
  row.seed = mission.seed;
  row.world = mission.world;
  row.verdict = verdict_of(result->end);
  row.time_s = result->time_s;
  row.path_m = result->path_m;
  row.stops = result->stops;
  row.min_clearance_m = result->min_clearance_m;
  return row;
}

}  // namespace

bool drive_pairs(std::uint64_t count, int jobs, const DriveSide& drive, std::vector<campaign::Pair>& pairs) {
  std::vector<double> jerks(2 * count);
  std::vector<campaign::Row> rows;
  const bool whole = make_many(
      2 * count, jobs,
      [&](std::uint64_t i, const std::atomic<bool>& stop) {
        return drive(i / 2, static_cast<int>(i % 2), jerks[i], stop);
      },
      [&](const campaign::Row& row) { rows.push_back(row); });
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2)
    pairs.push_back({rows[i], rows[i + 1], jerks[i], jerks[i + 1]});
  return whole;
}

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

void print_comparison(std::FILE* out, const campaign::Comparison& c) {
  fmt::print(out, "truly there, %    A {}, B {}\n", bounds(c.there_a, 100, 1, false),
             bounds(c.there_b, 100, 1, false));
  fmt::print(out, "by estimate, %    A {}, B {}; only A {}, only B {}\n", bounds(c.success_a, 100, 1, false),
             bounds(c.success_b, 100, 1, false), c.only_a, c.only_b);
  fmt::print(out, "contacts          A {}, B {}\n", c.contacts_a, c.contacts_b);
  fmt::print(out, "over the {} worlds that both reach, with 95 % bounds:\n", c.both);
  fmt::print(out, "time, B / A       {}\n", bounds(c.time, 1, 3, false));
  fmt::print(out, "path, B / A       {}\n", bounds(c.path, 1, 3, false));
  fmt::print(out, "jerk, B / A       {}\n", bounds(c.jerk, 1, 3, false));
  fmt::print(out, "stops per m, B-A  {}\n", bounds(c.stops, 1, 3, true));
  fmt::print(out, "flips per m, B-A  {}\n", bounds(c.flips, 1, 3, true));
  fmt::print(out, "clearance, B-A    {} mm\n", bounds(c.clearance, 1000, 2, true));
}

Json estimate_json(const Estimate& e) {
  const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  return {{"value", e.value}, {"low", number(e.low)}, {"high", number(e.high)}};
}

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

std::string estimate_text(const Estimate& e, int digits) { return bounds(e, 1, digits, false); }

std::optional<Candidate> candidate(const rules::MirroredRules& rules) {
  const auto response = rules::admitted(rules);
  if (!response) return std::nullopt;
  return Candidate{rules, std::make_shared<fuzzy::Bilinear::Table>(response->table),
                   fuzzy::digest(response->table)};
}

double TableSearch::limit_s() const { return plan_.assist ? guard::kToGoal_s : worlds::kTimeLimit; }

campaign::Row TableSearch::drive(std::size_t of_class, std::uint64_t index, const Candidate& by, double& jerk,
                                 const std::atomic<bool>& stop) const {
  const Missions& missions = plan_.classes[of_class];
  const campaign::Mission one = mission(missions, index);
  if (plan_.assist) return drive_operator(one, *by.table, stop);
  PlannerKind kind = missions.planner;
  kind.table = by.table.get();
  kind.table_chosen = true;
  return drive_with_jerk(one, kind, jerk, stop);
}

/// The best so far, then its children; no two have the same table.
std::vector<Candidate> TableSearch::field() {
  std::vector<Candidate> all{best_};
  for (std::uint64_t i = 0; i < kTriesPerChild * plan_.children && all.size() <= plan_.children; ++i) {
    const auto child = candidate(mutation_(best_.rules));
    const auto same = [&](const Candidate& other) { return other.digest == child->digest; };
    if (child && std::none_of(all.begin(), all.end(), same)) all.push_back(*child);
  }
  return all;
}

/// Sets the index of the child that came through all rounds, and the standings of the last round alone: the
/// earlier worlds chose the child, and would flatter it. False: interrupted.
bool TableSearch::race(const std::vector<Candidate>& field, std::vector<campaign::Standing>& standings,
                       std::size_t& first) {
  std::vector<std::size_t> children(field.size() - 1);
  std::iota(children.begin(), children.end(), 1);
  const std::uint64_t worlds_before = generations_.size() * plan_.count;
  std::uint64_t from = 0;
  for (const campaign::Round& round : campaign::halving(children.size(), plan_.count)) {
    std::stable_sort(children.begin(), children.end(), [&](std::size_t a, std::size_t b) {
      return campaign::ranks_before(standings[a], standings[b]);
    });
    children.resize(round.entrants);
    if (round.entrants == 1 && from > 0) standings.assign(field.size(), {});
    std::vector<std::size_t> entrants{0};
    entrants.insert(entrants.end(), children.begin(), children.end());
    const std::uint64_t each = plan_.classes.size() * entrants.size();
    std::uint64_t taken = 0;
    if (round.worlds == from) continue;
    const bool whole = make_many((round.worlds - from) * each, plan_.jobs,
                                 [&](std::uint64_t i, const std::atomic<bool>& stop) {
                                   double jerk = 0;
                                   return drive(i % each / entrants.size(), worlds_before + from + i / each,
                                                field[entrants[i % entrants.size()]], jerk, stop);
                                 },
                                 [&](const campaign::Row& row) {
                                   standings[entrants[taken++ % entrants.size()]].add(row, limit_s());
                                 });
    if (!whole) return false;
    from = round.worlds;
  }
  first = children.front();
  return true;
}

bool TableSearch::run(const std::function<void(const Generation&)>& after) {
  while (generations_.size() < plan_.generations) {
    const std::vector<Candidate> all = field();
    if (all.size() == 1) break;
    std::vector<campaign::Standing> standings(all.size());
    std::size_t first = 0;
    if (!race(all, standings, first)) return false;
    Generation g;
    g.number = generations_.size() + 1;
    g.digest = all[first].digest;
    g.time = campaign::time_ratio(standings[0], standings[first]);
    g.kept = campaign::improves(standings[first], standings[0]);
    if (g.kept) best_ = all[first];
    generations_.push_back(g);
    after(g);
  }
  return true;
}

std::optional<Validation> TableSearch::validate() const {
  Validation v;
  std::vector<campaign::Pair> all;
  campaign::Standing base, best;
  for (std::size_t k = 0; k < plan_.classes.size(); ++k) {
    std::vector<campaign::Pair> pairs;
    const auto one = [&](std::uint64_t i, int side, double& jerk, const std::atomic<bool>& stop) {
      return drive(k, plan_.searched() + i, side == 0 ? base_ : best_, jerk, stop);
    };
    if (!drive_pairs(plan_.validation, plan_.jobs, one, pairs)) return std::nullopt;
    v.classes.push_back(campaign::compare(pairs));
    for (const campaign::Pair& pair : pairs) {
      base.add(pair.a, limit_s());
      best.add(pair.b, limit_s());
    }
    all.insert(all.end(), pairs.begin(), pairs.end());
  }
  v.all = campaign::compare(all);
  v.time = campaign::time_ratio(base, best);
  v.better = campaign::improves(best, base);
  return v;
}

}  // namespace whisker::cli
