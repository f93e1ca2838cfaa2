#include "firmware/planning/boundary/slit_search.hpp"

#include <gtest/gtest.h>

#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::degrees;
using test::Ground;
using test::in_degrees;

constexpr Length kSlitAhead = 150_mm;  // a slit is this far ahead of the place from which it is seen
constexpr Angle kAhead = Angle::turns(1, 4);

/// A body here sees a clear path to the north between echoes this far to the left and right of it, at 110 mm
/// ahead.
Ground slit_at(Vec at, Length left = 120_mm, Length right = 120_mm) {
  Ground ground({at, {}});
  ground.free(45, 135, 300_mm);
  const auto echo = [&](Length aside, int sign) {
    const Vec jamb{110_mm, aside};
    const int deg = 90 + sign * static_cast<int>(in_degrees(bearing(jamb)));
    ground.echo(deg - 3, deg + 3, norm(jamb));
  };
  echo(left, 1);
  echo(right, -1);
  return ground;
}

struct SlitSearchTest : testing::Test {
  const Params params;
  Behaviours behaviours{params};
  SlitSearch slits{behaviours};
  SlitSearchTest() { slits.reset(); }

  /// Whether the search knows a slit after it has looked at this ground alone.
  bool finds(const Ground& ground) {
    slits.reset();
    slits.look(ground.view(), kAhead);
    return slits.known();
  }
  /// Looks at a slit here, and tries it in vain.
  void fail_at(Vec at) {
    const Ground ground = slit_at(at);
    slits.look(ground.view(), kAhead);
    ASSERT_TRUE(slits.at_hand(ground.view()));
    slits.take(ground.view());
    slits.end_attempt();
  }
};

TEST_F(SlitSearchTest, FindsASlitWhereTheEchoesLie) {
  const Ground ground = slit_at({1_m, 2_m});
  ASSERT_TRUE(finds(ground));
  ASSERT_TRUE(slits.at_hand(ground.view()));
  const Pose slit = slits.take(ground.view());
  EXPECT_EQ(slit.heading, kAhead);
  EXPECT_NEAR(slit.at.x.raw(), (1_m).raw(), 10);
  EXPECT_NEAR(slit.at.y.raw(), (2_m + kSlitAhead).raw(), 10);
  EXPECT_FALSE(slits.known()) << "it is taken";
}

TEST_F(SlitSearchTest, FindsSlitsOfTheWidthsThatTheGridDoesNotShow) {
  for (int aside = 100; aside <= 150; aside += 10) {
    EXPECT_TRUE(finds(slit_at({}, millimetres(aside), millimetres(aside)))) << aside;
  }
  EXPECT_FALSE(finds(slit_at({}, 40_mm, 40_mm))) << "an echo on the path itself";
  EXPECT_FALSE(finds(slit_at({}, 230_mm, 230_mm))) << "no slit: the local grid shows it clear";
}

TEST_F(SlitSearchTest, FindsNoneWithoutEchoesOnBothSides) {
  EXPECT_FALSE(finds(slit_at({}, 120_mm, 300_mm)));
  EXPECT_FALSE(finds(slit_at({}, 300_mm, 120_mm)));
}

TEST_F(SlitSearchTest, FindsNoneWhereThePathIsNotClear) {
  Ground unseen;
  unseen.echo(40, 46, 160_mm).echo(134, 140, 160_mm);
  EXPECT_FALSE(finds(unseen)) << "unknown between the echoes";
  Ground wall;
  wall.free(45, 135, 160_mm).echo(40, 140, 160_mm);
  EXPECT_FALSE(finds(wall)) << "a wall across";
}

TEST_F(SlitSearchTest, LooksOnTheSideOfTheWall) {
  const Ground ground = slit_at({});
  for (const Side wall : {Side::left, Side::right}) {
    slits.reset();
    View view = ground.view(wall == Side::left ? Angle{} : degrees(180));
    behaviours.progress.start(view);
    view.travelled_um += 21'000;
    behaviours.progress.move(view, params);
    slits.look_on_boundary(view, wall);
    EXPECT_TRUE(slits.known());
    slits.reset();
    view.travelled_um += 21'000;
    behaviours.progress.move(view, params);
    slits.look_on_boundary(view, opposite(wall));
    EXPECT_FALSE(slits.known());
  }
}

TEST_F(SlitSearchTest, OneSlitSeenFromTwoPlacesCountsOnce) {
  slits.look(slit_at({}).view(), kAhead);
  const Ground next = slit_at({40_mm, 0_mm});
  slits.look(next.view(), kAhead);
  EXPECT_NEAR(slits.take(next.view()).at.x.raw(), (40_mm).raw(), 10) << "the newer view";
  EXPECT_FALSE(slits.known());
}

TEST_F(SlitSearchTest, RemembersTheLastFour) {
  for (int i = 0; i < 5; ++i) slits.look(slit_at({1_m * i, 0_m}).view(), kAhead);
  EXPECT_FALSE(slits.at_hand(Ground({{}, {}}).view())) << "the oldest of five";
  for (int i = 1; i < 5; ++i) {
    const Ground there({{1_m * i, 0_m}, {}});
    ASSERT_TRUE(slits.at_hand(there.view())) << i;
    EXPECT_NEAR(slits.take(there.view()).at.x.raw(), (1_m * i).raw(), 10);
  }
  EXPECT_FALSE(slits.known());
}

TEST_F(SlitSearchTest, KnowsNoSlitWhereOneWasTried) {
  fail_at({});
  EXPECT_FALSE(slits.known());
  slits.look(slit_at({}).view(), kAhead);
  EXPECT_FALSE(slits.known()) << "the same one";
  slits.look(slit_at({60_mm, 0_mm}).view(), kAhead);
  EXPECT_FALSE(slits.known()) << "the same one, from beside";
  slits.look(slit_at({100_mm, 0_mm}).view(), kAhead);
  EXPECT_TRUE(slits.known()) << "another one";
}

TEST_F(SlitSearchTest, AnAttemptForgetsTheOtherViewsOfItsSlit) {
  slits.look(slit_at({}).view(), kAhead);
  slits.look(slit_at({1_m, 0_m}).view(), kAhead);
  const Ground again = slit_at({40_mm, 0_mm});
  slits.look(again.view(), kAhead);
  slits.take(again.view());
  slits.end_attempt();
  EXPECT_FALSE(slits.at_hand(again.view()));
  EXPECT_TRUE(slits.known()) << "that one metre away";
}

TEST_F(SlitSearchTest, RemembersTheLastThreeThatWereTried) {
  for (int i = 0; i < 4; ++i) fail_at({1_m * i, 0_m});
  for (int i = 0; i < 4; ++i) {
    slits.look(slit_at({1_m * i, 0_m}).view(), kAhead);
    EXPECT_EQ(slits.known(), i == 0) << i;
    if (slits.known()) slits.take(slit_at({1_m * i, 0_m}).view());
  }
}

TEST_F(SlitSearchTest, TriesNoMoreAfterSixAttemptsInAMission) {
  for (int i = 0; i < 5; ++i) fail_at({1_m * i, 0_m});
  const Ground fresh = slit_at({0_m, 5_m});
  slits.look(fresh.view(), kAhead);
  ASSERT_TRUE(slits.known());
  fail_at({1_m * 5, 0_m});
  EXPECT_FALSE(slits.known()) << "not even those that are known";
  slits.look(fresh.view(), kAhead);
  EXPECT_FALSE(slits.known());
  EXPECT_TRUE(finds(fresh)) << "in the next mission";
}

TEST_F(SlitSearchTest, ExpectsASlitForAMetreAndAHalf) {
  const Ground ground = slit_at({});
  View view = ground.view();
  behaviours.progress.start(view);
  slits.look(view, kAhead);
  EXPECT_TRUE(slits.expected(view));
  view.travelled_um = 1'490'000;
  behaviours.progress.move(view, params);
  EXPECT_TRUE(slits.expected(view));
  view.travelled_um = 1'510'000;
  behaviours.progress.move(view, params);
  EXPECT_FALSE(slits.expected(view));
}

TEST_F(SlitSearchTest, ExpectsAnUnknownSlitWhereTheLoopBegan) {
  View view = Ground().view();
  behaviours.progress.start(view);
  EXPECT_TRUE(slits.expected(view));
  view.travelled_um = 590'000;
  behaviours.progress.move(view, params);
  EXPECT_TRUE(slits.expected(view));
  view.travelled_um = 610'000;
  behaviours.progress.move(view, params);
  EXPECT_FALSE(slits.expected(view));
}

TEST_F(SlitSearchTest, ALoopEndsWithoutTheSlitsOfItsEnd) {
  slits.look(slit_at({}).view(), kAhead);
  slits.look(slit_at({1_m, 0_m}).view(), kAhead);
  slits.end_loop(Ground({{300_mm, 0_mm}, {}}).view());
  EXPECT_FALSE(slits.at_hand(Ground().view()));
  EXPECT_TRUE(slits.at_hand(Ground({{1_m, 0_m}, {}}).view()));
}

}  // namespace
}  // namespace whisker::planning
