#include "firmware/planning/boundary/gap_passage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "firmware/planning/goal_planner.hpp"
#include "host/harness/run/spec.hpp"
#include "tests/perception/rig.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using sim::Vec2;
using test::in_degrees;

constexpr Vec2 kMiddle{1.031, 0.774};
constexpr double kSeenFrom = 0.15;
constexpr double kPost = 0.2;   // radius
constexpr double kWall = 0.01;  // half its thickness

/// A gap with this heading through it, at any angle to the cells of the local grid.
struct Gap {
  double heading;
  /// The point this far along and to the left of the way through it, from its middle.
  Vec2 at(double along, double left) const {
    const double c = std::cos(heading), s = std::sin(heading);
    return {kMiddle.x + along * c - left * s, kMiddle.y + along * s + left * c};
  }
};

Scenario in_front_of(const Gap& gap) {
  Scenario s;
  s.start = {gap.at(-kSeenFrom, 0.01), gap.heading};
  s.goal.at = gap.at(2, 0);
  return s;
}

Scenario posts(const Gap& gap, double width) {
  Scenario s = in_front_of(gap);
  for (const int side : {-1, 1}) s.discs.push_back({gap.at(0, side * (width / 2 + kPost)), kPost});
  return s;
}

Scenario corners(const Gap& gap, double width) {
  Scenario s = in_front_of(gap);
  for (const int side : {-1, 1}) {
    const double from = side * width / 2, to = side * 1.5;
    std::vector<Vec2> wall{gap.at(-kWall, from), gap.at(kWall, from), gap.at(kWall, to), gap.at(-kWall, to)};
    if (side < 0) wall = {wall[0], wall[3], wall[2], wall[1]};
    s.polygons.push_back(wall);
  }
  return s;
}

/// Passes the gap that lies about here. Outcome::reached: it is through; Outcome::gave_up: it failed.
class PassagePlanner final : public GoalPlanner {
 public:
  PassagePlanner(const Params& params, const Pose& gap, bool promised)
      : behaviours_(params), passage_(behaviours_), gap_(gap), promised_(promised) {}
  const Pose& lane() const { return lane_; }

 private:
  void start(const View& view) noexcept override {
    behaviours_.progress.start(view);
    report(Mode::looking, Why::opening);
    passage_.begin(view, gap_, promised_, decision_);
  }
  void advance(const View& view) noexcept override {
    behaviours_.progress.move(view, behaviours_.params);
    switch (passage_.step(view, decision_)) {
      case GapPassage::Result::under_way: break;
      case GapPassage::Result::through: finish(Mode::arrived, Why::opening, Outcome::reached); break;
      case GapPassage::Result::failed: finish(Mode::gave_up, Why::opening, Outcome::gave_up); break;
    }
    if (decision_.lane.opens) lane_ = decision_.lane.from;
  }

  Behaviours behaviours_;
  GapPassage passage_;
  const Pose gap_;
  const bool promised_;
  Pose lane_;
};

struct Passed {
  Outcome outcome = Outcome::running;
  bool touched = false;
  double seconds = 0;
  double aside_mm = 0;  // the middle line of the last lane, from the middle of the gap
  double askew_deg = 0;
};

/// The passage is told of a place 20 mm aside, and a heading 6 degrees askew.
Passed pass(const Gap& gap, const Scenario& scenario, bool promised = false) {
  const Pose told = fixed_pose({gap.at(0, 0.02), gap.heading + 0.1});
  PassagePlanner planner(scenario.robot, told, promised);
  test::Rig rig(scenario, &planner);
  Passed p;
  while (p.seconds < 400 && rig.step()) p.seconds += 0.01;
  p.outcome = rig.status().decision.outcome;
  p.touched = rig.plant().in_contact();
  const Pose true_gap = fixed_pose({kMiddle, gap.heading});
  p.aside_mm = across(true_gap.at - planner.lane().at, planner.lane().heading).raw() / 1000.0;
  p.askew_deg = in_degrees(planner.lane().heading - true_gap.heading);
  return p;
}

using Place = Scenario (*)(const Gap&, double);

/// Drives at gaps of this width at some headings, and returns how many it passes.
int passed(Place place, double width) {
  int count = 0;
  for (const double heading : {0.0, 0.3, 0.7, -1.2}) {
    const Gap gap{heading};
    const Passed p = pass(gap, place(gap, width));
    EXPECT_TRUE(p.outcome == Outcome::reached || p.outcome == Outcome::gave_up) << width;
    EXPECT_FALSE(p.touched) << width;
    EXPECT_NEAR(p.aside_mm, 0, 1) << width;
    EXPECT_NEAR(p.askew_deg, 0, 3) << width;
    EXPECT_LT(p.seconds, 200) << width;
    if (p.outcome == Outcome::reached) ++count;
  }
  return count;
}

TEST(GapPassage, MeasuresTheMiddleBetweenRoundPostsToAMillimetre) {
  EXPECT_EQ(passed(posts, 0.225), 4);
  EXPECT_EQ(passed(posts, 0.24), 4);
  EXPECT_EQ(passed(posts, 0.27), 4);
}

TEST(GapPassage, MeasuresTheMiddleBetweenCornersToAMillimetre) {
  EXPECT_EQ(passed(corners, 0.225), 4);
  EXPECT_EQ(passed(corners, 0.24), 4);
  EXPECT_EQ(passed(corners, 0.27), 4);
}

TEST(GapPassage, APromisedWidthNeedsLessTime) {
  for (const double heading : {0.0, 0.3, 0.7, -1.2}) {
    const Gap gap{heading};
    for (const Place place : {posts, corners}) {
      const Passed wide = pass(gap, place(gap, 0.30), true);
      EXPECT_EQ(wide.outcome, Outcome::reached);
      EXPECT_LT(wide.seconds, pass(gap, place(gap, 0.30)).seconds);
      const Passed narrow = pass(gap, place(gap, 0.25), true);
      EXPECT_EQ(narrow.outcome, Outcome::gave_up);
      EXPECT_LT(narrow.seconds, 20);
      EXPECT_FALSE(wide.touched || narrow.touched);
    }
  }
}

TEST(GapPassage, FailsSoonWhereThereAreNoJambs) {
  const Gap gap{0.3};
  Scenario wall = in_front_of(gap);
  wall.walls.push_back({gap.at(0, -1.5), gap.at(0, 1.5)});
  for (const Scenario& s : {wall, corners(gap, 0.7)}) {
    const Passed p = pass(gap, s);
    EXPECT_EQ(p.outcome, Outcome::gave_up);
    EXPECT_FALSE(p.touched);
    EXPECT_LT(p.seconds, 40);
  }
}

TEST(GapPassage, GivesUpWhereTheBodyDoesNotFit) {
  const Gap gap{0.3};
  for (const double width : {0.15, 0.17, 0.182}) {
    for (const Scenario& s : {corners(gap, width), posts(gap, width)}) {
      const Passed p = pass(gap, s);
      EXPECT_EQ(p.outcome, Outcome::gave_up) << width;
      EXPECT_FALSE(p.touched) << width;
      EXPECT_LT(p.seconds, 240) << width;
    }
  }
}

}  // namespace
}  // namespace whisker::planning
