#include "host/cli/calibrate_drive_options.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/scenario/load.hpp"

namespace whisker::cli {
namespace {

std::vector<std::string_view> scene_names() {
  std::vector<std::string_view> names;
  for (int i = 0; i < calibration::kScenes; ++i) names.emplace_back(name(static_cast<calibration::Scene>(i)));
  return names;
}

/// That of the robot file, and with --noise what worlds with noise have.
Noise noise_of(const DriveOptions& o, Noise noise) {
  if (!o.noise) return noise;
  noise.range_sigma_m = 0.01;
  noise.range_dropout = 0.02;
  noise.range_false_clear = 0.01;
  noise.heading_drift_deg_per_sqrt_m = 0.3;
  return noise;
}

}  // namespace

calibration::Scene scene_of(const std::string& word) {
  const auto names = scene_names();
  const auto at = std::find(names.begin(), names.end(), word);
  if (at == names.end())
    throw UsageError(fmt::format("--scene {}: discs, wall or room{}", word, did_you_mean(word, names)));
  return static_cast<calibration::Scene>(at - names.begin());
}

calibration::ProcedurePlan plan_of(const DriveOptions& o) {
  calibration::ProcedurePlan plan;
  plan.scene = scene_of(o.scene);
  plan.straight_m = o.straight_m.value_or(plan.straight_m);
  plan.side_m = o.side_m.value_or(plan.side_m);
  plan.squares = o.squares.value_or(plan.squares);
  return plan;
}

DriveRobot read_robot_of(const DriveOptions& o) {
  Scenario scenario;
  apply_robot_file(scenario, o.robot);
  return {scenario.robot, scenario.sensor, noise_of(o, scenario.noise)};
}

int print_drive(const DriveOptions& o, const DriveReport& report) {
  if (o.json) {
    Provenance p;
    if (report.truth) p.seed = o.seed;
    p.robot_name = o.robot;
    p.robot_digest = robot_digest(report.before);
    fmt::print("{}\n", with_provenance(drive_json(report), p));
  } else {
    std::FILE* const out = words_beside({o.svg});
    fmt::print(out, "{}", drive_words(report));
    if (!o.svg.empty()) fmt::print(out, "\npicture: {}\n", o.svg);
  }
  return print_failures(report);
}

}  // namespace whisker::cli
