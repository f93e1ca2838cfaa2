#include "firmware/planning/boundary/table_boundary_planner.hpp"

#include <gtest/gtest.h>

#include "firmware/fuzzy/rules.hpp"
#include "firmware/planning/candidate_headings.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::echoes;
using test::Ground;
using test::in_degrees;

constexpr Vec kGoal{3_m, 4_m};  // 53.13 degrees
constexpr double kTarget = 53.130102;

/// The heading after so many readings, degrees from the goal's direction.
double heads(Course& course, const View& view, Angle bend, int readings, Decision& decision) {
  Side wall = Side::left;
  for (int i = 0; i < readings; ++i) {
    EXPECT_TRUE(course.choose(view, kGoal, bend, Params{}, wall, decision));
  }
  return in_degrees(course.heading()) - kTarget;
}

/// Whether it finds a heading at the first reading, without a bend.
bool chooses(Course& course, const Ground& g, Vec goal, Side& wall) {
  Decision decision;
  return course.choose(g.view(), goal, 0_deg, g.params(), wall, decision);
}

TEST(Course, LeadsStraightToTheGoalInTheOpen) {
  Ground g;
  g.free(0, 360);
  Course course;
  Decision decision;
  EXPECT_NEAR(heads(course, g.view(), 0_deg, 1, decision), 0, 1e-5);
  EXPECT_EQ(decision.why, Why::target_free);
}

TEST(Course, BendsFasterThanItStraightens) {
  Ground g;
  g.free(0, 360);
  for (const int sign : {-1, 1}) {
    Course course;
    Decision decision;
    const double first = heads(course, g.view(), 20_deg * sign, 1, decision) * sign;
    EXPECT_GT(first, 1);
    EXPECT_LT(first, 20);
    EXPECT_EQ(decision.why, Why::table);
    const double bent = heads(course, g.view(), 20_deg * sign, 100, decision) * sign;
    EXPECT_NEAR(bent, 20, 0.1);
    const double back = heads(course, g.view(), 0_deg, 1, decision) * sign;
    EXPECT_LT(back, bent);
    EXPECT_LT(bent - back, first / 2);
    course.reset();
    EXPECT_NEAR(heads(course, g.view(), 0_deg, 1, decision), 0, 1e-5);
  }
}

TEST(Course, IgnoresWhatIsBeyondTheGoal) {
  Ground g;
  g.free(0, 360);
  View view = g.view();
  Course course;
  Decision decision;
  Side wall = Side::left;
  view.moving_scan = echoes(400, 400, 400);
  for (int i = 0; i < 10; ++i) course.choose(view, {300_mm, 0_mm}, 20_deg, g.params(), wall, decision);
  EXPECT_NEAR(in_degrees(course.heading()), 0, 1e-5);
  for (int i = 0; i < 10; ++i) course.choose(view, {500_mm, 0_mm}, 20_deg, g.params(), wall, decision);
  EXPECT_GT(in_degrees(course.heading()), 5);
}

TEST(Course, GivesUpTheBendForTheGoalsOwnDirection) {
  Ground g;
  g.free(125, 430).echo(70, 125, 150_mm);
  Course course;
  Decision decision;
  Side wall = Side::left;
  for (int i = 0; i < 50; ++i)
    ASSERT_TRUE(course.choose(g.view(), {3_m, 0_mm}, 45_deg, g.params(), wall, decision));
  EXPECT_EQ(course.heading(), 0_deg);
  EXPECT_EQ(decision.why, Why::narrow);
}

TEST(Course, TurnsAwayFromTheWallFirst) {
  Ground g;
  g.free(25, 335).echo(-25, 25, 150_mm);
  const View view = g.view();
  const Reach& reach = view.local_grid->reach();
  for (const Side was : {Side::left, Side::right}) {
    Course course;
    Side wall = was;
    ASSERT_TRUE(chooses(course, g, {2_m, 0_mm}, wall));
    EXPECT_EQ(wall, was);
    EXPECT_LT(in_degrees(course.heading()) * sign(was), 0);
    EXPECT_NE(way(view, course.heading(), reach.probe, reach.planning), Way::occupied);
    EXPECT_EQ(way(view, {}, reach.probe, reach.planning), Way::occupied);
  }
}

TEST(Course, PassesOnTheOtherSideOfWhatBlocksItsOwn) {
  Ground g;
  g.free(25, 180).echo(-180, 25, 150_mm);
  Course course;
  Side wall = Side::left;
  ASSERT_TRUE(chooses(course, g, {2_m, 0_mm}, wall));
  EXPECT_EQ(wall, Side::right) << "the obstacle is there now";
  EXPECT_GT(in_degrees(course.heading()), 0);
}

TEST(Course, LeavesRoomWhereThereIsSome) {
  Ground pole;
  pole.free(80, 415).echo(62, 72, 140_mm);
  Ground gap;
  gap.free(80, 280).free(-55, 55).echo(62, 72, 140_mm).echo(-72, -62, 140_mm);
  for (const Ground* g : {&pole, &gap}) {
    const View view = g->view();
    const Reach& reach = view.local_grid->reach();
    ASSERT_NE(way(view, {}, reach.probe, reach.planning), Way::occupied);
    Course course;
    Decision decision;
    Side wall = Side::left;
    ASSERT_TRUE(course.choose(view, {2_m, 0_mm}, 0_deg, g->params(), wall, decision));
    if (g == &pole) {
      EXPECT_LT(in_degrees(course.heading()), -5);
    } else {
      EXPECT_NEAR(in_degrees(course.heading()), 0, 1e-5) << "none to leave";
    }
  }
}

TEST(Course, EndsBeforeAWall) {
  Ground g;
  g.free(130, 230).echo(-130, 130, 150_mm);
  Course course;
  Side wall = Side::left;
  EXPECT_FALSE(chooses(course, g, {2_m, 0_mm}, wall));
}

TEST(Course, FindsAGapBetweenTwoStepsOfItsFan) {
  const auto free = [](const View& view, Angle heading) {
    const Reach& reach = view.local_grid->reach();
    return way(view, heading, reach.probe, reach.planning) != Way::occupied;
  };
  int between = 0;
  for (int middle = 0; middle < 8; ++middle) {
    for (int half = 15; half <= 45; ++half) {
      Ground g({{15_mm, 7_mm}, {}});
      g.free(middle - half, middle + half).echo(middle + half, middle - half + 360, 190_mm);
      bool in_the_fan = false;
      for (int step = -10; step <= 10; ++step) {
        in_the_fan = in_the_fan || free(g.view(), Angle::turns(step, kCandidateHeadings));
      }
      Course course;
      Side wall = Side::left;
      const bool found = chooses(course, g, {2_m, 0_mm}, wall);
      if (in_the_fan) {
        EXPECT_TRUE(found) << middle << " " << half;
      } else if (found) {
        EXPECT_TRUE(free(g.view(), course.heading())) << middle << " " << half;
        ++between;
      }
    }
  }
  EXPECT_GT(between, 0);
}

TEST(Course, ReachesAGoalThatStandsBeforeAWall) {
  Ground g;
  g.free(0, 360, 190_mm).echo(-130, 130, 200_mm);
  Course course;
  Side wall = Side::left;
  EXPECT_FALSE(chooses(course, g, {150_mm, 0_mm}, wall));
  EXPECT_TRUE(chooses(course, g, {40_mm, 0_mm}, wall));
  EXPECT_EQ(course.heading(), 0_deg);
}

/// Something stands on the left, 0.15 m beside a course along the x axis.
Ground left_of_the_course() {
  Ground g;
  g.free(0, 360, 190_mm).echo(20, 70, 200_mm);
  return g;
}

View seeing(const Ground& g, int32_t nearest_mm) {
  View view = g.view();
  view.moving_scan = echoes(nearest_mm, 2000, 2000);
  return view;
}

TEST(TableDeflection, TurnsAwayFromTheNearerSide) {
  const Ground g = left_of_the_course();
  TableDeflection law(fuzzy::kDefaultTable);
  Decision decision;
  const Angle right = law.deflect(seeing(g, 200), 0_deg, g.params(), decision);
  EXPECT_LT(in_degrees(right), -1);
  EXPECT_GT(decision.inputs.bias, Q7{});
  EXPECT_GT(in_degrees(law.deflect(seeing(g, 200), 90_deg, g.params(), decision)), 1) << "it is on the right";
}

TEST(TableDeflection, SetsThePaceByTheNearestEcho) {
  const Ground g = left_of_the_course();
  TableDeflection law(fuzzy::kDefaultTable);
  Decision decision;
  Q14 last;
  for (const int32_t mm : {0, 100, 200, 400, 600, 800}) {
    law.deflect(seeing(g, mm), 0_deg, g.params(), decision);
    EXPECT_GE(decision.response.step, last) << mm;
    last = decision.response.step;
  }
  EXPECT_LT(last, fuzzy::step_terms::M) << "the grid knows what is nearer than the echoes";
  Ground open;
  open.free(0, 360);
  law.deflect(seeing(open, 810), 0_deg, open.params(), decision);
  EXPECT_EQ(decision.response.step, fuzzy::step_terms::VB);
  View blind = seeing(g, 800);
  blind.moving_scan.beam[hal::kRight].validity = perception::Validity::stale;
  law.deflect(blind, 0_deg, g.params(), decision);
  EXPECT_EQ(decision.inputs.distance, Q7{});
}

TEST(TableDeflection, IsStraightIfItIsAskedNotToBend) {
  const Ground g = left_of_the_course();
  TableDeflection law(fuzzy::kDefaultTable);
  Params params = g.params();
  params.boundary.bend = Fitted::no;
  Decision decision;
  EXPECT_EQ(law.deflect(seeing(g, 200), 0_deg, params, decision), Angle{});
  EXPECT_LT(decision.response.turn, Q14{}) << "what it would have been";
}

}  // namespace
}  // namespace whisker::planning
