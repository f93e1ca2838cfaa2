// Fixes: poses measured outside, given to the whole core while it drives.
#include <cstdint>

#include <gtest/gtest.h>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/robot.hpp"
#include "tests/robot/fake_board.hpp"

namespace whisker {
namespace {

const localization::PoseSigma kSmall{30_mm, 30_mm, 1_deg};

class Corrected {
 public:
  explicit Corrected(const Params& params)
      : params_(params),
        planner_(params_, fuzzy::kDefaultTable),
        robot(board, board, planner_.planner, params_) {
    robot.place({});
    tick();
  }
  const Status& tick(int times = 1) {
    for (int i = 0; i < times; ++i) {
      now_ += 10;
      robot.tick(Time::from_raw(now_));
      board.pass();
    }
    return robot.status();
  }
  Pose pose() const { return robot.status().pose; }

  test::FakeBoard board;

 private:
  const Params params_;
  planning::TableBoundaryPlanner planner_;

 public:
  Robot robot;

 private:
  std::uint32_t now_ = 0;
};

Params with_sigma(JumpPolicy policy = JumpPolicy::accept) {
  Params p;
  p.pose_error.wheel_scale_common = millionths(20000);
  p.fix_jumps = policy;
  return p;
}

TEST(Correct, WithoutABoundTheEstimateBecomesTheFixAndTheGoalMoves) {
  Corrected c{Params{}};
  c.robot.set_goal({{4_m, 0_m}, 100_mm});
  c.tick(1000);
  ASSERT_GT(c.pose().at.x, 1_m);
  const hal::WheelSpeeds before = c.board.commanded();
  const Length x = c.pose().at.x;
  EXPECT_TRUE(c.robot.correct({{x + 1_m, 0_m}, c.pose().heading}, kSmall));
  EXPECT_EQ(c.pose().at.x, x + 1_m);
  c.tick();
  EXPECT_NEAR(c.board.commanded().left, before.left, 200) << "the movement continues";
  EXPECT_GT(c.pose().at.x, x + 1_m);
  c.tick(3000);
  EXPECT_EQ(c.robot.status().decision.outcome, planning::Outcome::reached);
  EXPECT_NEAR(c.pose().at.x.raw(), 4000000, 100000);
  EXPECT_NEAR(c.board.x(), 3, 0.1) << "a metre less than without the fix";
  EXPECT_EQ(c.robot.status().health.fix_jumps, 0U);
}

TEST(Correct, WithABoundTheEstimateMovesByTheWeightOfTheFix) {
  Corrected c{with_sigma()};
  c.robot.set_goal({{9_m, 0_m}, 100_mm});
  c.tick(1500);
  const Status before = c.robot.status();
  const double own = before.sigma.along.raw();
  ASSERT_GT(before.pose.at.x, 1_m);
  ASSERT_NEAR(own, 0.02 * before.pose.at.x.raw(), 0.1 * own);
  EXPECT_TRUE(c.robot.correct({before.pose.at + Vec{100_mm, 0_m}, before.pose.heading}, kSmall));
  const double weight = own * own / (own * own + 3e4 * 3e4);
  EXPECT_NEAR((c.pose().at.x - before.pose.at.x).raw(), 1e5 * weight, 2000);
  EXPECT_LT(c.robot.status().sigma.along, 30_mm);
  EXPECT_EQ(c.robot.status().health.fix_jumps, 0U);
}

TEST(Correct, AJumpIsCountedAndRefusedIfTheParameterSaysSo) {
  for (const JumpPolicy policy : {JumpPolicy::accept, JumpPolicy::refuse}) {
    Corrected c{with_sigma(policy)};
    c.robot.set_goal({{9_m, 0_m}, 100_mm});
    c.tick(300);
    const Pose before = c.pose();
    const bool refused = policy == JumpPolicy::refuse;
    EXPECT_NE(c.robot.correct({before.at + Vec{3_m, 0_m}, before.heading}, kSmall), refused);
    EXPECT_EQ(c.robot.status().health.fix_jumps, 1U);
    EXPECT_EQ(c.robot.status().health.fixes_refused, refused ? 1U : 0U);
    EXPECT_EQ(c.pose().at == before.at, refused);
    EXPECT_EQ(c.robot.status().health.fault, Fault::none);
  }
}

TEST(Correct, ExactFixesAreTakenWhateverErrorIsDeclared) {
  for (const int32_t each : {0, 1, 10}) {
    for (const int32_t common : {0, 1, 10000}) {
      Params params;
      params.pose_error.wheel_scale = millionths(each);
      params.pose_error.wheel_scale_common = millionths(common);
      Corrected c{params};
      c.robot.set_goal({{4_m, 0_m}, 100_mm});
      for (int i = 0; i < 20; ++i) {
        c.tick(100);
        EXPECT_TRUE(c.robot.correct(c.pose(), {}));
      }
      EXPECT_EQ(c.robot.status().decision.outcome, planning::Outcome::reached);
    }
  }
}

TEST(Correct, AnAccuracyThatIsNoneIsTheWorst) {
  Corrected c{with_sigma()};
  c.robot.set_goal({{9_m, 0_m}, 100_mm});
  c.tick(1000);
  const Pose before = c.pose();
  const Length none = micrometres(INT32_MIN);
  EXPECT_TRUE(c.robot.correct({before.at + Vec{50_mm, 50_mm}, before.heading}, {none, none, 180_deg}));
  EXPECT_LT(norm(c.pose().at - before.at), 1_mm);
  EXPECT_LE(c.robot.status().sigma.along, localization::PoseBound::kMost);
}

TEST(Correct, BeyondTheLimitItIsAFault) {
  Corrected c{Params{}};
  EXPECT_FALSE(c.robot.correct({{1001_m, 0_m}, 0_deg}, kSmall));
  EXPECT_EQ(c.robot.status().health.fault, Fault::pose_out_of_range);
}

TEST(Correct, WithoutAGoalTheNextOneIsAimedByTheFix) {
  Corrected c{Params{}};
  c.tick(10);
  EXPECT_TRUE(c.robot.correct({{2_m, 0_m}, 0_deg}, kSmall));
  c.robot.set_goal({{4_m, 0_m}, 100_mm});
  c.tick(2500);
  EXPECT_EQ(c.robot.status().decision.outcome, planning::Outcome::reached);
  EXPECT_NEAR(c.board.x(), 2, 0.1);
}

}  // namespace
}  // namespace whisker
