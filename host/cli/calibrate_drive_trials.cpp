#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/cli/calibrate_drive_output.hpp"

namespace whisker::cli {
namespace {

using calibration::kQuantities;
using calibration::Measured;
using calibration::Quantity;
using Json = nlohmann::ordered_json;

/// Relative errors of one quantity.
struct Errors {
  std::size_t count = 0;
  double rms = 0, p50 = 0, p95 = 0, most = 0;
  double sigma = 0;       ///< root of the mean square of what was claimed
  double within_two = 0;  ///< share within two claimed standard deviations
};

Errors errors_of(const std::vector<DriveTrial>& trials, Quantity q) {
  Errors e;
  std::vector<double> sizes;
  for (const DriveTrial& trial : trials) {
    const DriveReport& r = trial.report;
    const Measured& m = r.values[q];
    if (!m.known()) continue;
    const double off = std::fabs(m.value / calibration::best_value(r.before, *r.truth, r.values, q) - 1);
    const double sigma = m.sigma.raw() * 1e-6;
    sizes.push_back(off);
    e.rms += off * off;
    e.sigma += sigma * sigma;
    e.within_two += off <= 2 * sigma ? 1 : 0;
  }
  e.count = sizes.size();
  if (sizes.empty()) return e;
  std::sort(sizes.begin(), sizes.end());
  const double n = static_cast<double>(sizes.size());
  const auto quantile = [&](double share) { return sizes[static_cast<std::size_t>(share * (n - 1) + 0.5)]; };
  e.rms = std::sqrt(e.rms / n);
  e.sigma = std::sqrt(e.sigma / n);
  e.within_two /= n;
  e.p50 = quantile(0.5);
  e.p95 = quantile(0.95);
  e.most = sizes.back();
  return e;
}

std::map<std::string, int> troubles(const std::vector<DriveTrial>& trials) {
  std::map<std::string, int> all;
  for (const DriveTrial& trial : trials) {
    for (const calibration::ProcedureStep& step : trial.report.steps) {
      if (!step.ended.good()) ++all[step.name + ": " + step.ended.trouble];
    }
  }
  return all;
}

}  // namespace

std::string drive_trials_words(const std::vector<DriveTrial>& trials) {
  std::string out =
      "| value | robots | error, rms | median | 95 % | largest | claimed, rms | within two, % |\n"
      "|---|---|---|---|---|---|---|---|\n";
  const auto percent = [](double x) { return fmt::format("{:.4f} %", x * 100); };
  for (int i = 0; i < kQuantities; ++i) {
    const auto q = static_cast<Quantity>(i);
    const Errors e = errors_of(trials, q);
    if (e.count == 0) continue;
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.0f} |\n", name(q), e.count, percent(e.rms),
                       percent(e.p50), percent(e.p95), percent(e.most), percent(e.sigma), e.within_two * 100);
  }
  for (const auto& [what, count] : troubles(trials)) out += fmt::format("no result: {} x {}\n", count, what);
  return out;
}

std::string drive_trials_json(const std::vector<DriveTrial>& trials) {
  Json values = Json::object();
  for (int i = 0; i < kQuantities; ++i) {
    const auto q = static_cast<Quantity>(i);
    const Errors e = errors_of(trials, q);
    if (e.count == 0) continue;
    values[name(q)] = {{"count", e.count},
                       {"rms", e.rms},
                       {"p50", e.p50},
                       {"p95", e.p95},
                       {"most", e.most},
                       {"sigma", e.sigma},
                       {"within_two", e.within_two}};
  }
  const auto complete =
      std::count_if(trials.begin(), trials.end(), [](const DriveTrial& t) { return t.complete; });
  const Json json = {
      {"robots", trials.size()}, {"complete", complete}, {"values", values}, {"troubles", troubles(trials)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace whisker::cli
