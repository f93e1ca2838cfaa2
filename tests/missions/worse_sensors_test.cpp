// Robots whose rangefinders do less than the parameters say, in worlds that are hard for them.
#include <gtest/gtest.h>

#include <cstdint>

#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::test {
namespace {

Scenario world_of(worlds::Kind kind, std::uint64_t seed, int discs = 0) {
  worlds::Options options;
  options.seed = seed;
  if (discs != 0) options.discs = discs;
  return worlds::generate(kind, options);
}

RunResult skewed(Scenario scenario) {
  scenario.sensor.skew_deg = 5;
  return run(scenario);
}

TEST(WorseSensors, EchoesBesideTheConesDoNotKeepASkewedRobotFromItsGoal) {
  EXPECT_EQ(skewed(world_of(worlds::Kind::rooms, 610007)).verdict, Verdict::reached);
  EXPECT_EQ(skewed(world_of(worlds::Kind::discs, 610039, 50)).verdict, Verdict::reached);
}

TEST(WorseSensors, ConesNarrowerThanStatedLeadToNoContactHere) {
  for (const std::uint64_t seed : {UINT64_C(620001), UINT64_C(620016)}) {
    Scenario scenario = world_of(worlds::Kind::discs, seed, 50);
    scenario.sensor.cone_deg = 17.5;
    EXPECT_EQ(run(scenario).verdict, Verdict::reached) << seed;
  }
}

// Here a beam shows a disc for a second, and a true cell of the ground behind it is not clear.
TEST(WorseSensors, WhatABeamShowsIsNotTouchedWhereWallsVanish) {
  struct Case {
    std::uint64_t seed;
    Angle cones_apart;  // the left axis from the right one
    Angle incidence;
  };
  const Case cases[] = {{1400262, 95_deg, 60_deg}, {1400658, 95_deg, 60_deg}, {1400641, 85_deg, 40_deg}};
  for (const Case& c : cases) {
    Scenario scenario = world_of(worlds::Kind::discs, c.seed, 30);
    scenario.robot.rangefinders.side_angle = Angle::from_raw(c.cones_apart.raw() / 2);
    scenario.robot.rangefinders.incidence = c.incidence;
    scenario.sensor.incidence_deg = report::degrees(c.incidence);
    EXPECT_EQ(run(scenario).verdict, Verdict::reached) << c.seed;
  }
}

TEST(WorseSensors, DistancesBeyondTheMaximumRangeAreClearInEveryRespect) {
  for (const worlds::Kind kind : {worlds::Kind::rooms, worlds::Kind::u_trap, worlds::Kind::discs}) {
    Scenario scenario = world_of(kind, 9);
    scenario.robot.rangefinders.max_range = 1200_mm;
    const RunResult clear = run(scenario);
    scenario.sensor.max_range_m = 6;
    scenario.sensor.far_is = Far::distance;
    const RunResult far = run(scenario);
    EXPECT_EQ(clear.verdict, Verdict::reached) << scenario.name;
    EXPECT_EQ(far.hash, clear.hash) << scenario.name;
    // Readings that are 10 % too long may lead to a contact, but are not lost.
    scenario.sensor.scale = 1.1;
    EXPECT_NE(run(scenario).verdict, Verdict::fault) << scenario.name;
  }
}

TEST(WorseSensors, ThreeMissesInTenReadingsLeadToNoContact) {
  Scenario scenario = world_of(worlds::Kind::maze, 610025);
  scenario.noise.range_false_clear = 0.3;
  EXPECT_EQ(run(scenario).verdict, Verdict::reached);
}

}  // namespace
}  // namespace whisker::test
