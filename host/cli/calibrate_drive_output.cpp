#include "host/cli/calibrate_drive_output.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/cli/campaign_options.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/provenance.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/lab/calibration/hand_measured.hpp"
#include "host/lab/report/spin_svg.hpp"

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

calibration::WheelErrors errors_of(const Params& believed, const Params& real) {
  const auto share = [&](calibration::Quantity q) {
    return static_cast<double>(value_in(real, q)) / value_in(believed, q);
  };
  using calibration::Quantity;
  return {share(Quantity::gyro_scale), share(Quantity::wheel_ratio), share(Quantity::counts_per_metre),
          share(Quantity::track)};
}

report::SpinPicture picture_of(const calibration::SpinSeen& spin, const Params& params) {
  constexpr double kDegrees = 360.0 / planning::RangeProfile::kTurn;
  constexpr const char* kNames[] = {"left", "front", "right"};
  report::SpinPicture picture;
  picture.title = "The spin of a calibration";
  picture.offset_deg = spin.offset_deg;
  picture.window_deg = planning::ProfileMatch::kWindow * kDegrees;
  picture.mismatch_mm = spin.mismatch_mm;
  picture.range_m = params.rangefinders.max_range.raw() * 1e-6;
  for (int i = 0; i < hal::kBeams; ++i) {
    report::SpinPicture::Beam beam{kNames[i], {}, {}};
    const auto take = [&](const planning::RangeProfile& from, std::vector<report::Sighting>& to) {
      for (int k = 0; k < from.count(i); ++k) {
        const auto& sample = from.at(i, k);
        to.push_back({(sample.at - planning::ProfileMatch::kWindow) * kDegrees, sample.mm * 1e-3});
      }
    };
    take(spin.first, beam.first);
    take(spin.last, beam.last);
    picture.beams.push_back(beam);
  }
  return picture;
}

DriveReport report_of(const DriveOptions& o, const DriveRobot& robot, const calibration::Procedure& done,
                      const calibration::WheelErrors& errors, std::uint64_t seed) {
  DriveReport report;
  report.source = fmt::format("simulated robot, seed {}, spin in the scene {}", seed, o.scene);
  report.robot = o.robot;
  report.before = robot.params;
  report.steps = done.steps;
  report.values = done.values;
  report.refused = done.refused;
  report.truth = errors;
  return report;
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

int simulate_drive(const DriveOptions& o) {
  const DriveRobot robot = read_robot_of(o);
  calibration::WheelErrors errors = calibration::draw({}, o.seed);
  if (!o.truth.empty()) {
    Params real = robot.params;
    apply_robot_file(real, o.truth);
    errors = errors_of(robot.params, real);
  }
  const calibration::Procedure done =
      calibration::play(robot.params, robot.sensor, robot.noise, errors, plan_of(o), o.seed);
  if (!o.svg.empty()) files::write(o.svg, report::spin_svg(picture_of(done.spin, robot.params)));
  return print_drive(o, report_of(o, robot, done, errors, o.seed));
}

int simulate_drives(const DriveOptions& o) {
  const DriveRobot robot = read_robot_of(o);
  std::vector<DriveTrial> all(o.count);
  all.resize(in_parallel(o.count, o.jobs, [&](std::uint64_t i) {
    const std::uint64_t seed = o.seed + i;
    const calibration::WheelErrors errors = calibration::draw({}, seed);
    const calibration::Procedure done =
        calibration::play(robot.params, robot.sensor, robot.noise, errors, plan_of(o), seed);
    all[i] = {report_of(o, robot, done, errors, seed), done.complete()};
  }));
  const Interrupted interrupted(fmt::format(" after {} of {} robots", all.size(), o.count));
  if (all.empty()) throw interrupted;
  if (o.json) {
    print_object(drive_trials_json(all), {o.seed, {}, o.robot, robot_digest(robot.params)});
  } else {
    fmt::print("{} robots, seeds {} to {}, spin in the scene {}\n\n{}", all.size(), o.seed,
               o.seed + all.size() - 1, o.scene, drive_trials_words(all));
  }
  if (all.size() < o.count) throw interrupted;
  return 0;
}

}  // namespace whisker::cli
