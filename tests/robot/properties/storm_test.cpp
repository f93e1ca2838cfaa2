#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cstdint>

#include "firmware/planning/thesis/thesis_planner.hpp"
#include "firmware/robot.hpp"
#include "tests/robot/properties/random_params.hpp"
#include "tests/robot/properties/storm_board.hpp"
#include "tests/robot/properties/watch.hpp"

namespace whisker::test {
namespace {

/// Mostly the promised period; sometimes late, rarely a jump in either direction.
Time next_tick(Time now, const Params& params, Bits& bits) {
  if (bits.one_in(1000)) return Time::from_raw(static_cast<std::uint32_t>(bits.next()));
  if (bits.one_in(10)) return now + milliseconds(bits.whole(1, longest_gap(params).raw()));
  return now + params.safety.period;
}

planning::Goal random_goal(Bits& bits) {
  if (bits.one_in(20)) {
    const auto any = [&] { return Length::from_raw(static_cast<std::int32_t>(bits.next())); };
    return {{any(), any()}, any()};
  }
  const auto near = [&] { return millimetres(bits.whole(-4000, 4000)); };
  return {{near(), near()}, millimetres(bits.whole(0, 300))};
}

/// True: it was reset, and its next tick is a first one.
bool interfere(Robot& robot, Watch& watch, Bits& bits) {
  if (bits.one_in(300)) robot.set_goal(random_goal(bits));
  if (bits.one_in(700)) robot.cancel();
  if (bits.one_in(900)) {
    robot.place({{Length::from_raw(static_cast<std::int32_t>(bits.next())), millimetres(bits.whole(-9, 9))},
                 Angle::from_raw(static_cast<std::uint32_t>(bits.next()))});
  }
  if (robot.status().health.fault != Fault::none && bits.one_in(100)) {
    robot.reset();
    robot.set_goal(random_goal(bits));
    watch.forgive();
    return true;
  }
  return false;
}

// With any accepted parameters and any board, a run of up to a minute satisfies every check of Watch, and the
// sanitizers find no undefined behaviour.
RC_GTEST_PROP(Storm, NoBoardBreaksAPromise, (std::uint64_t seed)) {
  Bits bits(seed);
  const Params params = random_params(bits);
  const int ticks = *rc::gen::inRange(1, 6000);
  StormBoard board(Bits(bits.next()), params, *rc::gen::inRange(0, 4));
  planning::ThesisPlanner planner(params, fuzzy::kDefaultTable);
  Robot robot(board, board, planner, params);
  Watch watch(params);
  robot.set_goal(random_goal(bits));
  Time now = Time::from_raw(static_cast<std::uint32_t>(bits.next()));
  bool first = true;
  for (int i = 0; i < ticks; ++i) {
    const Time before = now;
    now = next_tick(now, params, bits);
    const Status& status = robot.tick(now);
    const Duration gap = first || now - before <= Duration{} ? params.safety.period : now - before;
    const std::string broken = watch.see(status, min(gap, longest_gap(params)), board.refused());
    if (!broken.empty()) RC_FAIL("tick " + std::to_string(i) + ": " + broken);
    board.pass();
    first = interfere(robot, watch, bits);
  }
  RC_CLASSIFY(robot.status().health.fault != Fault::none, whisker::name(robot.status().health.fault));
}

}  // namespace
}  // namespace whisker::test
