// The ground that a clear reading and a reading of unknown age prove free, tested with the whole robot.
#include <gtest/gtest.h>

#include "firmware/planning/thesis/thesis_planner.hpp"
#include "firmware/robot.hpp"
#include "tests/robot/fake_board.hpp"

namespace whisker {
namespace {

/// Stands still and observes the local grid.
class Watcher final : public planning::Planner {
 public:
  void set_goal(const planning::Goal&) noexcept override {}
  void move_goal(Vec) noexcept override {}
  void cancel() noexcept override {}
  planning::Decision step(const planning::View& view) noexcept override {
    local_grid = view.local_grid;
    return {};
  }
  const perception::LocalGrid* local_grid = nullptr;
};

class ClearRange : public testing::Test {
 protected:
  /// Whether the ground at this distance ahead is proved free after some readings.
  bool clear_at(Length ahead) {
    Robot robot(board_, board_, planner_, params_);
    for (std::uint32_t t = 10; t <= 300; t += 10) {
      robot.tick(Time::from_raw(t));
      board_.pass();
    }
    EXPECT_EQ(robot.status().health.fault, Fault::none);
    health_ = robot.status().health;
    return planner_.local_grid->is_clear({ahead, Length{}});
  }
  void prove_to(Length range) {
    params_.rangefinders.clear_range = range;
    ASSERT_EQ(check(params_), ParamFault::none);
  }

  Params params_;
  test::FakeBoard board_;
  Watcher planner_;
  Health health_;
};

TEST_F(ClearRange, IsTheMaximumRangeUnlessItIsGiven) { EXPECT_TRUE(clear_at(330_mm)); }

TEST_F(ClearRange, AClearReadingProvesNothingBeyond) {
  prove_to(260_mm);
  EXPECT_TRUE(clear_at(210_mm));
  EXPECT_FALSE(clear_at(290_mm));
  EXPECT_FALSE(clear_at(330_mm));
}

TEST_F(ClearRange, NorDoesAnEchoFromBeyond) {
  prove_to(260_mm);
  // The echo may come through a gap next to an undetected object.
  for (const hal::Beam beam : {hal::kLeft, hal::kFront, hal::kRight}) {
    board_.show(beam, hal::RangeStatus::ok, 600);
  }
  EXPECT_TRUE(clear_at(210_mm));
  EXPECT_FALSE(clear_at(330_mm));
}

TEST_F(ClearRange, MoreThanTheMaximumRangeIsThat) {
  params_.rangefinders.clear_range = 50_m;
  EXPECT_EQ(proving_range(params_.rangefinders), params_.rangefinders.max_range);
}

TEST_F(ClearRange, AReadingOfUnknownAgeProvesNothing) {
  for (hal::RangeReading& r : board_.shown.beam) r.age_ms = 255;
  EXPECT_FALSE(clear_at(330_mm));
  EXPECT_EQ(health_.range_stale, 3U);
}

TEST_F(ClearRange, ReadingsOfUnknownAgeAloneStopTheRobot) {
  planning::ThesisPlanner thesis(params_, fuzzy::kDefaultTable);
  for (hal::RangeReading& r : board_.shown.beam) r.age_ms = 255;
  Robot robot(board_, board_, thesis, params_);
  robot.set_goal({{1_m, 0_m}, 100_mm});
  for (std::uint32_t t = 10; t <= 1300; t += 10) {
    robot.tick(Time::from_raw(t));
    board_.pass();
  }
  EXPECT_EQ(robot.status().health.fault, Fault::range_lost);
  EXPECT_EQ(board_.x(), 0);
}

}  // namespace
}  // namespace whisker
