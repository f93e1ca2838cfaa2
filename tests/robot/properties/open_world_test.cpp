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

/// On a board that does what the parameters say, in an open world. Empty, or what is wrong.
std::string arrives(std::uint64_t seed) {
  Bits bits(seed);
  const Params params = random_params(bits);
  LaggingBoard board(params);
  planning::ThesisPlanner planner(params, fuzzy::kDefaultTable);
  Robot robot(board, board, planner, params);
  Watch watch(params);
  const Length tolerance = max(50_mm, params.motion.drive_tolerance * 4);
  const planning::Goal goal{{millimetres(bits.whole(-900, 900)), millimetres(bits.whole(-900, 900))},
                            tolerance};
  robot.set_goal(goal);
  Time now;
  int ticks = 0;
  while (robot.status().decision.outcome < planning::Outcome::reached &&
         robot.status().health.fault == Fault::none && ++ticks < 200000) {
    now = now + params.safety.period;
    const std::string broken = watch.see(robot.tick(now), params.safety.period, false);
    if (!broken.empty()) return broken;
    board.pass();
  }
  const planning::Decision& d = robot.status().decision;
  if (d.why == planning::Why::step_budget && params.thesis.max_steps < 1000) return "";
  if (d.outcome == planning::Outcome::reached && norm(robot.status().pose.at - goal.at) <= tolerance)
    return "";
  return std::string(name(robot.status().health.fault)) + ", " + planning::name(d.mode) + ", " +
         planning::name(d.why) + " after " + std::to_string(ticks) + " ticks";
}

// What check() accepts can work: the robot arrives, or says that its steps are used up.
RC_GTEST_PROP(OpenWorld, EveryAcceptedParameterSetArrives, (std::uint64_t seed)) {
  const std::string wrong = arrives(seed);
  if (!wrong.empty()) RC_FAIL(wrong);
}

// Wheels of 0.02 m/s, 2 m apart: a quarter of a turn takes 80 s.
TEST(OpenWorld, SlowWheelsFarApartHaveTheTimeToTurn) { EXPECT_EQ(arrives(103288), ""); }

}  // namespace
}  // namespace whisker::test
