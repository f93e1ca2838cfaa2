// Every misbehaviour of a chip is a named error, never a hang.
#include <gtest/gtest.h>

#include <string>

#include "host/chip/chip_pilot.hpp"
#include "host/chip/messages.hpp"
#include "host/chip/process.hpp"
#include "host/run/runner.hpp"
#include "host/scenario/load.hpp"
#include "tests/unseen_disc.hpp"

namespace whisker::chip {
namespace {

std::string complaint(const std::string& command, PlannerKind planner = PlannerKind::skirt) {
  RunOptions options;
  options.planner = planner;
  options.pilot = chip_pilot(command);
  Scenario scenario =
      load_scenario(std::string(WHISKER_SOURCE_DIR) + "/host/worlds/scenarios/two_discs.toml");
  try {
    run(scenario, options);
  } catch (const ChipError& e) {
    return e.what();
  } catch (const NoRoom& e) {
    return std::string("no room: ") + e.what();
  } catch (const NoSuchPlanner& e) {
    return std::string("no such planner: ") + e.what();
  }
  return "";
}

TEST(ChipPilot, NamesWhatIsWrong) {
  EXPECT_EQ(complaint("exit 3"), "exit 3: the chip has ended");
  EXPECT_EQ(complaint("no_such_command 2>&-"), "no_such_command 2>&-: the chip has ended");
  EXPECT_EQ(complaint("yes"), "yes: speaks another version");
  EXPECT_EQ(complaint("printf '\\005\\000\\000\\010'"), "printf '\\005\\000\\000\\010': the chip has ended")
      << "after its greeting";
}

TEST(ChipPilot, RefusesAMapThatTheChipHasNoRoomFor) {
  // Reads the greeting before it ends; otherwise the host may find the pipe closed.
  const std::string chip = "head -c 1 >/dev/null; printf '\\005\\000\\000\\010'";
  EXPECT_EQ(complaint(chip, PlannerKind::map), chip + ": the chip has ended") << "2048 bytes are room enough";
  EXPECT_EQ(complaint(chip, core_planner("map", 4096)),
            "no room: " + chip + ": has room for 2048 bytes of map, not 4096");
}

TEST(ChipPilot, RefusesAPlannerThatNoChipHas) {
  const std::string chip = "head -c 1 >/dev/null; printf '\\005\\000\\000\\010'; cat >/dev/null";
  for (const PlannerKind kind : planners()) {
    if (!is_baseline(kind)) continue;
    EXPECT_EQ(complaint(chip, kind), "no such planner: " + name(kind) + ": no chip has this planner");
  }
}

TEST(ChipPilot, RefusesAnswersThatMakeNoSense) {
  EXPECT_EQ(complaint("printf '\\005\\000\\000\\010'; yes"), "the chip's answer makes no sense");
}

TEST(ChipPilot, DrivesAsTheCoreInThisProcess) {
  const Scenario scenario =
      load_scenario(std::string(WHISKER_SOURCE_DIR) + "/host/worlds/scenarios/two_discs.toml");
  for (const PlannerKind planner : {PlannerKind::skirt, PlannerKind::thesis, core_planner("map", 1024)}) {
    RunOptions options;
    options.planner = planner;
    const RunResult here = run(scenario, options);
    options.pilot = chip_pilot(WHISKER_REPLAY);
    const RunResult there = run(scenario, options);
    EXPECT_EQ(here.hash, there.hash);
    EXPECT_EQ(here.ticks, there.ticks);
    EXPECT_EQ(here.detail, there.detail);
  }
}

TEST(ChipPilot, HandsThePressesOfTheBumperOn) {
  const Scenario scenario = test::unseen_disc();
  RunOptions options;
  options.planner = PlannerKind::skirt;
  const RunResult here = run(scenario, options);
  options.pilot = chip_pilot(WHISKER_REPLAY);
  const RunResult there = run(scenario, options);
  EXPECT_EQ(here.verdict, Verdict::reached);
  EXPECT_GE(here.bumps.value_or(0), 1U);
  EXPECT_EQ(there.bumps, here.bumps);
  EXPECT_EQ(there.hash, here.hash);
}

TEST(ChipPilot, HandsTheGyroAndFixesOn) {
  Scenario scenario =
      load_scenario(std::string(WHISKER_SOURCE_DIR) + "/host/worlds/scenarios/two_discs.toml");
  scenario.noise.wheel_scale_sigma = 0.02;
  scenario.robot.pose_error.wheel_scale = millionths(3000);
  scenario.noise.fix_every_m = 0.5;
  scenario.noise.fix_sigma_m = 0.01;
  scenario.noise.fix_sigma_deg = 0.5;
  scenario.noise.gyro_bias_dps = 1;
  for (const Fitted gyro : {Fitted::no, Fitted::yes}) {
    for (const JumpPolicy policy : {JumpPolicy::accept, JumpPolicy::refuse}) {
      scenario.robot.gyro.fitted = gyro;
      scenario.robot.fix_jumps = policy;
      RunOptions options;
      const RunResult here = run(scenario, options);
      options.pilot = chip_pilot(WHISKER_REPLAY);
      const RunResult there = run(scenario, options);
      EXPECT_EQ(there.hash, here.hash);
      EXPECT_EQ(there.believed_distance_m, here.believed_distance_m);
      EXPECT_GT(here.ticks, 500U);
    }
  }
}

}  // namespace
}  // namespace whisker::chip
