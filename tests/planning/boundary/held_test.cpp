// A body that turns but that the guard never lets drive gives up, whatever the planner believes.
#include <gtest/gtest.h>

#include "firmware/planning/boundary/boundary_planner.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::Ground;

class Straight final : public HeadingDeflection {
 public:
  Angle deflect(const perception::Echoes&, const Params&, Decision&) noexcept override { return {}; }
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
