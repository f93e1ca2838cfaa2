#include "firmware/planning/goal_planner.hpp"

#include <gtest/gtest.h>

namespace whisker::planning {
namespace {

/// Records its calls, and returns the prepared answers.
class Recorder final : public GoalPlanner {
 public:
  int starts = 0;
  int advances = 0;
  bool ends = false;
  Length goal_x() const { return goal_.at.x; }
  bool there(Length distance) const { return is_goal(distance); }
  /// The goal is this far ahead, and the body drives this fast.
  bool stops(Length ahead, Speed forward) const {
    View view;
    view.forward = forward;
    return arrives({ahead, {}}, abs(ahead), view, Params{});
  }

 private:
  void start(const View&) noexcept override {
    ++starts;
    report(Mode::surveying, Why::goal_set);
  }
  void advance(const View&) noexcept override {
    ++advances;
    decision_.danger_count = 3;
    decision_.looked = true;
    decision_.manoeuvre.kind = ManoeuvreKind::cruise;
    report(Mode::going, Why::target_free);
    if (ends) finish(Mode::arrived, Why::at_goal, Outcome::reached);
  }
};

using namespace literals;

Goal at(int x_mm) { return {{millimetres(x_mm), {}}, 80_mm}; }

TEST(GoalPlanner, RestsWithoutAGoal) {
  Recorder p;
  for (int i = 0; i < 3; ++i) {
    const Decision d = p.step(View{});
    EXPECT_EQ(d.mode, Mode::idle);
    EXPECT_EQ(d.outcome, Outcome::none);
    EXPECT_EQ(d.manoeuvre.kind, ManoeuvreKind::keep);
  }
  EXPECT_EQ(p.starts + p.advances, 0);
}

TEST(GoalPlanner, StartsAtTheNextStepAndThenAdvances) {
  Recorder p;
  p.set_goal(at(1000));
  EXPECT_EQ(p.starts, 0);
  const Decision first = p.step(View{});
  EXPECT_EQ(p.starts, 1);
  EXPECT_EQ(p.advances, 0);
  EXPECT_EQ(first.outcome, Outcome::running);
  EXPECT_EQ(first.why, Why::goal_set);
  for (int i = 1; i <= 5; ++i) {
    p.step(View{});
    EXPECT_EQ(p.advances, i);
  }
  EXPECT_EQ(p.starts, 1);
}

TEST(GoalPlanner, TheLatestCommandCounts) {
  Recorder p;
  p.set_goal(at(1000));
  p.set_goal(at(2000));
  p.step(View{});
  EXPECT_EQ(p.starts, 1);
  EXPECT_EQ(p.goal_x(), 2_m);

  p.set_goal(at(3000));
  p.cancel();
  EXPECT_EQ(p.step(View{}).why, Why::cancelled);
  EXPECT_EQ(p.starts, 1);

  p.cancel();
  p.set_goal(at(4000));
  EXPECT_EQ(p.step(View{}).outcome, Outcome::running);
  EXPECT_EQ(p.starts, 2);
}

TEST(GoalPlanner, AnotherGoalBeginsAnew) {
  Recorder p;
  p.set_goal(at(1000));
  p.step(View{});
  EXPECT_EQ(p.step(View{}).danger_count, 3);
  p.set_goal(at(2000));
  const Decision d = p.step(View{});
  EXPECT_EQ(p.starts, 2);
  EXPECT_EQ(d.danger_count, 0);
  EXPECT_EQ(d.why, Why::goal_set);
}

TEST(GoalPlanner, CancelStopsForGood) {
  Recorder p;
  p.set_goal(at(1000));
  p.step(View{});
  p.step(View{});
  p.cancel();
  const Decision d = p.step(View{});
  EXPECT_EQ(d.manoeuvre.kind, ManoeuvreKind::stop);
  EXPECT_EQ(d.mode, Mode::idle);
  EXPECT_EQ(d.why, Why::cancelled);
  EXPECT_EQ(d.outcome, Outcome::none);
  EXPECT_EQ(d.danger_count, 0);
  const int before = p.advances;
  const Decision later = p.step(View{});
  EXPECT_EQ(later.manoeuvre.kind, ManoeuvreKind::keep) << "once is enough";
  EXPECT_EQ(later.why, Why::cancelled);
  EXPECT_EQ(p.advances, before);
}

TEST(GoalPlanner, StandsAfterTheEndUntilThereIsANewGoal) {
  Recorder p;
  p.set_goal(at(1000));
  p.step(View{});
  p.ends = true;
  EXPECT_EQ(p.step(View{}).manoeuvre.kind, ManoeuvreKind::stop);
  const int before = p.advances;
  for (int i = 0; i < 3; ++i) {
    const Decision d = p.step(View{});
    EXPECT_EQ(d.outcome, Outcome::reached);
    EXPECT_EQ(d.why, Why::at_goal);
    EXPECT_EQ(d.manoeuvre.kind, ManoeuvreKind::keep);
    EXPECT_FALSE(d.looked) << "of this tick alone";
  }
  EXPECT_EQ(p.advances, before);
  p.set_goal(at(2000));
  EXPECT_EQ(p.step(View{}).outcome, Outcome::running);
}

TEST(GoalPlanner, APlaceWellInsideTheToleranceIsTheGoal) {
  Recorder p;
  p.set_goal(at(1000));
  EXPECT_TRUE(p.there(70_mm));
  EXPECT_FALSE(p.there(71_mm));
}

// The reference robot stops from 0.3 m/s in 45 mm, and in 18 mm more until its wheels follow.
TEST(GoalPlanner, InsideTheToleranceTheBodyDrivesOnToTheMiddle) {
  Recorder p;
  p.set_goal(at(1000));
  const Speed full = Params{}.wheels.max_speed;
  EXPECT_FALSE(p.stops(71_mm, full)) << "outside";
  EXPECT_FALSE(p.stops(65_mm, full));
  EXPECT_TRUE(p.stops(62_mm, full));
  EXPECT_FALSE(p.stops(62_mm, full / 2));
  EXPECT_TRUE(p.stops(-1_mm, full / 2)) << "past it";
}

TEST(GoalPlanner, InsideTheToleranceABodyThatHardlyMovesStops) {
  Recorder p;
  p.set_goal(at(1000));
  const Speed full = Params{}.wheels.max_speed;
  EXPECT_FALSE(p.stops(60_mm, full / 7));
  EXPECT_TRUE(p.stops(60_mm, full / 9));
  EXPECT_TRUE(p.stops(60_mm, Speed{}));
  EXPECT_TRUE(p.stops(60_mm, -full));
  EXPECT_FALSE(p.stops(71_mm, Speed{})) << "outside";
}

}  // namespace
}  // namespace whisker::planning
