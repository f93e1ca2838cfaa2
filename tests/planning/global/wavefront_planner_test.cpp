// The guide's advice if the plan does not help: every use of the map ends, and so does every wait.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "firmware/planning/global/map_planner.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

constexpr Vec kGoal{3_m, Length{}};
constexpr int32_t kStep_mm = 5;

/// A guide in the open; the test drives the body.
class Guided : public testing::Test {
 protected:
  Guided() {
    local_grid_.configure(params_);
    local_grid_.reset({});
    view_.local_grid = &local_grid_;
    map_.guide.start(view_, {kGoal, 100_mm});
  }

  void stay(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }
  void tick() {
    map_.guide.observe(view_);
    map_.guide.ponder(view_);
  }
  GlobalPlanner::Advice advice() {
    Vec place;
    return map_.guide.advise(view_, norm(kGoal - view_.pose.at), place);
  }
  void go_to(Vec at) {
    view_.travelled_um += static_cast<uint32_t>(norm(at - view_.pose.at).raw());
    view_.pose.at = at;
    local_grid_.move_to(view_.pose);
    tick();
  }
  /// Beams all round, near enough for sure echoes.
  void see_ring() {
    view_.observed = 1;
    for (int deg = 0; deg < 360; deg += 5) {
      view_.observations[0] = {
          perception::beam_of(mount(params_.rangefinders, hal::kFront), {{}, test::degrees(deg)}), 0, 250_mm,
          true};
      stay(1);
    }
    view_.observed = 0;
    stay(120);
  }
  /// Back and forth without progress, until this advice. Returns the path length, mm.
  int32_t dither(int32_t most_mm, GlobalPlanner::Advice until = GlobalPlanner::Advice::none) {
    const Vec from = view_.pose.at;
    for (int32_t way = 0; way < most_mm; way += kStep_mm) {
      const int32_t n = way / kStep_mm % 2;
      go_to(from - Vec{millimetres(n == 0 ? kStep_mm : 0), Length{}});
      if (advice() == until) return way;
    }
    return most_mm;
  }

  Params params_;
  perception::LocalGrid local_grid_;
  View view_;
  MapOf<2048> map_{params_};
};

TEST_F(Guided, AdvisesOnceItHasPlanned) {
  EXPECT_EQ(advice(), GlobalPlanner::Advice::none);
  stay(40);
  EXPECT_EQ(advice(), GlobalPlanner::Advice::place);
}

TEST_F(Guided, EachSpellWithoutProgressIsHalfAsLongAsTheOneBefore) {
  stay(40);
  int32_t all = 0;
  Length x{};
  for (const int32_t spell : {20000, 10000, 5000, 2500, 1250}) {
    const int32_t way = dither(30000);
    EXPECT_NEAR(way, spell, 2 * kStep_mm);
    all += way;
    EXPECT_EQ(dither(1000), 0) << "it came back without progress";
    x += 200_mm;
    go_to({x, Length{}});
    stay(40);
    EXPECT_EQ(advice(), GlobalPlanner::Advice::place) << "nearer than ever, and no advice";
  }
  EXPECT_LT(all, 40000);
}

TEST_F(Guided, TwelveRefusalsAreTakenAndEachWaitIsShort) {
  stay(40);
  for (int i = 0; i < 12; ++i) {
    // At another place each time: bars on all sides would leave no path.
    go_to({millimetres(-300 * i), Length{}});
    stay(40);
    ASSERT_EQ(advice(), GlobalPlanner::Advice::place);
    ASSERT_TRUE(map_.guide.refuse(view_));
    ASSERT_EQ(advice(), GlobalPlanner::Advice::wait);
    int ticks = 0;
    while (advice() == GlobalPlanner::Advice::wait && ticks < 100) {
      stay(1);
      ++ticks;
    }
    EXPECT_LT(ticks, 40);
  }
  EXPECT_FALSE(map_.guide.refuse(view_));
  EXPECT_EQ(advice(), GlobalPlanner::Advice::none);
}

TEST_F(Guided, ARefusedWayIsBarred) {
  stay(40);
  ASSERT_TRUE(map_.guide.refuse(view_));
  stay(40);
  EXPECT_EQ(map_.guide.map().at(map_.guide.map().place({200_mm, Length{}})), planning::CellState::occupied);
  EXPECT_EQ(advice(), GlobalPlanner::Advice::place);
}

TEST_F(Guided, WhatBlockedBeforeAGapIsForgottenBehindIt) {
  const planning::GridMap& map = map_.guide.map();
  const planning::Cell ahead = map.place({200_mm, Length{}});
  const auto barred_once_it_is_seen_free = [&] {
    const Pose behind{{-1_m, Length{}}, {}};
    view_.observations[0] = {perception::beam_of(mount(params_.rangefinders, hal::kFront), behind), 0, 2_m,
                             false};
    view_.observed = 1;
    stay(60);
    view_.observed = 0;
    stay(40);
    return map.at(ahead) == planning::CellState::occupied;
  };
  stay(40);
  ASSERT_TRUE(map_.guide.refuse(view_));
  stay(40);
  EXPECT_TRUE(barred_once_it_is_seen_free());
  map_.guide.pass();
  EXPECT_FALSE(barred_once_it_is_seen_free());
}

TEST_F(Guided, DrivesOnTowardsAnEchoThatIsTooFarAwayToTellADoorFromAWall) {
  const auto heads_for_goal = [&](Length echo) {
    map_.guide.start(view_, {kGoal, 100_mm});
    view_.observations[0] = {perception::beam_of(mount(params_.rangefinders, hal::kFront), {}), 0, echo,
                             true};
    view_.observed = 1;
    stay(1);
    view_.observed = 0;
    stay(40);
    Vec place;
    EXPECT_EQ(map_.guide.advise(view_, norm(kGoal), place), GlobalPlanner::Advice::place);
    return place == kGoal;
  };
  EXPECT_TRUE(heads_for_goal(1200_mm));
  EXPECT_FALSE(heads_for_goal(700_mm));
}

TEST_F(Guided, DoubtsOnceAndForgetsWhatBlocked) {
  for (int i = 0; i < hal::kBeams; ++i) {
    view_.observations[i] = {perception::beam_of(mount(params_.rangefinders, i), {}), 0, 250_mm, true};
  }
  view_.observed = 7;
  stay(1);
  view_.observed = 0;
  const planning::GridMap& map = map_.guide.map();
  const planning::Cell wall = map.place({250_mm, 50_mm});
  ASSERT_EQ(map.at(wall), planning::CellState::occupied);
  EXPECT_FALSE(map_.guide.knows_no_way());
  EXPECT_TRUE(map_.guide.doubt());
  EXPECT_EQ(map.at(wall), planning::CellState::unknown);
  EXPECT_TRUE(map_.guide.knows_no_way());
  EXPECT_FALSE(map_.guide.doubt());
}

TEST_F(Guided, KnowsThatThereIsNoWayOutOfARing) {
  see_ring();
  EXPECT_TRUE(map_.guide.knows_no_way());
  EXPECT_EQ(advice(), GlobalPlanner::Advice::none);
  EXPECT_FALSE(map_.guide.doubt()) << "it agrees: there is nothing to doubt";
}

TEST_F(Guided, ALastTryEndsAfterEightMetres) {
  stay(40);
  ASSERT_TRUE(map_.guide.doubt());
  stay(40);
  ASSERT_EQ(advice(), GlobalPlanner::Advice::place);
  EXPECT_NEAR(dither(30000, GlobalPlanner::Advice::no_way), 8000, 2 * kStep_mm);
  stay(100);
  EXPECT_EQ(advice(), GlobalPlanner::Advice::no_way);
}

TEST_F(Guided, ALastTryEndsWhereTheMapShowsAClosedRing) {
  stay(40);
  ASSERT_TRUE(map_.guide.doubt());
  see_ring();
  EXPECT_EQ(advice(), GlobalPlanner::Advice::no_way);
}

TEST_F(Guided, ALastTryEndsWithTooManyRefusals) {
  stay(40);
  ASSERT_TRUE(map_.guide.doubt());
  stay(40);
  for (int i = 0; i < 13; ++i) {
    go_to({millimetres(-300 * i), Length{}});
    stay(40);
    ASSERT_TRUE(map_.guide.refuse(view_)) << "the robot stands until the advice is there";
  }
  EXPECT_EQ(advice(), GlobalPlanner::Advice::no_way);
}

TEST_F(Guided, ALastTryThatGetsNearerIsNone) {
  stay(40);
  ASSERT_TRUE(map_.guide.doubt());
  stay(40);
  go_to({200_mm, Length{}});
  EXPECT_FALSE(map_.guide.knows_no_way());
  EXPECT_EQ(dither(30000), 20000) << "as before, and no verdict";
  EXPECT_EQ(advice(), GlobalPlanner::Advice::none);
  EXPECT_TRUE(map_.guide.doubt());
}

}  // namespace
}  // namespace whisker::planning
