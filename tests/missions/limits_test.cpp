// Every limit of the wheels holds in every tick, with every planner.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "host/worlds/generate.hpp"
#include "tests/missions/bench.hpp"

namespace whisker::test {
namespace {

std::vector<PlannerKind> planners_with_usual_maps() {
  std::vector<PlannerKind> kinds;
  for (const PlannerKind kind : planners()) {
    if (kind.map_bytes == 0 || kind == PlannerKind::map) kinds.push_back(kind);
  }
  return kinds;
}

class LimitsOf : public testing::TestWithParam<PlannerKind> {
 protected:
  struct Most {
    double speed = 0;         // m/s, of a wheel
    double acceleration = 0;  // m/s^2, of a wheel
    double turn_rate = 0;     // rad/s
  };
  /// Drives through a world of discs; returns the maximum of the commands.
  Most drive(const Params& robot) {
    EXPECT_EQ(check(robot), ParamFault::none);
    worlds::Options options;
    options.seed = 11;
    Scenario scenario = worlds::generate(worlds::Kind::discs, options);
    scenario.robot = robot;
    Bench bench(scenario, GetParam());
    Most most;
    hal::WheelSpeeds last{};
    while (bench.plant().time() < (must_arrive() ? 1800 : 90) && bench.step(10)) {
      const hal::WheelSpeeds now = bench.status().command;
      const double left = now.left * 1e-4, right = now.right * 1e-4;
      const double track = robot.body.track.raw() * 1e-6;
      most.speed = std::fmax(most.speed, std::fmax(std::fabs(left), std::fabs(right)));
      most.turn_rate = std::fmax(most.turn_rate, std::fabs(right - left) / track);
      const double change =
          std::fmax(std::abs(now.left - last.left), std::abs(now.right - last.right)) * 1e-4;
      most.acceleration = std::fmax(most.acceleration, change / 0.01);
      last = now;
    }
    ended_ = bench.ended();
    return most;
  }
  // The other planners may fail in this world; 90 s are enough to test their limits.
  static bool must_arrive() { return GetParam() == PlannerKind::skirt || GetParam() == PlannerKind::map; }

  std::string ended_;
};

// Resolution of the commands: 0.1 mm/s per wheel.
constexpr double kWire = 0.0001;

TEST_P(LimitsOf, TheWheels) {
  for (const int mm_per_s : {80, 300}) {
    for (const int mrad_per_s : {100, 400, 3000}) {
      for (const int mm_per_s2 : {200, 1000}) {
        Params robot;
        robot.wheels.max_speed = Speed::from_raw(mm_per_s * 1000);
        robot.wheels.max_turn_rate = AngularRate::from_raw(mrad_per_s * 1000);
        robot.wheels.max_acceleration = Acceleration::from_raw(mm_per_s2 * 1000);
        robot.safety.stalled_after = 4000_ms;
        const Most most = drive(robot);
        SCOPED_TRACE(std::to_string(mm_per_s) + " mm/s, " + std::to_string(mrad_per_s) + " mrad/s, " +
                     std::to_string(mm_per_s2) + " mm/s2: " + ended_);
        EXPECT_LE(most.speed, mm_per_s * 1e-3 + kWire);
        EXPECT_LE(most.turn_rate, mrad_per_s * 1e-3 + 2 * kWire / 0.14);
        EXPECT_LE(most.acceleration, mm_per_s2 * 1e-3 + 2 * kWire / 0.01);
        EXPECT_GT(most.turn_rate, 0.8 * std::fmin(mrad_per_s * 1e-3, std::fmin(2.5, mm_per_s * 1e-3 / 0.07)));
        if (must_arrive()) {
          EXPECT_EQ(ended_, "reached");
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Planner, LimitsOf, testing::ValuesIn(planners_with_usual_maps()),
                         [](const auto& of) {
                           std::string text = name(of.param);
                           for (char& c : text) c = c == '-' ? '_' : c;
                           return text;
                         });

}  // namespace
}  // namespace whisker::test
