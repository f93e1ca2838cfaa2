#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/campaign/scan.hpp"
#include "host/campaign/summary.hpp"

namespace whisker::campaign {
namespace {

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

std::string summary_words(const Summary& s) {
  std::string text =
      fmt::format("{} missions, {}, planner {}, seeds {} to {}; 95 % bounds beside each figure\n", s.missions,
                  joined(s.worlds), joined(s.planners), s.least_seed, s.greatest_seed);
  text += percent_line("truly there", s.truly_there);
  text += percent_line("success", s.success);
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
