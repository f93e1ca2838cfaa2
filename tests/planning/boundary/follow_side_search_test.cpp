#include "firmware/planning/boundary/follow_side_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::Ground;
using test::in_degrees;

/// A wall at 150 mm between these directions, open ground elsewhere; 0 is the target direction.
struct Wall {
  int right_deg;
  int left_deg;
  /// Whether a cone in this direction hits the wall.
  bool shown(double deg) const { return deg >= right_deg - 12.5 && deg <= left_deg + 12.5; }
};

struct Sweep {
  FollowSideSearch search;
  Ground ground{};
  bool over = false;
  double leftmost = 0;  // degrees, the largest turn to the left
  double rightmost = 0;
};

/// Turns a body as the search requests, and simulates its beams.
Sweep sweep(const Wall& wall, const FollowSideSearch& search) {
  Sweep s{search};
  s.ground.free(120, 240, 300_mm);  // the body came from there
  Angle heading;
  for (int i = 0; i < 2000 && !s.over; ++i) {
    for (int beam = 0; beam < hal::kBeams; ++beam) {
      const Angle axis = heading + beam_axis(s.ground.params().rangefinders, beam);
      const bool shown = wall.shown(in_degrees(axis));
      s.ground.mark(axis, shown ? 150_mm : 2_m, shown, false);
    }
    View view = s.ground.view(heading);
    view.moving_scan.beam[hal::kFront].distance = wall.shown(in_degrees(heading)) ? 150_mm : 2_m;
    Twist twist;
    s.over = s.search.step(view, twist);
    EXPECT_EQ(twist.forward, Speed{}) << "it stands";
    heading += angle_of(twist.turning * (100_mm) * milliseconds(20), 100_mm);
    s.leftmost = std::fmax(s.leftmost, in_degrees(heading));
    s.rightmost = std::fmin(s.rightmost, in_degrees(heading));
  }
  EXPECT_TRUE(s.over);
  return s;
}

FollowSideSearch both(Side first) {
  FollowSideSearch search;
  search.begin({}, first);
  return search;
}

TEST(FollowSideSearch, TakesTheSmallerTurnWhereverItBegins) {
  for (const Side first : {Side::left, Side::right}) {
    const Sweep right = sweep({-40, 90}, both(first));
    ASSERT_TRUE(right.search.found());
    EXPECT_EQ(right.search.side(), Side::right);
    EXPECT_LT(in_degrees(right.search.heading()), -40);
    EXPECT_GT(in_degrees(right.search.heading()), -110);
    const Sweep left = sweep({-90, 40}, both(first));
    ASSERT_TRUE(left.search.found());
    EXPECT_EQ(left.search.side(), Side::left);
    EXPECT_NEAR(in_degrees(left.search.heading()), -in_degrees(right.search.heading()), 1e-3) << "mirrored";
  }
}

TEST(FollowSideSearch, TheExitIsFreeAndNextToTheWall) {
  const Sweep s = sweep({-40, 90}, both(Side::left));
  const View view = s.ground.view();
  const Reach& reach = view.local_grid->reach();
  EXPECT_EQ(way(view, s.search.heading(), reach.probe, reach.planning), Way::free);
  EXPECT_NE(way(view, s.search.heading() + 30_deg, reach.probe, reach.planning), Way::free);
}

TEST(FollowSideSearch, OnOneSideStaysOnIt) {
  FollowSideSearch search;
  search.begin_on({}, Side::left);
  const Sweep s = sweep({-40, 60}, search);
  ASSERT_TRUE(s.search.found());
  EXPECT_EQ(s.search.side(), Side::left);
  EXPECT_GT(in_degrees(s.search.heading()), 60);
  EXPECT_GT(s.rightmost, -1);
}

TEST(FollowSideSearch, EndsWithoutAnExit) {
  const Sweep s = sweep({-179, 180}, both(Side::left));
  EXPECT_FALSE(s.search.found());
  EXPECT_GT(s.leftmost, 140);
  EXPECT_LT(s.rightmost, -140);
  EXPECT_LT(s.leftmost, 170);
  EXPECT_GT(s.rightmost, -170);
}

TEST(FollowSideSearch, JudgesOnlyNewReadings) {
  Ground g;
  g.free(0, 360);
  FollowSideSearch search = both(Side::left);
  View view = g.view();
  view.sighted = false;
  Twist twist;
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(search.step(view, twist));
  EXPECT_FALSE(search.found());
}

}  // namespace
}  // namespace whisker::planning
