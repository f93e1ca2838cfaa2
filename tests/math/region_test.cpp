// Outside the permitted region, the core reports a named error before any number saturates.
#include "firmware/math/region.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "firmware/planning/global/map_planner.hpp"
#include "firmware/planning/thesis/thesis_planner.hpp"
#include "firmware/robot.hpp"
#include "tests/robot/fake_board.hpp"

namespace whisker {
namespace {

constexpr Length kBeyond = kPlaceLimit + micrometres(1);
constexpr Vec kOutside[] = {{kBeyond, Length{}},
                            {Length{}, -kBeyond},
                            {Length::from_raw(INT32_MIN), Length{}},
                            {Length::from_raw(INT32_MAX), Length::from_raw(INT32_MAX)}};
constexpr Vec kCorners[] = {
    {kPlaceLimit, kPlaceLimit}, {-kPlaceLimit, -kPlaceLimit}, {kPlaceLimit, -kPlaceLimit}};

/// In open ground, with each planner in turn.
class Region : public testing::TestWithParam<int> {
 protected:
  Region() {
    planning::Planner* const planners[] = {&thesis_, &boundary_.planner, &map_.planner, &fine_.planner};
    planner_ = planners[GetParam()];
  }
  const Status& tick(int times = 1) {
    for (int i = 0; i < times; ++i) {
      robot().tick(Time::from_raw(now_ += 10));
      board_.pass();
    }
    return robot().status();
  }
  Robot& robot() {
    if (robot_ == nullptr) robot_ = std::make_unique<Robot>(board_, board_, *planner_, params_);
    return *robot_;
  }
  bool stands() const { return board_.commanded().left == 0 && board_.commanded().right == 0; }

  Params params_;
  test::FakeBoard board_;
  planning::ThesisPlanner thesis_{params_, fuzzy::kDefaultTable};
  planning::TableBoundaryPlanner boundary_{params_, fuzzy::kDefaultTable};
  planning::TableMapPlanner<2048> map_{params_, fuzzy::kDefaultTable};
  planning::TableMapPlanner<16384> fine_{params_, fuzzy::kDefaultTable};
  planning::Planner* planner_ = nullptr;
  std::unique_ptr<Robot> robot_;
  std::uint32_t now_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Planners, Region, testing::Range(0, 4));

TEST_P(Region, GoesToAGoalAtEachOfItsCorners) {
  for (const Vec corner : kCorners) {
    robot_ = nullptr;
    board_ = {};
    const Vec inwards{corner.x > Length{} ? -(800_mm) : 800_mm, Length{}};
    EXPECT_TRUE(robot().place({corner + inwards, 30_deg}));
    EXPECT_TRUE(robot().set_goal({corner, 100_mm}));
    EXPECT_EQ(tick(3000).decision.outcome, planning::Outcome::reached) << name(robot().status().health.fault);
    EXPECT_LT(norm(robot().status().pose.at - corner), 100_mm);
  }
}

TEST_P(Region, SetsOutFromOneCornerToTheOppositeOne) {
  robot().place({kCorners[0], 200_deg});
  EXPECT_TRUE(robot().set_goal({kCorners[1], 100_mm}));
  EXPECT_EQ(tick(3000).decision.outcome, planning::Outcome::running);
  EXPECT_GT(norm(robot().status().pose.at - kCorners[0]), 1_m);
}

TEST_P(Region, APlacementOutsideIsAFaultAndChangesNothing) {
  for (const Vec at : kOutside) {
    robot_ = nullptr;
    EXPECT_FALSE(robot().place({at, 10_deg}));
    EXPECT_EQ(robot().status().pose.at, Vec{});
    robot().set_goal({{1_m, 0_m}, 100_mm});
    tick(100);
    EXPECT_EQ(robot().status().health.fault, Fault::pose_out_of_range);
    EXPECT_EQ(robot().status().health.pose_out_of_range, 1U);
    EXPECT_EQ(robot().status().decision.mode, planning::Mode::stopped);
    EXPECT_TRUE(stands());
  }
}

TEST_P(Region, APlacementOutsideWhileItDrivesStopsIt) {
  robot().set_goal({{5_m, 0_m}, 100_mm});
  tick(600);
  ASSERT_EQ(robot().status().decision.outcome, planning::Outcome::running);
  EXPECT_FALSE(robot().place({{kBeyond, Length{}}, 0_deg}));
  tick(60);
  EXPECT_EQ(robot().status().health.fault, Fault::pose_out_of_range);
  EXPECT_TRUE(stands());
  robot().reset();
  EXPECT_TRUE(robot().place({}));
  EXPECT_TRUE(robot().set_goal({{1_m, 0_m}, 100_mm}));
  EXPECT_EQ(tick(3000).decision.outcome, planning::Outcome::reached);
}

/// Turns to both sides, and then drives on without end.
struct Outward final : planning::Planner {
  void set_goal(const planning::Goal&) noexcept override {}
  void move_goal(Vec) noexcept override {}
  void cancel() noexcept override {}
  planning::Decision step(const planning::View&) noexcept override {
    planning::Decision d;
    d.outcome = planning::Outcome::running;
    d.manoeuvre.kind = planning::ManoeuvreKind::cruise;
    const int part = ticks_ < 480 ? ticks_++ / 120 : 4;
    if (part == 4) {
      d.manoeuvre.forward = 300_mm_per_s;
    } else {
      d.manoeuvre.turning = part == 0 || part == 3 ? 65_mm_per_s : -65_mm_per_s;
    }
    return d;
  }

 private:
  int ticks_ = 0;
};

TEST(TheRegion, StopsABodyThatLeavesItByName) {
  const Params params;
  test::FakeBoard board;
  Outward planner;
  Robot robot(board, board, planner, params);
  std::uint32_t now = 0;
  const auto tick = [&] {
    robot.tick(Time::from_raw(now += 10));
    board.pass();
  };
  robot.place({{kPlaceLimit, Length{}}, 0_deg});
  for (int i = 0; i < 20000 && robot.status().health.fault == Fault::none; ++i) tick();
  EXPECT_EQ(robot.status().health.fault, Fault::pose_out_of_range) << name(robot.status().health.fault);
  EXPECT_EQ(robot.status().health.pose_out_of_range, 1U);
  EXPECT_LT(robot.status().pose.at.x, kBodyLimit + 10_mm) << "it is found at once";
  for (int i = 0; i < 60; ++i) tick();
  EXPECT_EQ(board.commanded().left, 0);
  EXPECT_EQ(board.commanded().right, 0);
  EXPECT_EQ(robot.status().health.pose_out_of_range, 1U);
  robot.reset();
  tick();
  tick();
  EXPECT_EQ(robot.status().health.fault, Fault::pose_out_of_range) << "it is still out there";
}

TEST_P(Region, AGoalOutsideIsRefusedByName) {
  for (const Vec at : kOutside) {
    robot_ = nullptr;
    EXPECT_FALSE(robot().set_goal({at, 100_mm}));
    tick(100);
    EXPECT_EQ(robot().status().health.fault, Fault::none);
    EXPECT_EQ(robot().status().decision.outcome, planning::Outcome::gave_up);
    EXPECT_EQ(robot().status().decision.mode, planning::Mode::gave_up);
    EXPECT_EQ(robot().status().decision.why, planning::Why::goal_out_of_range);
    EXPECT_TRUE(stands());
    EXPECT_TRUE(robot().set_goal({{200_mm, 0_m}, 100_mm}));
    EXPECT_EQ(tick(2000).decision.outcome, planning::Outcome::reached);
    EXPECT_EQ(robot().status().decision.why, planning::Why::at_goal);
  }
}

TEST_P(Region, AGoalOutsideEndsTheMissionUnderWay) {
  robot().set_goal({{5_m, 0_m}, 100_mm});
  tick(600);
  robot().set_goal({kOutside[0], 100_mm});
  tick(60);
  EXPECT_EQ(robot().status().decision.why, planning::Why::goal_out_of_range);
  EXPECT_TRUE(stands());
  robot().cancel();
  EXPECT_EQ(tick().decision.why, planning::Why::cancelled);
}

}  // namespace
}  // namespace whisker
