#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cstdint>

#include "firmware/planning/thesis/thesis_planner.hpp"
#include "firmware/robot.hpp"
#include "tests/robot/properties/random_params.hpp"
#include "tests/robot/properties/storm_board.hpp"

namespace whisker::test {
namespace {

/// The same board with left and right exchanged.
class Mirrored final : public hal::Rangefinders, public hal::Drive {
 public:
  explicit Mirrored(StormBoard& board) : board_(board) {}
  bool read(hal::RangeReadings& out) noexcept override {
    hal::RangeReadings r{};
    if (!board_.read(r)) return false;
    out = {{r.beam[hal::kRight], r.beam[hal::kFront], r.beam[hal::kLeft]}};
    return true;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    hal::EncoderCounts c{};
    if (!board_.read(c)) return false;
    out = {c.right, c.left};
    return true;
  }
  bool command(hal::WheelSpeeds s) noexcept override { return board_.command({s.right, s.left}); }

 private:
  StormBoard& board_;
};

struct Side {
  Side(const Params& params, hal::Rangefinders& ranges, hal::Drive& drive)
      : planner(params, fuzzy::kDefaultTable), robot(ranges, drive, planner, params) {}
  planning::ThesisPlanner planner;
  Robot robot;
};

/// If both sides are equal, the planner starts on the left: in an exit search, after a narrow step without a
/// bias, and at the first of the unseen cells. From there on the two drives may differ.
bool may_differ(const planning::Decision& d) {
  return d.danger_count > 0 || d.why == planning::Why::unknown_ahead ||
         (d.mode == planning::Mode::probing && d.inputs.bias == Q7{});
}

/// The guard's cells are aligned with the world, not with the body: the granted part of a step may differ
/// slightly, and so may what the table is asked between two decisions.
bool held_otherwise(const Status& a, const Status& b) {
  const bool mirrored = a.command.left == b.command.right && a.command.right == b.command.left;
  return !mirrored &&
         (a.decision.mode == planning::Mode::stepping || a.decision.mode == planning::Mode::following);
}

void expect_mirrored(const Status& a, const Status& b) {
  RC_ASSERT(a.command.left == b.command.right);
  RC_ASSERT(a.command.right == b.command.left);
  RC_ASSERT(a.pose.at.x == b.pose.at.x);
  RC_ASSERT(a.pose.at.y == -b.pose.at.y);
  RC_ASSERT(a.pose.heading == -b.pose.heading);
  RC_ASSERT(a.decision.mode == b.decision.mode);
  RC_ASSERT(a.decision.why == b.decision.why);
  // The tick in which the table is asked of echoes.
  if (a.decision.looked && a.decision.mode == planning::Mode::steering) {
    RC_ASSERT(a.decision.inputs.bias == -b.decision.inputs.bias);
    RC_ASSERT(a.decision.response.turn == -b.decision.response.turn);
    RC_ASSERT(a.decision.response.step == b.decision.response.step);
  }
  RC_ASSERT(a.health.fault == b.health.fault);
}

RC_GTEST_PROP(Mirror, AMirroredWorldIsDrivenMirroredToTheLastBit, (std::uint64_t seed)) {
  Bits bits(seed);
  Params params = random_params(bits);
  for (BeamParams& beam : params.rangefinders.beams) beam = {};
  params.wheels.ratio = millionths(1000000);
  RC_PRE(check(params) == ParamFault::none);
  const int fury = *rc::gen::inRange(0, 3);
  const Bits weather(bits.next());
  StormBoard board(weather, params, fury);
  StormBoard twin(weather, params, fury);
  Mirrored mirrored(twin);
  Side a(params, board, board);
  Side b(params, mirrored, mirrored);
  const Length x = millimetres(bits.whole(-4000, 4000));
  const Length y = millimetres(bits.whole(-4000, 4000));
  const Angle heading = Angle::from_raw(static_cast<std::uint32_t>(bits.next()));
  a.robot.place({{}, heading});
  b.robot.place({{}, -heading});
  a.robot.set_goal({{x, y}, 50_mm});
  b.robot.set_goal({{x, -y}, 50_mm});
  Time now;
  int ticks = 0;
  for (; ticks < 4000; ++ticks) {
    now = now + params.safety.period;
    const Status& sa = a.robot.tick(now);
    const Status& sb = b.robot.tick(now);
    if (may_differ(sa.decision) || held_otherwise(sa, sb) || sa.health.fault != Fault::none) break;
    expect_mirrored(sa, sb);
    board.pass();
    twin.pass();
  }
  RC_CLASSIFY(ticks > 500, "5 s and more");
  RC_CLASSIFY(a.robot.status().pose.heading != heading, "turned");
}

}  // namespace
}  // namespace whisker::test
