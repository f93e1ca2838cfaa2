#include "firmware/nav/feeler.hpp"

#include <gtest/gtest.h>

#include "firmware/nav/ways.hpp"
#include "tests/nav/ground.hpp"

namespace whisker::nav {
namespace {

using test::Ground;
using test::in_degrees;

constexpr int kPatience = 20;  // steps; each judges a whole turn at most

/// A feeler of a body that came straight along its heading, 0.
Feeler come() {
  Feeler feeler;
  feeler.reset({-(400_mm), 0_mm}, Params{});
  for (int mm = -400; mm <= 0; mm += 5) feeler.move({millimetres(mm), 0_mm});
  return feeler;
}

struct Felt {
  Feeler::Found found = Feeler::Found::nothing;
  Feeler::Heading way;
};

Felt feel(Feeler& feeler, const Ground& ground, Side wall) {
  feeler.begin_at_wall({}, Pose{}, wall);
  Felt felt;
  for (int i = 0; i < kPatience && felt.found == Feeler::Found::nothing; ++i) {
    felt.found = feeler.step(ground.view(), ground.params(), felt.way);
  }
  return felt;
}

Way judged(const Ground& g, const Feeler::Heading& h) {
  return way(g.view(), h.angle, h.length, g.patch().reach().planning);
}

TEST(Feeler, FindsTheFirstWayFromTheWallsSide) {
  Ground g;
  g.free(0, 360);
  for (const Side wall : {Side::left, Side::right}) {
    Feeler feeler = come();
    const Felt felt = feel(feeler, g, wall);
    EXPECT_EQ(felt.found, Feeler::Found::free);
    const double to_wall = in_degrees(felt.way.angle) * sign(wall);
    EXPECT_GT(to_wall, 75) << "all is free: it turns to where the wall was";
    EXPECT_LT(to_wall, 136) << "but not back";
  }
}

TEST(Feeler, TurnsAwayFromTheWallUntilAWayIsFree) {
  Ground left;
  left.free(-180, -30).echo(-30, 180, 150_mm);
  Feeler feeler = come();
  const Felt felt = feel(feeler, left, Side::left);
  ASSERT_EQ(felt.found, Feeler::Found::free);
  EXPECT_EQ(judged(left, felt.way), Way::free);
  EXPECT_LT(in_degrees(felt.way.angle), -30);
  EXPECT_GT(in_degrees(felt.way.angle), -110) << "the first one";

  Ground right;
  right.free(30, 180).echo(-180, 30, 150_mm);
  Feeler mirrored = come();
  const Felt other = feel(mirrored, right, Side::right);
  ASSERT_EQ(other.found, Feeler::Found::free);
  EXPECT_NEAR(in_degrees(other.way.angle), -in_degrees(felt.way.angle), 7.6);
}

TEST(Feeler, WantsToSeeWhatIsOpen) {
  Ground g;
  g.echo(-30, 180, 150_mm);
  Feeler feeler = come();
  const Felt felt = feel(feeler, g, Side::left);
  ASSERT_EQ(felt.found, Feeler::Found::unseen);
  EXPECT_EQ(judged(g, felt.way), Way::open);
}

TEST(Feeler, TakesAShorterWayWhereNoneIsLong) {
  Ground g;
  g.free(0, 360, 230_mm).echo(0, 360, 230_mm);
  Feeler feeler = come();
  const Felt felt = feel(feeler, g, Side::left);
  ASSERT_EQ(felt.found, Feeler::Found::free);
  EXPECT_LT(felt.way.length, g.patch().reach().probe);
  EXPECT_EQ(judged(g, felt.way), Way::free);
}

TEST(Feeler, RetreatsFromWhereNoWayIs) {
  Ground g;
  g.echo(0, 360, 112_mm);
  Feeler feeler = come();
  ASSERT_EQ(feel(feeler, g, Side::left).found, Feeler::Found::none);

  View view = g.view();
  Manoeuvre m;
  ASSERT_EQ(feeler.retreat(view, false, g.params(), m), Feeler::Retreat::under_way);
  EXPECT_EQ(m.kind, Kind::cruise);
  EXPECT_EQ(m.forward, Speed{}) << "it turns round first";
  view.pose.heading = 180_deg;
  ASSERT_EQ(feeler.retreat(view, false, g.params(), m), Feeler::Retreat::under_way);
  EXPECT_GT(m.forward, Speed{});
  EXPECT_NEAR(m.turning.raw() * 1e-6, 0, 1e-3);
  int mm = 0;
  while (mm < 400 && feeler.retreat(view, false, g.params(), m) == Feeler::Retreat::under_way) {
    view.pose.at.x = -millimetres(++mm);
  }
  EXPECT_GE(mm, 60);
  EXPECT_LE(mm, 130);
}

TEST(Feeler, IsLostWhenItIsStuckInOnePlaceAgainAndAgain) {
  Ground g;
  g.echo(0, 360, 112_mm);
  Feeler feeler = come();
  const auto stuck = [&] {
    feel(feeler, g, Side::left);
    Manoeuvre m;
    return feeler.retreat(g.view(), true, g.params(), m);
  };
  int times = 1;
  while (times < 100 && stuck() == Feeler::Retreat::stuck) ++times;
  EXPECT_GT(times, 2);
  EXPECT_LT(times, 20);

  Feeler moving = come();
  for (int n = 0; n < 100; ++n) {
    feel(moving, g, Side::left);
    Manoeuvre m;
    ASSERT_EQ(moving.retreat(g.view(), true, g.params(), m), Feeler::Retreat::stuck);
    moving.move({millimetres(200 + 50 * (n % 5)), 0_mm});
  }
}

TEST(Feeler, GoesOnWithTheNextWayWhereTheShieldRefusesOne) {
  Ground g;
  g.free(0, 360);
  Feeler feeler = come();
  Felt felt = feel(feeler, g, Side::left);
  for (int n = 0; n < 10; ++n) {
    ASSERT_EQ(felt.found, Feeler::Found::free);
    const double before = in_degrees(felt.way.angle);
    feeler.refuse();
    felt.found = feeler.step(g.view(), g.params(), felt.way);
    EXPECT_NEAR(in_degrees(felt.way.angle), before - 7.5, 0.1) << "away from the wall";
  }
}

TEST(Feeler, ARetreatThatLeadsNowhereCountsToo) {
  Ground g;
  g.echo(0, 360, 112_mm);
  Feeler feeler;
  feeler.reset({}, g.params());
  Feeler::Retreat end = Feeler::Retreat::there;
  int times = 0;
  for (; times < 100 && end != Feeler::Retreat::lost; ++times) {
    ASSERT_EQ(feel(feeler, g, Side::left).found, Feeler::Found::none);
    Manoeuvre m;
    do end = feeler.retreat(g.view(), false, g.params(), m);
    while (end == Feeler::Retreat::under_way);
    ASSERT_NE(end, Feeler::Retreat::stuck);
  }
  EXPECT_GT(times, 2);
  EXPECT_LT(times, 20);
}

TEST(Feeler, NoticesAnOpeningInTheWallBesideIt) {
  const Feeler feeler = come();
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

}  // namespace
}  // namespace whisker::nav
