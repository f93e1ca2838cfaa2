// The robot as a function of values drives like the one with driver classes.
#include <memory>

#include <gtest/gtest.h>

#include "firmware/params/presets.hpp"
#include "firmware/simple_robot.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/harness/worlds/generate.hpp"

namespace whisker {
namespace {

class PilotOfValues final : public Pilot {
 public:
  PilotOfValues(const Scenario& scenario, sim::Plant& plant) : plant_(plant), robot_(scenario.robot) {
    robot_.place(fixed_pose(scenario.start));
    const planning::Goal goal = fixed_goal(scenario.goal);
    robot_.go_to(goal.at, goal.tolerance);
  }
  const Status& tick(Time now) override {
    Inputs in{now, plant_.encoders(), plant_.ranges()};
    in.bumper = plant_.bumper();
    in.gyro = plant_.gyro();
    in.has_bumper = true;
    in.has_gyro = plant_.gyro_answers();
    const Outputs out = robot_.tick(in);
    plant_.command(out.wheels);
    EXPECT_EQ(out.fault, robot_.status().health.fault);
    EXPECT_EQ(out.outcome, robot_.status().decision.outcome);
    return robot_.status();
  }

 private:
  sim::Plant& plant_;
  RobotOfValues robot_;
};

void expect_the_same_drive(const Scenario& scenario) {
  RunOptions options;
  const RunResult by_drivers = run(scenario, options);
  options.pilot = [](const Scenario& s, PlannerKind, sim::Plant& plant) -> std::unique_ptr<Pilot> {
    return std::make_unique<PilotOfValues>(s, plant);
  };
  const RunResult by_values = run(scenario, options);
  EXPECT_EQ(by_values.hash, by_drivers.hash) << scenario.name;
  EXPECT_EQ(by_values.ticks, by_drivers.ticks) << scenario.name;
  EXPECT_EQ(by_values.verdict, by_drivers.verdict) << scenario.name;
}

TEST(RobotOfValues, DrivesLikeOneWithDrivers) {
  for (const worlds::Kind kind : {worlds::Kind::discs, worlds::Kind::u_trap, worlds::Kind::maze,
                                  worlds::Kind::rooms, worlds::Kind::spiral, worlds::Kind::enclosed}) {
    for (const bool noise : {false, true}) {
      worlds::Options options;
      options.seed = 3;
      options.noise = noise;
      expect_the_same_drive(worlds::generate(kind, options));
    }
  }
}

TEST(RobotOfValues, HasGyroAndBumper) {
  worlds::Options options;
  options.seed = 5;
  options.noise = true;
  Scenario s = worlds::generate(worlds::Kind::discs, options);
  s.robot.gyro.fitted = Fitted::yes;
  s.robot.bumper.fitted = Fitted::yes;
  s.robot.pose_error.wheel_scale = millionths(2000);
  expect_the_same_drive(s);
}

void expect_the_same_robot(const Sensors& sensors, const char* file) {
  const Params preset = params_of({}, {}, sensors);
  Scenario s;
  apply_robot_file(s.robot, std::string(WHISKER_SOURCE_DIR) + "/host/robots/" + file);
  const auto made = param_list(preset), loaded = param_list(s.robot);
  ASSERT_EQ(made.size(), loaded.size());
  for (std::size_t i = 0; i < made.size(); ++i) EXPECT_EQ(made[i].raw, loaded[i].raw) << made[i].key;
}

TEST(Presets, AreTheRobotsOfTheirFiles) {
  expect_the_same_robot(hc_sr04(Angle::turns(375, 3600)), "hc-sr04.toml");
  expect_the_same_robot(vl53l0x(30_deg), "vl53l0x.toml");
  expect_the_same_robot(vl53l1x(30_deg), "vl53l1x.toml");
}

}  // namespace
}  // namespace whisker
