#include "firmware/planning/boundary/heading_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/planning/boundary/follow_side_search.hpp"
#include "firmware/planning/candidate_headings.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::Ground;
using test::in_degrees;

constexpr int kPatience = 20;  // steps; each judges at most a full turn

/// A heading search of a body that came straight along heading 0.
HeadingSearch come() {
  HeadingSearch feeler;
  feeler.reset({-(400_mm), 0_mm}, Params{});
  for (int mm = -400; mm <= 0; mm += 5) feeler.move({millimetres(mm), 0_mm});
  return feeler;
}

struct Felt {
  HeadingSearch::Found found = HeadingSearch::Found::nothing;
  HeadingSearch::Heading way;
};

Felt feel(HeadingSearch& feeler, const Ground& ground, Side wall) {
  feeler.begin_at_wall({}, Pose{}, wall);
  Felt felt;
  for (int i = 0; i < kPatience && felt.found == HeadingSearch::Found::nothing; ++i) {
    felt.found = feeler.step(ground.view(), ground.params(), felt.way);
  }
  return felt;
}

Way judged(const Ground& g, const HeadingSearch::Heading& h) {
  return way(g.view(), h.angle, h.length, g.local_grid().reach().planning);
}

TEST(HeadingSearch, FindsTheFirstWayFromTheWallsSide) {
  Ground g;
  g.free(0, 360);
  for (const Side wall : {Side::left, Side::right}) {
    HeadingSearch feeler = come();
    const Felt felt = feel(feeler, g, wall);
    EXPECT_EQ(felt.found, HeadingSearch::Found::free);
    const double to_wall = in_degrees(felt.way.angle) * sign(wall);
    EXPECT_GT(to_wall, 75) << "all is free: it turns to where the wall was";
    EXPECT_LT(to_wall, 136) << "but not back";
  }
}

TEST(HeadingSearch, TurnsAwayFromTheWallUntilAWayIsFree) {
  Ground left;
  left.free(-180, -30).echo(-30, 180, 150_mm);
  HeadingSearch feeler = come();
  const Felt felt = feel(feeler, left, Side::left);
  ASSERT_EQ(felt.found, HeadingSearch::Found::free);
  EXPECT_EQ(judged(left, felt.way), Way::free);
  EXPECT_LT(in_degrees(felt.way.angle), -30);
  EXPECT_GT(in_degrees(felt.way.angle), -110) << "the first one";

  Ground right;
  right.free(30, 180).echo(-180, 30, 150_mm);
  HeadingSearch mirrored = come();
  const Felt other = feel(mirrored, right, Side::right);
  ASSERT_EQ(other.found, HeadingSearch::Found::free);
  EXPECT_NEAR(in_degrees(other.way.angle), -in_degrees(felt.way.angle), 7.6);
}

TEST(HeadingSearch, WantsToSeeWhatIsOpen) {
  Ground g;
  g.echo(-30, 180, 150_mm);
  HeadingSearch feeler = come();
  const Felt felt = feel(feeler, g, Side::left);
  ASSERT_EQ(felt.found, HeadingSearch::Found::unseen);
  EXPECT_EQ(judged(g, felt.way), Way::unknown);
}

// A scan may end without showing anything, again and again: the counts of a coarse encoder shift the path.
TEST(HeadingSearch, DoesNotScanOneWayForEver) {
  Ground g;
  g.echo(-30, 180, 150_mm);
  HeadingSearch feeler = come();
  const Felt felt = feel(feeler, g, Side::left);
  ASSERT_EQ(felt.found, HeadingSearch::Found::unseen);
  HeadingSearch::Heading again;
  int scans = 1;
  while (scans < 100 && feeler.step(g.view(), g.params(), again) == HeadingSearch::Found::unseen &&
         again.angle == felt.way.angle) {
    ++scans;
  }
  EXPECT_EQ(scans, 8);
  EXPECT_EQ(judged(g, again), Way::unknown) << "it goes on with the next one";
}

TEST(HeadingSearch, TakesAShorterWayWhereNoneIsLong) {
  Ground g;
  g.free(0, 360, 230_mm).echo(0, 360, 230_mm);
  HeadingSearch feeler = come();
  const Felt felt = feel(feeler, g, Side::left);
  ASSERT_EQ(felt.found, HeadingSearch::Found::free);
  EXPECT_LT(felt.way.length, g.local_grid().reach().probe);
  EXPECT_EQ(judged(g, felt.way), Way::free);
}

TEST(HeadingSearch, RetreatsFromWhereNoWayIs) {
  Ground g;
  g.echo(0, 360, 112_mm);
  HeadingSearch feeler = come();
  ASSERT_EQ(feel(feeler, g, Side::left).found, HeadingSearch::Found::none);

  View view = g.view();
  Manoeuvre m;
  ASSERT_EQ(feeler.retreat(view, false, g.params(), m), HeadingSearch::Retreat::under_way);
  EXPECT_EQ(m.kind, ManoeuvreKind::cruise);
  EXPECT_EQ(m.forward, Speed{}) << "it turns round first";
  view.pose.heading = 180_deg;
  ASSERT_EQ(feeler.retreat(view, false, g.params(), m), HeadingSearch::Retreat::under_way);
  EXPECT_GT(m.forward, Speed{});
  EXPECT_NEAR(m.turning.raw() * 1e-6, 0, 1e-3);
  int mm = 0;
  while (mm < 400 && feeler.retreat(view, false, g.params(), m) == HeadingSearch::Retreat::under_way) {
    view.pose.at.x = -millimetres(++mm);
  }
  EXPECT_GE(mm, 60);
  EXPECT_LE(mm, 130);
}

TEST(HeadingSearch, IsLostWhenItIsStuckInOnePlaceAgainAndAgain) {
  Ground g;
  g.echo(0, 360, 112_mm);
  HeadingSearch feeler = come();
  const auto stuck = [&] {
    feel(feeler, g, Side::left);
    Manoeuvre m;
    return feeler.retreat(g.view(), true, g.params(), m);
  };
  int times = 1;
  while (times < 100 && stuck() == HeadingSearch::Retreat::stuck) ++times;
  EXPECT_GT(times, 2);
  EXPECT_LT(times, 20);

  HeadingSearch moving = come();
  for (int n = 0; n < 100; ++n) {
    feel(moving, g, Side::left);
    Manoeuvre m;
    ASSERT_EQ(moving.retreat(g.view(), true, g.params(), m), HeadingSearch::Retreat::stuck);
    moving.move({millimetres(200 + 50 * (n % 5)), 0_mm});
  }
}

TEST(HeadingSearch, GoesOnWithTheNextWayWhereTheGuardRefusesOne) {
  Ground g;
  g.free(0, 360);
  HeadingSearch feeler = come();
  Felt felt = feel(feeler, g, Side::left);
  for (int n = 0; n < 10; ++n) {
    ASSERT_EQ(felt.found, HeadingSearch::Found::free);
    const double before = in_degrees(felt.way.angle);
    feeler.refuse();
    felt.found = feeler.step(g.view(), g.params(), felt.way);
    EXPECT_NEAR(in_degrees(felt.way.angle), before - 7.5, 0.1) << "away from the wall";
  }
}

TEST(HeadingSearch, ARetreatThatLeadsNowhereCountsToo) {
  Ground g;
  g.echo(0, 360, 112_mm);
  HeadingSearch feeler;
  feeler.reset({}, g.params());
  HeadingSearch::Retreat end = HeadingSearch::Retreat::there;
  int times = 0;
  for (; times < 100 && end != HeadingSearch::Retreat::lost; ++times) {
    ASSERT_EQ(feel(feeler, g, Side::left).found, HeadingSearch::Found::none);
    Manoeuvre m;
    do end = feeler.retreat(g.view(), false, g.params(), m);
    while (end == HeadingSearch::Retreat::under_way);
    ASSERT_NE(end, HeadingSearch::Retreat::stuck);
  }
  EXPECT_GT(times, 2);
  EXPECT_LT(times, 20);
}

TEST(HeadingSearch, NoticesAnOpeningInTheWallBesideIt) {
  const HeadingSearch feeler = come();
  Ground closed;
  closed.free(-100, 40).echo(40, 140, 140_mm);
  EXPECT_FALSE(feeler.opening(closed.view(), Side::left, closed.params()));
  Ground door;
  door.free(-100, 140);
  EXPECT_TRUE(feeler.opening(door.view(), Side::left, door.params()));
  EXPECT_FALSE(feeler.opening(closed.view(), Side::left, closed.params()));
  Ground mirrored;
  mirrored.free(-140, 100);
  EXPECT_TRUE(feeler.opening(mirrored.view(), Side::right, mirrored.params()));
}

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
