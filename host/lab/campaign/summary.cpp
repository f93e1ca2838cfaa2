#include "host/lab/campaign/summary.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "host/lab/campaign/mission.hpp"
#include "host/lab/campaign/worlds.hpp"

namespace whisker::campaign {
namespace {

constexpr const char* kScenarioFiles = "scenario files";

void add_once(std::vector<std::string>& words, const std::string& word) {
  if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

Estimate share_of(const std::vector<Row>& rows, const std::function<bool(const Row&)>& counts) {
  const auto hits = std::count_if(rows.begin(), rows.end(), counts);
  return share(static_cast<std::uint64_t>(hits), rows.size());
}

Estimate share_of(const std::vector<Row>& rows, Verdict verdict) {
  return share_of(rows, [&](const Row& r) { return r.verdict == verdict; });
}

std::optional<Estimate> quantile_of(const std::vector<double>& sample, double p) {
  if (sample.empty()) return std::nullopt;
  return quantile(sample, p);
}

PerMetre per_metre(const std::vector<Row>& rows, const std::function<double(const Row&)>& amount_of) {
  std::vector<double> amounts, metres, each;
  for (const Row& row : rows) {
    if (row.path_m <= 0) continue;
    amounts.push_back(amount_of(row));
    metres.push_back(row.path_m);
    each.push_back(amounts.back() / row.path_m);
  }
  if (each.empty()) return {};
  return {rate(amounts, metres), quantile(each, 0.5)};
}

void add_reached(Summary& s, const std::vector<Row>& rows) {
  std::vector<double> ratios, paces, clearances, distances;
  for (const Row& row : rows) {
    if (!says_reached(row.verdict)) continue;
    if (const auto r = ratio(row)) ratios.push_back(*r);
    if (const auto p = s_per_m(row)) paces.push_back(*p);
    clearances.push_back(row.min_clearance_m);
    distances.push_back(row.final_distance_m);
  }
  if (!ratios.empty()) s.ratio_mean = mean(ratios);
  s.ratio_p50 = quantile_of(ratios, 0.5);
  s.ratio_p95 = quantile_of(ratios, 0.95);
  s.s_per_m_p50 = quantile_of(paces, 0.5);
  s.s_per_m_p95 = quantile_of(paces, 0.95);
  s.clearance_p5 = quantile_of(clearances, 0.05);
  s.final_distance_p50 = quantile_of(distances, 0.5);
  s.final_distance_p95 = quantile_of(distances, 0.95);
}

void add_robots(Summary& s, const std::vector<Row>& rows) {
  s.random_robots = true;
  for (const Row& row : rows) {
    if (!has_random_robots(row.world)) {
      s.random_robots = false;
      continue;
    }
    const Refusals refusals = random_robot(row.seed).refusals;
    for (std::size_t i = 0; i < refusals.size(); ++i) s.refusals[i] += refusals[i];
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string bound(const std::optional<double>& x, int decimals) {
  return x ? fmt::format("{:.{}f}", *x, decimals) : "?";
}

std::string percent_line(const char* what, const Estimate& e) {
  return fmt::format("{:<18}{:>9.2f} %   {:.2f} to {:.2f}\n", what, 100 * e.value, 100 * *e.low,
                     100 * *e.high);
}

std::string line(const char* what, const char* which, const std::optional<Estimate>& e) {
  const std::string start = fmt::format("{:<11}{:<7}", what, which);
  if (!e) return start + "        -\n";
  return start + fmt::format("{:>9.3f}     {} to {}\n", e->value, bound(e->low, 3), bound(e->high, 3));
}

std::string ratio_lines(const Summary& s) {
  return line("ratio", "mean", s.ratio_mean) + line("", "p50", s.ratio_p50) + line("", "p95", s.ratio_p95);
}

/// What the relations of check() refuse, most often refused first.
std::string refusal_lines(const Refusals& refusals) {
  std::vector<std::pair<std::uint64_t, const char*>> causes;
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < refusals.size(); ++i) {
    all += refusals[i];
    if (refusals[i] > 0) causes.emplace_back(refusals[i], name(static_cast<ParamFault>(i)));
  }
  if (causes.empty()) return {};
  std::stable_sort(causes.begin(), causes.end(), [](auto a, auto b) { return a.first > b.first; });
  std::string text = fmt::format("refused draws of robots: {}\n", all);
  for (const auto& [count, cause] : causes) text += fmt::format("  {:<27}{:>9}\n", cause, count);
  return text;
}

}  // namespace

Summary summarize(const std::vector<Row>& rows) {
  Summary s;
  s.missions = rows.size();
  s.least_seed = s.greatest_seed = rows.front().seed;
  for (const Row& row : rows) {
    s.no_way += has_no_way(row) ? 1U : 0U;
    s.least_seed = std::min(s.least_seed, row.seed);
    s.greatest_seed = std::max(s.greatest_seed, row.seed);
    add_once(s.worlds, is_scenario_file(row.world) ? kScenarioFiles : row.world);
    add_once(s.planners, row.planner);
  }
  s.success = share_of(rows, succeeded);
  s.truly_there = share_of(rows, Verdict::reached);
  s.off_goal = share_of(rows, Verdict::off_goal);
  s.reached = share_of(rows, [](const Row& r) { return says_reached(r.verdict); });
  s.unreachable = share_of(rows, Verdict::unreachable);
  s.gave_up = share_of(rows, Verdict::gave_up);
  s.contact = share_of(rows, Verdict::contact);
  s.fault = share_of(rows, Verdict::fault);
  s.false_unreachable =
      share_of(rows, [](const Row& r) { return r.verdict == Verdict::unreachable && !has_no_way(r); });
  add_reached(s, rows);
  add_robots(s, rows);
  std::vector<double> errors, paths;
  for (const Row& row : rows) {
    errors.push_back(row.estimate_error_m);
    paths.push_back(row.path_m);
  }
  s.estimate_error_p50 = quantile(errors, 0.5);
  s.estimate_error_p95 = quantile(errors, 0.95);
  s.path_p50 = quantile(paths, 0.5);
  s.path_p95 = quantile(paths, 0.95);
  s.stops = per_metre(rows, [](const Row& r) { return static_cast<double>(r.stops); });
  s.flips = per_metre(rows, [](const Row& r) { return static_cast<double>(r.flips); });
  s.looks = per_metre(rows, [](const Row& r) { return static_cast<double>(r.looks); });
  s.turned = per_metre(rows, [](const Row& r) { return r.turned_rad; });
  return s;
}

std::string summary_words(const Summary& s) {
  std::string text =
      fmt::format("{} missions, {}, planner {}, seeds {} to {}; 95 % bounds beside each figure\n", s.missions,
                  joined(s.worlds), joined(s.planners), s.least_seed, s.greatest_seed);
  text += percent_line("truly there", s.truly_there);
  text += percent_line("right by estimate", s.success);
  text += percent_line("says reached", s.reached);
  text += percent_line("  but off the goal", s.off_goal);
  text += percent_line("unreachable", s.unreachable);
  if (s.no_way > 0) text += percent_line("  though it is not", s.false_unreachable);
  text += percent_line("gave up", s.gave_up);
  text += percent_line("contact", s.contact);
  text += percent_line("fault", s.fault);
  text += ratio_lines(s);
  text += line("s/m", "p50", s.s_per_m_p50);
  text += line("", "p95", s.s_per_m_p95);
  text += line("clearance", "p5 m", s.clearance_p5);
  text += line("off goal", "p50 m", s.final_distance_p50);
  text += line("", "p95 m", s.final_distance_p95);
  text += line("est. error", "p50 m", s.estimate_error_p50);
  text += line("", "p95 m", s.estimate_error_p95);
  text += line("driven", "p50 m", s.path_p50);
  text += line("", "p95 m", s.path_p95);
  text += line("stops/m", "all", s.stops.rate);
  text += line("", "p50", s.stops.p50);
  text += line("flips/m", "all", s.flips.rate);
  text += line("", "p50", s.flips.p50);
  text += line("looks/m", "all", s.looks.rate);
  text += line("", "p50", s.looks.p50);
  text += line("rad/m", "all", s.turned.rate);
  text += line("", "p50", s.turned.p50);
  return text + refusal_lines(s.refusals);
}

std::string scan_words(const Summary& s) {
  return fmt::format("{} worlds, {}, a scanner all round, seeds {} to {}; 95 % bounds beside each figure\n",
                     s.missions, joined(s.worlds), s.least_seed, s.greatest_seed) +
         percent_line("reached", s.reached) + percent_line("unreachable", s.unreachable) + ratio_lines(s);
}

}  // namespace whisker::campaign
