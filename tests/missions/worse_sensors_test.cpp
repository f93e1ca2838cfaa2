// Robots whose rangefinders do less than the parameters say, in worlds that are hard for them.
#include <gtest/gtest.h>

#include <cstdint>

#include "host/run/runner.hpp"
#include "host/scenario/scenario.hpp"
#include "host/worlds/generate.hpp"

namespace whisker::test {
namespace {

Scenario world(worlds::Kind kind, std::uint64_t seed, int discs = 0) {
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
  EXPECT_EQ(skewed(world(worlds::Kind::rooms, 610007)).verdict, Verdict::reached);
  EXPECT_EQ(skewed(world(worlds::Kind::rooms, 610038)).verdict, Verdict::reached);
  EXPECT_EQ(skewed(world(worlds::Kind::discs, 610039, 50)).verdict, Verdict::reached);
}

TEST(WorseSensors, ConesNarrowerThanStatedLeadToNoContactHere) {
  for (const std::uint64_t seed : {620001, 620016}) {
    Scenario scenario = world(worlds::Kind::discs, seed, 50);
    scenario.sensor.cone_deg = 17.5;
    EXPECT_EQ(run(scenario).verdict, Verdict::reached) << seed;
  }
}

TEST(WorseSensors, ThreeMissesInTenReadingsLeadToNoContact) {
  Scenario scenario = world(worlds::Kind::maze, 610025);
  scenario.noise.range_false_clear = 0.3;
  EXPECT_EQ(run(scenario).verdict, Verdict::reached);
}

}  // namespace
}  // namespace whisker::test
