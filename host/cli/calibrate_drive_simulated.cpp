#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "host/cli/calibrate_drive_output.hpp"
#include "host/cli/provenance.hpp"
#include "host/report/file.hpp"
#include "host/report/spin_svg.hpp"
#include "host/scenario/load.hpp"

namespace whisker::cli {
namespace {

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
  if (!o.svg.empty()) report::write_file(o.svg, report::spin_svg(picture_of(done.spin, robot.params)));
  return print_drive(o, report_of(o, robot, done, errors, o.seed));
}

int simulate_drives(const DriveOptions& o) {
  const DriveRobot robot = read_robot_of(o);
  std::vector<DriveTrial> all(o.count);
  std::atomic<std::uint64_t> next{0};
  const auto work = [&] {
    for (std::uint64_t i = next++; i < o.count; i = next++) {
      const std::uint64_t seed = o.seed + i;
      const calibration::WheelErrors errors = calibration::draw({}, seed);
      const calibration::Procedure done =
          calibration::play(robot.params, robot.sensor, robot.noise, errors, plan_of(o), seed);
      all[i] = {report_of(o, robot, done, errors, seed), done.complete()};
    }
  };
  const unsigned cores = std::max(std::thread::hardware_concurrency(), 1U);
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < (o.jobs > 0 ? static_cast<unsigned>(o.jobs) : cores); ++i)
    threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
  if (o.json) {
    Provenance p;
    p.seed = o.seed;
    p.robot_name = o.robot;
    p.robot_digest = robot_digest(robot.params);
    fmt::print("{}\n", with_provenance(drive_trials_json(all), p));
  } else {
    fmt::print("{} robots, seeds {} to {}, spin in the scene {}\n\n{}", o.count, o.seed, o.seed + o.count - 1,
               o.scene, drive_trials_words(all));
  }
  return 0;
}

}  // namespace whisker::cli
