// What each kind of event does to a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/can/loop.hpp"
#include "tests/events/scene.hpp"

namespace whisker::test {
namespace {

struct Driven {
  RunResult result;
  std::vector<TickRecord> records;
};

Driven drive(const Scenario& scenario, PlannerKind planner = kDefaultPlanner) {
  Driven run;
  RunOptions options;
  options.planner = planner;
  options.watch = [&](const Moment& moment) { run.records.push_back(moment.record); };
  run.result = whisker::run(scenario, options);
  return run;
}

const TickRecord& at(const Driven& run, double t_s) {
  return *std::find_if(run.records.begin(), run.records.end(),
                       [&](const TickRecord& r) { return r.t_s >= t_s - 1e-9; });
}

double speed(const TickRecord& r) { return (r.v_left_mps + r.v_right_mps) / 2; }
double wrong_by(const TickRecord& r) { return std::hypot(r.est_x_m - r.x_m, r.est_y_m - r.y_m); }

TEST(Events, NoneChangesNothing) {
  const RunResult plain = whisker::run(scene(""));
  const RunResult late = whisker::run(scene(event(80, "cancel")));
  EXPECT_EQ(plain.verdict, Verdict::reached);
  EXPECT_EQ(late.verdict, Verdict::reached);
  EXPECT_EQ(late.hash, plain.hash);
  EXPECT_FALSE(plain.events);
  ASSERT_TRUE(late.events);
  EXPECT_EQ(late.events->played + late.events->refused, 0U);
}

TEST(Events, AGoalReplacesTheOneOfTheFileAndIsTheOneThatIsJudged) {
  const Driven run = drive(scene(event(4, "goal", kBack + "tolerance_m = 0.05\n")));
  EXPECT_EQ(run.result.verdict, Verdict::reached);
  EXPECT_LE(run.result.final_distance_m, 0.05);
  EXPECT_NEAR(run.records.back().y_m, -1, 0.05);
  EXPECT_EQ(run.result.goal_tolerance_m, 0.05);
}

TEST(Events, AGoalAfterTheFirstOneWasReachedIsAwaited) {
  const Driven run = drive(scene(event(40, "goal", kBack)));
  EXPECT_EQ(run.result.verdict, Verdict::reached);
  EXPECT_NEAR(at(run, 39.9).x_m, 3, 0.11);
  EXPECT_EQ(at(run, 39.9).command.left, 0);
  EXPECT_NEAR(run.records.back().y_m, -1, 0.11);
}

TEST(Events, AGoalAfterTheTimeLimitIsNotAwaited) {
  EXPECT_EQ(whisker::run(scene(event(91, "goal", kBack))).hash, whisker::run(scene("")).hash);
}

TEST(Events, ComeInTheOrderOfTimeAndThenOfTheFile) {
  const std::string unsorted =
      event(5, "goal", "x_m = 1\ny_m = -1\n") + event(4, "cancel") + event(5, "goal", kBack);
  const Driven run = drive(scene(unsorted));
  EXPECT_EQ(run.result.verdict, Verdict::reached);
  EXPECT_NEAR(run.records.back().x_m, 0, 0.11);
  EXPECT_EQ(run.result.events->played, 3U);
}

TEST(Events, AfterACancelItStandsAndGivesUpUnlessAGoalFollows) {
  const Driven run = drive(scene(event(4, "cancel")));
  EXPECT_EQ(run.result.verdict, Verdict::gave_up);
  EXPECT_EQ(run.result.detail, "no_goal");
  EXPECT_LT(run.result.time_s, 6);
  EXPECT_EQ(run.records.back().command.left, 0);
  EXPECT_EQ(whisker::run(scene(event(4, "cancel") + event(9, "goal", kBack))).verdict, Verdict::reached);
}

TEST(Events, ACorrectionMayTellTheTruthOrLie) {
  const std::string sigmas = "[noise]\nwheel_scale_sigma = 0.05\n";
  EXPECT_GT(wrong_by(at(drive(scene("", sigmas)), 6)), 0.005);
  EXPECT_LT(wrong_by(at(drive(scene(event(6, "correct"), sigmas)), 6)), 0.004);
  const Driven lied = drive(scene(event(6, "correct", "x_m = 0.5\ny_m = 0.3\nheading_deg = 0\n")));
  EXPECT_GT(wrong_by(at(lied, 6.01)), 0.2);
  EXPECT_EQ(lied.result.verdict, Verdict::off_goal);
}

TEST(Events, APlaceMovesTheEstimate) {
  const Driven run = drive(scene(event(6, "place", "y_m = 0.4\n")));
  EXPECT_NEAR(at(run, 6.01).est_y_m - at(run, 6.01).y_m, 0.4, 0.02);
  EXPECT_NEAR(at(run, 6.01).est_x_m, at(run, 6.01).x_m, 0.02);
  EXPECT_EQ(run.result.verdict, Verdict::off_goal);
}

TEST(Events, AResetNeedsANewGoal) {
  EXPECT_EQ(whisker::run(scene(event(4, "reset"))).detail, "no_goal");
  EXPECT_EQ(whisker::run(scene(event(4, "reset") + event(8, "goal", kBack))).verdict, Verdict::reached);
}

TEST(Events, AParameterWaitsForTheNextStart) {
  const std::string slow = event(3, "param", "name = \"wheel_speed_max_mps\"\nvalue = 0.1\n");
  const RunResult waits = whisker::run(scene(slow));
  EXPECT_EQ(waits.hash, whisker::run(scene("")).hash);
  EXPECT_EQ(waits.events->played, 1U);
  for (const std::string& start : {event(4, "restart"), event(4, "goal", "x_m = 3\ny_m = 0\n")}) {
    const Driven run = drive(scene(slow + start));
    EXPECT_GT(speed(at(run, 3.5)), 0.2);
    for (const TickRecord& r : run.records) EXPECT_TRUE(r.t_s < 5.5 || speed(r) < 0.101) << r.t_s;
    EXPECT_EQ(run.result.verdict, Verdict::reached);
  }
}

TEST(Events, AParameterThatDoesNotFitIsRefusedAndTheRobotGoesOn) {
  const std::string wide = event(3, "param", "name = \"wheel_track_m\"\nvalue = 1\n");
  const RunResult result = whisker::run(scene(wide));
  EXPECT_EQ(result.events->refused, 1U);
  EXPECT_EQ(result.hash, whisker::run(scene("")).hash);
  EXPECT_EQ(whisker::run(scene(wide + event(4, "restart"))).verdict, Verdict::reached);
}

TEST(Events, ATableThatIsNotLoadedOrThatAPlannerLacksIsRefused) {
  EXPECT_EQ(whisker::run(scene(event(3, "table", "name = \"default\"\n"))).events->played, 1U);
  EXPECT_EQ(whisker::run(scene(event(3, "table", "file = \"missing.toml\"\n"))).events->refused, 1U);
  RunOptions bug;
  bug.planner = *planner_named("bug2");
  EXPECT_EQ(whisker::run(scene(event(3, "table", "name = \"default\"\n")), bug).events->refused, 1U);
}

TEST(Events, ATableDrivesFromTheNextStartOn) {
  fuzzy::Bilinear::Table steady = fuzzy::kResponseTable;
  for (auto& row : steady.node) {
    for (auto& node : row) node = steady.node[0][0];
  }
  const auto hash = [&](const std::string& events) {
    Scenario s =
        scene(event(0.5, "table", "file = \"steady.toml\"\n") + events, "[robot]\nbend_course = true\n");
    s.discs[0].center.y = 0.2;
    const std::uint64_t own = whisker::run(s).hash;
    s.events[0].table = &steady;
    return std::pair(whisker::run(s).hash, own);
  };
  const auto waits = hash(""), started = hash(event(1, "restart"));
  EXPECT_EQ(waits.first, waits.second);
  EXPECT_NE(started.first, started.second);
}

TEST(Events, LostFramesStopTheWheelsAndTheMissionIsResumed) {
  const Driven run = drive(scene(event(4, "frames_lost", "for_s = 3\n")));
  EXPECT_GT(speed(at(run, 4.03)), 0.25) << "the base holds the last command";
  for (const TickRecord& r : run.records) {
    if (r.t_s > 5 && r.t_s < 7) {
      EXPECT_NEAR(speed(r), 0, 1e-3) << r.t_s;
    }
  }
  EXPECT_EQ(run.result.verdict, Verdict::reached);
}

TEST(Events, AShortLossIsALongGap) {
  for (const char* for_s : {"for_s = 0.01\n", "for_s = 0.03\n", "for_s = 0.04\n"}) {
    const Driven run = drive(scene(event(4, "frames_lost", for_s)));
    EXPECT_EQ(run.result.verdict, Verdict::reached) << for_s;
    EXPECT_EQ(run.result.events->played, 1U);
    EXPECT_GT(speed(at(run, 4.05)), 0.1) << "the base does not brake";
  }
}

TEST(Events, ALossUntilTheEndEndsWithTheTime) {
  const RunResult result = whisker::run(scene(event(4, "frames_lost", "for_s = 1e6\n")));
  EXPECT_EQ(result.detail, "time_limit");
  EXPECT_EQ(result.verdict, Verdict::gave_up);
}

TEST(Events, WaitWhileFramesAreLost) {
  const Driven run = drive(scene(event(4, "frames_lost", "for_s = 3\n") + event(5, "goal", kBack)));
  EXPECT_EQ(run.result.verdict, Verdict::reached);
  EXPECT_NEAR(run.records.back().y_m, -1, 0.11);
}

TEST(Events, ARestartBrakesAndDrivesOnFromTheTruePose) {
  const std::string noise = "[noise]\nwheel_scale_sigma = 0.05\n";
  const Driven run = drive(scene(event(4, "restart"), noise));
  const auto stood = std::find_if(run.records.begin(), run.records.end(), [](const TickRecord& r) {
    return r.t_s > 4 && std::fabs(speed(r)) < 1e-3;
  });
  ASSERT_NE(stood, run.records.end());
  EXPECT_GT(wrong_by(at(run, 3.9)), 0.005);
  EXPECT_LT(wrong_by(at(run, stood->t_s + 0.02)), 0.002);
  EXPECT_EQ(run.result.events->played, 1U);
}

TEST(Events, ARestartEndsAFault) {
  const std::string lost = "[noise]\nrange_dropout = 1\n";
  Scenario s = scene(event(4, "restart"), lost);
  EXPECT_EQ(whisker::run(scene("", lost)).verdict, Verdict::fault);
  const RunResult result = whisker::run(s);
  EXPECT_EQ(result.verdict, Verdict::fault);
  EXPECT_GT(result.time_s, 4);
}

TEST(Events, AtTheFirstTickCount) {
  const RunResult moved = whisker::run(scene(event(0, "goal", kBack)));
  Scenario other = scene("");
  other.goal.at = {0, -1};
  other.start.heading = 0;
  EXPECT_EQ(moved.hash, whisker::run(other).hash);
}

TEST(Events, AnyMixtureEnds) {
  const char* const kinds[] = {"cancel", "reset", "restart", "correct", "place", "frames_lost"};
  for (int first = 0; first < 6; ++first) {
    for (int second = 0; second < 6; ++second) {
      const auto one = [&](double t_s, int kind) {
        return event(t_s, kinds[kind], kind == 5 ? "for_s = 0.5\n" : "");
      };
      const RunResult result =
          whisker::run(scene(one(3, first) + one(3.02, second) + event(6, "goal", kBack)));
      EXPECT_EQ(result.verdict, Verdict::reached) << kinds[first] << ' ' << kinds[second];
    }
  }
}

// The controller at the other end of a bus drives as the one in this process, also with events.

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
