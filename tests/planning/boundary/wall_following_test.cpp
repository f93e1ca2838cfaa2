#include "firmware/planning/boundary/wall_following.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/planning/boundary/boundary_planner.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::echoes;
using test::Ground;

constexpr int kFar = 2000;
const double kOuter = std::sin(42.5 * 3.14159265358979 / 180);

/// The reading of a side beam next to a straight wall at this distance from the centre.
int beside(double wall_mm) { return static_cast<int>(std::lround(wall_mm / kOuter)); }

double turning(const Twist& t) { return t.turning.raw() * 1e-6; }
double forward(const Twist& t) { return t.forward.raw() * 1e-6; }

Twist left_wall(double wall_mm, int front_mm = kFar, int right_mm = kFar) {
  return along_edge(echoes(beside(wall_mm), front_mm, right_mm), Side::left, Params{});
}

TEST(Edge, IsFollowedAtItsDistance) {
  const Twist at = left_wall(150);
  EXPECT_NEAR(turning(at), 0, 0.02);
  EXPECT_GT(forward(at), 0.29);
  EXPECT_LT(turning(left_wall(130)), -0.2) << "too near: away";
  EXPECT_GT(turning(left_wall(170)), 0.2) << "too far: towards";
  EXPECT_LT(forward(left_wall(110)), forward(left_wall(130)));
}

TEST(Edge, IsMirrored) {
  for (const int side : {60, 150, 200, 400, kFar}) {
    for (const int front : {80, 200, 500, kFar}) {
      for (const int other : {100, 300, kFar}) {
        const Twist left = along_edge(echoes(side, front, other), Side::left, Params{});
        const Twist right = along_edge(echoes(other, front, side), Side::right, Params{});
        EXPECT_EQ(left.forward, right.forward);
        EXPECT_EQ(left.turning, -right.turning);
      }
    }
  }
}

TEST(Edge, TurnsAwayFromWhatIsAhead) {
  EXPECT_LT(turning(left_wall(150, 200)), turning(left_wall(150, 290)));
  EXPECT_LT(turning(left_wall(150, 290)), 0);
  EXPECT_NEAR(turning(left_wall(150, 310)), 0, 0.02);
  EXPECT_LT(turning(left_wall(kFar, 100)), 0) << "even where the wall has ended";
}

TEST(Edge, EndsInAnArcAroundIt) {
  for (const int radius_mm : {90, 45}) {
    Params params;
    params.body.radius = millimetres(radius_mm);
    params.body.track = millimetres(radius_mm);
    const Twist t = along_edge(echoes(kFar, kFar, kFar), Side::left, params);
    ASSERT_GT(turning(t), 0.5);
    EXPECT_NEAR(forward(t) / turning(t), 0.18 * radius_mm / 90, 0.002) << radius_mm;
    EXPECT_LE(t.forward, params.wheels.max_speed);
  }
}

TEST(Edge, OfANarrowWayIsItsMiddle) {
  EXPECT_NEAR(turning(left_wall(110, kFar, beside(110))), 0, 0.02);
  EXPECT_LT(turning(left_wall(100, kFar, beside(120))), -0.1);
  EXPECT_GT(turning(left_wall(120, kFar, beside(100))), 0.1);
}

TEST(Edge, IsFartherFromALargerBody) {
  Params large;
  large.body.radius = 180_mm;
  large.body.track = 280_mm;
  const auto at = [&](double wall_mm) {
    return turning(along_edge(echoes(beside(wall_mm), kFar, kFar), Side::left, large));
  };
  EXPECT_NEAR(at(300), 0, 0.02);
  EXPECT_LT(at(260), -0.1);
  EXPECT_GT(at(340), 0.1);
}

TEST(Edge, IsNeverTakenTooFast) {
  for (int side = 20; side <= kFar; side += 60) {
    for (int front = 20; front <= kFar; front += 60) {
      const Twist t = along_edge(echoes(side, front, kFar), Side::left, Params{});
      ASSERT_LE(abs(t.turning), kFastestTurn);
      ASSERT_GE(t.forward, Speed{});
      ASSERT_LE(t.forward, Params{}.wheels.max_speed);
    }
  }
}

// A body that turns but that the guard never lets drive gives up, whatever the planner believes.

class Straight final : public HeadingDeflection {
 public:
  Angle deflect(const View&, Angle, const Params&, Decision&) noexcept override { return {}; }
};

struct End {
  Outcome outcome = Outcome::running;
  Why why = Why::none;
  int ticks = 0;
};

End drive(const Ground& ground) {
  Straight law;
  BoundaryPlanner planner(ground.params(), law);
  planner.set_goal({{3_m, 0_mm}, 50_mm});
  View view = ground.view();
  End end;
  constexpr int kLongest = 100000;  // 1000 s
  while (end.outcome == Outcome::running && end.ticks < kLongest) {
    const Decision d = planner.step(view);
    end = {d.outcome, d.why, end.ticks + 1};
    const bool turns = d.manoeuvre.kind == ManoeuvreKind::cruise;
    view.turning = turns ? d.manoeuvre.turning : Speed{};
    const Length rim = view.turning * ground.params().safety.period;
    view.pose.heading += angle_of(rim * 2, ground.params().body.track);
    view.settled = !turns;
    view.elapsed = ground.params().safety.period;
    view.granted = {};
    view.sighted = end.ticks % 2 == 0;
  }
  return end;
}

void expect_given_up(const Ground& ground) {
  const End end = drive(ground);
  EXPECT_EQ(end.outcome, Outcome::gave_up);
  EXPECT_EQ(end.why, Why::no_exit);
  EXPECT_GT(end.ticks, 1000);
}

TEST(Held, GivesUpInOpenGround) {
  Ground open;
  open.free(0, 360);
  expect_given_up(open);
}

TEST(Held, GivesUpBesideAWall) {
  Ground wall;
  wall.free(30, 330).echo(-30, 30, 150_mm);
  expect_given_up(wall);
}

TEST(Held, GivesUpWhereItIsWalledIn) {
  Ground cell;
  cell.echo(0, 360, 125_mm);
  expect_given_up(cell);
}

}  // namespace
}  // namespace whisker::planning
