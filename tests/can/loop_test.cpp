#include "tests/can/loop.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "host/worlds/generate.hpp"

namespace whisker {
namespace {

class EveryWorld : public testing::TestWithParam<worlds::Kind> {};

Scenario scenario_of(worlds::Kind kind) {
  worlds::Options options;
  options.seed = 3;
  options.noise = true;
  Scenario s = worlds::generate(kind, options);
  s.time_limit_s = 60;
  return s;
}

TEST_P(EveryWorld, TheTrajectoryOverTheBusIsTheOneInProcess) {
  const Scenario scenario = scenario_of(GetParam());
  bus::MemoryBus wire;
  const auto over_bus =
      test::drive_over_bus(scenario, PlannerKind::skirt, can::Pace::lockstep, wire.attach(), wire.attach());
  const RunResult direct = run(scenario);
  EXPECT_EQ(over_bus.result.hash, direct.hash);
  EXPECT_EQ(over_bus.result.ticks, direct.ticks);
  EXPECT_EQ(over_bus.result.verdict, direct.verdict);
  EXPECT_EQ(over_bus.result.detail, direct.detail);
  EXPECT_GT(direct.ticks, 100U);
}

TEST_P(EveryWorld, TheTrajectoryIsTheSameWithTwoPercentOfTheFramesDropped) {
  const Scenario scenario = scenario_of(GetParam());
  bus::MemoryBus wire;
  test::LossyPort base(wire.attach(), 1), controller(wire.attach(), 2);
  const auto over_bus =
      test::drive_over_bus(scenario, PlannerKind::skirt, can::Pace::lockstep, base, controller);
  const RunResult direct = run(scenario);
  EXPECT_EQ(over_bus.result.hash, direct.hash);
  EXPECT_EQ(over_bus.result.ticks, direct.ticks);
  EXPECT_GT(over_bus.figures.resent, direct.ticks / 20);
  EXPECT_GT(base.dropped() + controller.dropped(), direct.ticks / 10);
  EXPECT_EQ(over_bus.figures.health.stops, 0U);
}

TEST_P(EveryWorld, InRealTimeWithoutAMissToo) {
  const Scenario scenario = scenario_of(GetParam());
  bus::MemoryBus wire;
  const auto over_bus =
      test::drive_over_bus(scenario, PlannerKind::thesis, can::Pace::real_time, wire.attach(), wire.attach());
  RunOptions options;
  options.planner = PlannerKind::thesis;
  const RunResult direct = run(scenario, options);
  EXPECT_EQ(over_bus.figures.misses, 0U);
  EXPECT_EQ(over_bus.result.hash, direct.hash);
}

TEST(Lockstep, ABaseThatLosesSightOfTheControllerDrivesTheSame) {
  const Scenario scenario = scenario_of(worlds::Kind::discs);
  bus::MemoryBus wire;
  test::Slowness slow;
  slow.base_stalls = 37;
  const auto over_bus = test::drive_over_bus(scenario, PlannerKind::skirt, can::Pace::lockstep, wire.attach(),
                                             wire.attach(), slow);
  EXPECT_EQ(over_bus.result.hash, run(scenario).hash);
  EXPECT_EQ(over_bus.figures.health.stops, 0U);
  EXPECT_GT(*std::max_element(over_bus.figures.round_trip_us.begin(), over_bus.figures.round_trip_us.end()),
            slow.stall_us);
}

TEST(Lockstep, ASlowControllerGetsFewSetsTwice) {
  const Scenario scenario = scenario_of(worlds::Kind::discs);
  bus::MemoryBus wire;
  test::Slowness slow;
  slow.controller = 25;
  const auto over_bus = test::drive_over_bus(scenario, PlannerKind::skirt, can::Pace::lockstep, wire.attach(),
                                             wire.attach(), slow);
  EXPECT_EQ(over_bus.result.hash, run(scenario).hash);
  EXPECT_LE(over_bus.figures.resent, 10U);
  EXPECT_GT(over_bus.figures.sets, 1000U);
}

INSTANTIATE_TEST_SUITE_P(Worlds, EveryWorld, testing::ValuesIn(worlds::kKinds));

}  // namespace
}  // namespace whisker
