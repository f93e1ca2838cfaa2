#include "host/cli/calibrate_drive_output.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/calibration/hand_measured.hpp"
#include "host/cli/exit_status.hpp"

namespace whisker::cli {
namespace {

using calibration::kQuantities;
using calibration::Measured;
using calibration::Quantity;
using Json = nlohmann::ordered_json;

/// As in a robot file.
double in_file(Quantity q, double raw) { return q == Quantity::counts_per_metre ? raw : raw * 1e-6; }

int digits(Quantity q) { return q == Quantity::counts_per_metre ? 1 : 6; }

double truth_of(const DriveReport& r, Quantity q) {
  return calibration::best_value(r.before, *r.truth, r.values, q);
}

std::string row(const DriveReport& r, Quantity q) {
  const Measured& m = r.values[q];
  const double before = value_in(r.before, q);
  std::string line =
      fmt::format("{:<21}{:>13.{}f}{:>13.{}f}{:>12}", name(q), in_file(q, before), digits(q),
                  in_file(q, m.value), digits(q), fmt::format("{:.4f} %", m.sigma.raw() * 1e-4));
  if (r.truth) {
    const double truth = truth_of(r, q);
    line += fmt::format("{:>13.{}f}{:>11}", in_file(q, truth), digits(q),
                        fmt::format("{:+.4f} %", (m.value / truth - 1) * 100));
  }
  return line + "\n";
}

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

std::string drive_words(const DriveReport& r) {
  std::string out = r.source + "\n";
  for (const calibration::ProcedureStep& step : r.steps) {
    const std::string time = step.ended.time_s > 0 ? fmt::format(", {:.0f} s", step.ended.time_s) : "";
    out += fmt::format("{}{}: {}\n", step.name, time,
                       step.ended.good() ? step.found : "no result: " + step.ended.trouble);
  }
  out += fmt::format("\n{:<21}{:>13}{:>13}{:>12}", "", "so far", "found", "+-");
  out += r.truth ? fmt::format("{:>13}{:>11}\n", "true", "off") : "\n";
  for (int i = 0; i < kQuantities; ++i) {
    if (r.values.of[i].known()) out += row(r, static_cast<Quantity>(i));
  }
  const auto lines = calibration::robot_lines(r.values);
  if (lines.empty()) return out + "nothing was measured\n";
  if (r.refused != ParamFault::none) return out;
  out += fmt::format("\nWrite into {}:\n", r.robot);
  for (const std::string& line : lines) out += line + "\n";
  const auto sigmas = calibration::sigma_lines(r.values);
  if (!sigmas.empty()) out += "\nTo declare what remains, for a bound of the pose:\n";
  for (const std::string& line : sigmas) out += line + "\n";
  return out;
}

std::string drive_json(const DriveReport& r) {
  Json steps = Json::array();
  bool measured = r.refused == ParamFault::none;
  for (const calibration::ProcedureStep& step : r.steps) {
    Json one = {{"step", step.name}, {"time_s", step.ended.time_s}, {"found", step.found}};
    one["trouble"] = step.ended.good() ? Json() : Json(step.ended.trouble);
    measured = measured && step.ended.good();
    steps.push_back(one);
  }
  Json values = Json::array();
  for (int i = 0; i < kQuantities; ++i) {
    const auto q = static_cast<Quantity>(i);
    const Measured& m = r.values[q];
    if (!m.known()) continue;
    Json one = {{"key", name(q)},
                {"before", in_file(q, value_in(r.before, q))},
                {"value", in_file(q, m.value)},
                {"sigma", m.sigma.raw() * 1e-6}};
    if (r.truth) {
      one["true"] = in_file(q, truth_of(r, q));
      one["error"] = m.value / truth_of(r, q) - 1;
    }
    values.push_back(one);
  }
  const bool fits = r.refused == ParamFault::none;
  const Json json = {{"measured", measured},
                     {"fits", fits},
                     {"steps", steps},
                     {"values", values},
                     {"lines", fits ? calibration::robot_lines(r.values) : std::vector<std::string>{}},
                     {"sigma_lines", fits ? calibration::sigma_lines(r.values) : std::vector<std::string>{}}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

int print_failures(const DriveReport& report) {
  bool measured = true;
  for (const calibration::ProcedureStep& step : report.steps) {
    if (step.ended.good()) continue;
    measured = false;
    fmt::print(stderr, "whisker: {}: no result: {}\n", step.name, step.ended.trouble);
  }
  if (report.refused != ParamFault::none) {
    fmt::print(stderr, "whisker: the values do not fit the robot: {}: {}\n", name(report.refused),
               relation(report.refused).words);
  }
  return measured && report.refused == ParamFault::none ? 0 : kFault;
}

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
