// The controller at the other end of a bus drives as the one in this process, also with events.
#include <gtest/gtest.h>

#include "tests/can/loop.hpp"
#include "tests/events/scene.hpp"

namespace whisker::test {
namespace {

const std::string kSlow = event(3, "param", "name = \"wheel_speed_max_mps\"\nvalue = 0.15\n");

RunResult run_on_a_bus(const Scenario& scenario) {
  bus::MemoryBus wire;
  hal::CanPort& base = wire.attach();
  hil::HostRules rules(kDefaultPlanner);
  hil::HostPlanners planners(kDefaultPlanner, &rules);
  const can::Identity identity{1, 77, 0, rules_digest(kDefaultPlanner)};
  can_app::Controller controller(wire.attach(), identity, planners, rules.server());
  SharedTime time([&](std::uint32_t now_ms) { controller.poll(now_ms); });
  hil::Figures figures;
  hil::BusOptions bus;
  bus.rules = identity.rules;
  RunOptions options;
  options.pilot = hil::bus_pilot(base, time, bus, figures);
  return run(scenario, options);
}

void expect_same(const Scenario& scenario) {
  const RunResult here = run(scenario);
  const RunResult there = run_on_a_bus(scenario);
  EXPECT_EQ(there.hash, here.hash);
  EXPECT_EQ(there.verdict, here.verdict);
  EXPECT_EQ(there.ticks, here.ticks);
  EXPECT_EQ(there.final_distance_m, here.final_distance_m);
  ASSERT_TRUE(here.events);
  EXPECT_EQ(there.events->played, here.events->played);
  EXPECT_EQ(there.events->refused, here.events->refused);
}

TEST(EventsOnABus, AGoal) { expect_same(scene(event(4, "goal", kBack))); }
TEST(EventsOnABus, AGoalAtTheStart) { expect_same(scene(event(0, "goal", kBack))); }
TEST(EventsOnABus, AGoalAfterTheOtherWasReached) { expect_same(scene(event(40, "goal", kBack))); }
TEST(EventsOnABus, ACancelAndAGoal) { expect_same(scene(event(4, "cancel") + event(8, "goal", kBack))); }
TEST(EventsOnABus, ACancelAlone) { expect_same(scene(event(4, "cancel"))); }
TEST(EventsOnABus, AFixThatLies) {
  expect_same(scene(event(4, "correct", "x_m = 0.9\ny_m = 0.1\nheading_deg = 4\nsigma_m = 0.05\n")));
}
TEST(EventsOnABus, ATrueFixWithSigmas) {
  const std::string noise = "[robot]\nwheel_scale_sigma = 0.02\n[noise]\nwheel_scale_sigma = 0.02\n";
  expect_same(scene(event(4, "correct", "sigma_m = 0.01\nsigma_deg = 1\n"), noise));
}
TEST(EventsOnABus, AParameterThatWaits) { expect_same(scene(kSlow)); }
TEST(EventsOnABus, AParameterAndAGoal) { expect_same(scene(kSlow + event(4, "goal", kBack))); }
TEST(EventsOnABus, AParameterAndARestart) { expect_same(scene(kSlow + event(4, "restart"))); }
TEST(EventsOnABus, AParameterThatDoesNotFit) {
  expect_same(scene(event(3, "param", "name = \"wheel_track_m\"\nvalue = 1\n") + event(4, "restart")));
}
TEST(EventsOnABus, ARestart) { expect_same(scene(event(4, "restart"))); }
TEST(EventsOnABus, ARestartWithNoise) {
  expect_same(scene(event(4, "restart"), "[noise]\nwheel_scale_sigma = 0.03\nrange_sigma_m = 0.01\n"));
}
TEST(EventsOnABus, ALoss) { expect_same(scene(event(4, "frames_lost", "for_s = 0.3\n"))); }
TEST(EventsOnABus, ALongLoss) { expect_same(scene(event(4, "frames_lost", "for_s = 5\n"))); }
TEST(EventsOnABus, ALossAtTheStart) { expect_same(scene(event(0, "frames_lost", "for_s = 1\n"))); }
TEST(EventsOnABus, AnotherTable) {
  fuzzy::Bilinear::Table other = fuzzy::kResponseTable;
  std::swap(other.node[2], other.node[5]);
  Scenario s = scene(event(3, "table", "file = \"other.toml\"\n") + event(4, "restart"));
  s.events[0].table = &other;
  expect_same(s);
}
TEST(EventsOnABus, AllOfThem) {
  expect_same(scene(event(2, "frames_lost", "for_s = 0.2\n") + kSlow + event(4, "correct") +
                    event(5, "goal", kBack) + event(7, "restart") + event(9, "cancel") +
                    event(12, "goal", "x_m = 1\ny_m = -1\n")));
}

TEST(EventsOnABus, ALossThatDoesNotStopTheBaseIsNoneInLockstep) {
  EXPECT_EQ(run_on_a_bus(scene(event(4, "frames_lost", "for_s = 0.03\n"))).hash, run(scene("")).hash);
}

TEST(EventsOnABus, APlaceAndAResetAreNoMessages) {
  const RunResult result = run_on_a_bus(scene(event(4, "place") + event(5, "reset")));
  EXPECT_EQ(result.events->refused, 2U);
  EXPECT_EQ(result.hash, run(scene("")).hash);
}

}  // namespace
}  // namespace whisker::test
