#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cstdint>
#include <string>

#include "firmware/planning/thesis/thesis_planner.hpp"
#include "firmware/robot.hpp"
#include "tests/robot/properties/lagging_board.hpp"
#include "tests/robot/properties/random_params.hpp"
#include "tests/robot/properties/watch.hpp"

namespace whisker::test {
namespace {

struct Ending {
  std::string broken;  ///< the complaint of Watch
  std::string words;
  bool arrived = false;
  bool ended = false;
};

/// On a board that matches the parameters, in an open world.
Ending drive(const Params& params, Bits& bits) {
  LaggingBoard board(params);
  planning::ThesisPlanner planner(params, fuzzy::kDefaultTable);
  Robot robot(board, board, planner, params);
  Watch watch(params);
  const Length tolerance = max(50_mm, derived::drive_tolerance(params) * 4);
  const planning::Goal goal{{millimetres(bits.whole(-900, 900)), millimetres(bits.whole(-900, 900))},
                            tolerance};
  robot.set_goal(goal);
  Ending end;
  Time now;
  int ticks = 0;
  // Ten hours: wheels of 20 mm/s under a body of 1 m may turn in one place for two.
  while (!end.ended && std::int64_t{++ticks} * params.safety.period.raw() < 36000000) {
    now = now + params.safety.period;
    const Status& s = robot.tick(now);
    end.broken = watch.see(s, params.safety.period, false);
    end.ended = !end.broken.empty() || s.decision.outcome >= planning::Outcome::reached ||
                s.health.fault != Fault::none;
    board.pass();
  }
  const planning::Decision& d = robot.status().decision;
  const bool used_up = d.why == planning::Why::step_budget && derived::most_steps(params) < 1000;
  const bool there = norm(robot.status().pose.at - goal.at) <= tolerance;
  end.arrived = used_up || (d.outcome == planning::Outcome::reached && there);
  end.words = std::string(name(robot.status().health.fault)) + ", " + planning::name(d.mode) + ", " +
              planning::name(d.why) + " after " + std::to_string(ticks) + " ticks";
  return end;
}

RC_GTEST_PROP(OpenWorld, RobotsLikeTheReferenceArrive, (std::uint64_t seed)) {
  Bits bits(seed);
  const Params params = robot_like_the_reference(bits);
  const Ending end = drive(params, bits);
  RC_ASSERT(end.broken == "");
  if (!end.arrived) RC_FAIL(end.words);
}

// With the gain alone, these robots cannot stop a turn within its error.
TEST(OpenWorld, SluggishWheelsDoNotSwingForEver) {
  constexpr std::uint64_t kSeeds[] = {3803958774279, 14392240626399, 72459072658380,     573598,
                                      3541398869,    3699386720,     148554187851083066, 55972063073403098};
  for (const std::uint64_t seed : kSeeds) {
    Bits bits(seed);
    const Params params = robot_like_the_reference(bits);
    const Ending end = drive(params, bits);
    EXPECT_TRUE(end.arrived) << "seed " << seed << ": " << end.words;
  }
}

// Some robots see too little of the ground beside their path, so the guard holds them; they must report that.
// Some need a minute for a step, and the 4,000 that are allowed take days.
RC_GTEST_PROP(OpenWorld, EveryAcceptedParameterSetEndsWithAReason, (std::uint64_t seed)) {
  Bits bits(seed);
  Params params = random_params(bits);
  params.boundary.length_budget = max(1_m, derived::small_step(params) * 100);
  const Ending end = drive(params, bits);
  RC_ASSERT(end.broken == "");
  if (!end.ended) RC_FAIL(end.words);
  RC_CLASSIFY(end.arrived, "arrived");
}

}  // namespace
}  // namespace whisker::test
