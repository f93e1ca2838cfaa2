#include "firmware/planning/thesis/thesis_planner.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace whisker::planning {
namespace {

using perception::Echo;
using perception::Echoes;
using perception::Validity;

Echoes echoes(int left_mm, int front_mm, int right_mm) {
  Echoes e;
  const int mm[] = {left_mm, front_mm, right_mm};
  for (int i = 0; i < hal::kBeams; ++i) {
    e.beam[i] = {millimetres(mm[i]), mm[i] == 2000 ? Validity::clear : Validity::ok};
  }
  return e;
}

const Echoes kOpen = echoes(2000, 2000, 2000);
const Echoes kWall = echoes(2000, 200, 2000);

View view_of(const Pose& pose, bool settled, const Echoes& scan) {
  View view;
  view.pose = pose;
  view.settled = settled;
  view.static_scan = scan;
  return view;
}

std::int32_t degrees(Angle a) {
  return static_cast<std::int32_t>(divide_rounded_64(std::int64_t{a.wrapped()} * 360, std::int64_t{1} << 32));
}

/// Executes every manoeuvre at once and shows the planner the test's readings for each heading.
class Puppet {
 public:
  using RecentReadings = std::function<Echoes(int heading_deg)>;
  explicit Puppet(const Params& params = Params{})
      : params_(params), planner_(params_, fuzzy::kDefaultTable) {}

  /// Steps until the planner requests a manoeuvre or is done; performs the manoeuvre.
  Decision next(const RecentReadings& sight) {
    Decision d;
    for (int i = 0; i < 5; ++i) {
      d = planner_.step(view_of(pose, true, sight(degrees(pose.heading))));
      looks += d.looked ? 1 : 0;
      if (d.manoeuvre.kind != ManoeuvreKind::keep || d.outcome != Outcome::running) break;
    }
    if (d.manoeuvre.kind == ManoeuvreKind::turn) pose.heading = d.manoeuvre.heading;
    if (d.manoeuvre.kind == ManoeuvreKind::drive)
      pose.at = pose.at + polar(d.manoeuvre.heading, d.manoeuvre.length);
    return d;
  }
  /// Until a drive, or the end.
  Decision next_drive(const RecentReadings& sight) {
    Decision d;
    do {
      d = next(sight);
      turns.push_back(degrees(pose.heading));
    } while (d.manoeuvre.kind != ManoeuvreKind::drive && d.outcome == Outcome::running);
    return d;
  }
  ThesisPlanner& planner() { return planner_; }

  Pose pose;
  std::vector<int> turns;
  int looks = 0;

 private:
  Params params_;
  ThesisPlanner planner_;
};

Puppet with_goal(int x_mm, int y_mm, const Params& params = Params{}) {
  Puppet p(params);
  p.planner().set_goal({{millimetres(x_mm), millimetres(y_mm)}, 100_mm});
  return p;
}

TEST(Thesis, RestsWithoutAGoal) {
  Puppet p;
  const Decision d = p.planner().step(View{});
  EXPECT_EQ(d.mode, Mode::idle);
  EXPECT_EQ(d.outcome, Outcome::none);
  EXPECT_EQ(d.manoeuvre.kind, ManoeuvreKind::keep);
}

TEST(Thesis, StopsThenFacesTheGoalThenStepsInTheOpenByTheTablesLargestStep) {
  Puppet p = with_goal(0, 3000);
  const auto open = [](int) { return kOpen; };
  EXPECT_EQ(p.next(open).manoeuvre.kind, ManoeuvreKind::stop);
  const Decision face = p.next(open);
  EXPECT_EQ(face.manoeuvre.kind, ManoeuvreKind::turn);
  EXPECT_EQ(face.mode, Mode::facing);
  EXPECT_EQ(degrees(face.manoeuvre.heading), 90);
  const Decision drive = p.next(open);
  EXPECT_EQ(drive.manoeuvre.kind, ManoeuvreKind::drive);
  EXPECT_EQ(drive.mode, Mode::stepping);
  EXPECT_EQ(drive.why, Why::target_free);
  EXPECT_EQ(drive.manoeuvre.length, 200_mm * drive.response.step);
  EXPECT_EQ(drive.inputs.distance.raw(), 1280);
  EXPECT_EQ(drive.inputs.bias.raw(), 0);
}

TEST(Thesis, TheLastStepEndsAtTheGoal) {
  Puppet p = with_goal(250, 0);
  const auto open = [](int) { return kOpen; };
  EXPECT_EQ(p.next_drive(open).manoeuvre.length, 250_mm);
  const Decision done = p.next(open);
  EXPECT_EQ(done.outcome, Outcome::reached);
  EXPECT_EQ(done.why, Why::at_goal);
}

TEST(Thesis, ClaimsTheGoalOnlyWellInsideTheTolerance) {
  for (const int off_mm : {87, 88}) {
    Puppet p = with_goal(off_mm, 0);
    const auto open = [](int) { return kOpen; };
    p.next(open);
    EXPECT_EQ(p.next(open).outcome, off_mm == 87 ? Outcome::reached : Outcome::running) << off_mm;
  }
}

TEST(Thesis, AnObstacleOnTheLeftTurnsTheStepRightAndMirrored) {
  Puppet left = with_goal(3000, 0);
  Puppet right = with_goal(3000, 0);
  const Decision l = left.next_drive([](int) { return echoes(500, 700, 2000); });
  const Decision r = right.next_drive([](int) { return echoes(2000, 700, 500); });
  EXPECT_EQ(l.why, Why::table);
  EXPECT_LT(l.manoeuvre.heading.wrapped(), 0);
  EXPECT_EQ(l.manoeuvre.heading, -r.manoeuvre.heading);
  EXPECT_EQ(l.manoeuvre.heading, scaled(30_deg, l.response.turn));
  EXPECT_EQ(l.manoeuvre.length, r.manoeuvre.length);
  EXPECT_EQ(l.danger_count, 0);
}

TEST(Thesis, BehindTheGoalNothingMatters) {
  Puppet p = with_goal(300, 0);
  const Decision d = p.next_drive([](int) { return echoes(600, 500, 2000); });
  EXPECT_EQ(d.why, Why::target_free);
  EXPECT_EQ(d.manoeuvre.heading, Angle{});
  EXPECT_EQ(d.manoeuvre.length,
            300_mm * Q14::ratio(1, 1) < 200_mm * d.response.step ? 300_mm : 200_mm * d.response.step);
}

TEST(Thesis, ProbesByDeltaUntilTheStepIsFree) {
  // Nothing ahead, and 0.33 m on both sides: free up to the danger range, too narrow for a full step.
  Puppet p = with_goal(3000, 0);
  const Decision d = p.next_drive([](int deg) { return deg <= -30 ? kOpen : echoes(330, 2000, 335); });
  EXPECT_EQ(d.mode, Mode::stepping);
  EXPECT_EQ(d.why, Why::narrow);
  // The right side has more room. At -30 degrees the obstacle seen before lies in the gap between two cones.
  EXPECT_EQ(degrees(d.manoeuvre.heading), -40);
  EXPECT_EQ(d.danger_count, 0);

  Puppet q = with_goal(3000, 0);
  const Decision e = q.next_drive([](int deg) { return deg >= 40 ? kOpen : echoes(335, 2000, 330); });
  EXPECT_EQ(degrees(e.manoeuvre.heading), 50);
}

TEST(Thesis, ABlockedTargetIsDangerAndTheSmallerTurnWins) {
  Puppet p = with_goal(3000, 0);
  const auto exit_at = [](int left, int right) {
    return [=](int deg) { return deg >= left || deg <= -right ? kOpen : kWall; };
  };
  const Decision d = p.next_drive(exit_at(60, 40));
  EXPECT_EQ(d.danger_count, 1);
  EXPECT_EQ(d.mode, Mode::following);
  EXPECT_EQ(d.why, Why::exit_right);
  EXPECT_EQ(degrees(d.manoeuvre.heading), -40);
  EXPECT_EQ(d.manoeuvre.length, 100_mm);

  Puppet q = with_goal(3000, 0);
  const Decision e = q.next_drive(exit_at(40, 60));
  EXPECT_EQ(e.why, Why::exit_left);
  EXPECT_EQ(degrees(e.manoeuvre.heading), 40);
  for (const int deg : q.turns) EXPECT_GT(deg, -40) << "the right side is worth a look only below 40 degrees";

  Puppet tie = with_goal(3000, 0);
  EXPECT_EQ(tie.next_drive(exit_at(50, 50)).why, Why::exit_left);
  Puppet first = with_goal(3000, 0);
  const Decision f = first.next_drive([](int deg) { return deg == 0 ? echoes(2000, 2000, 180) : kOpen; });
  EXPECT_EQ(f.why, Why::exit_left);
  EXPECT_EQ(degrees(f.manoeuvre.heading), 10);
}

TEST(Thesis, WhileTheTargetStaysBlockedItKeepsTheSideAndCounts) {
  Puppet p = with_goal(3000, 0);
  const auto right_only = [](int deg) { return deg <= -40 ? kOpen : kWall; };
  const auto either = [](int deg) { return deg <= -60 || deg >= 20 ? kOpen : kWall; };
  EXPECT_EQ(p.next_drive(right_only).danger_count, 1);
  const Decision second = p.next_drive(either);
  EXPECT_EQ(second.danger_count, 2);
  EXPECT_EQ(second.why, Why::same_side);
  EXPECT_EQ(second.mode, Mode::following);
  EXPECT_LE(degrees(second.manoeuvre.heading), -50);
  EXPECT_EQ(second.manoeuvre.length, 100_mm);
  EXPECT_EQ(p.next_drive(either).danger_count, 3);
  const Decision freed = p.next_drive([](int) { return kOpen; });
  EXPECT_EQ(freed.danger_count, 0);
  EXPECT_EQ(freed.mode, Mode::stepping);
}

TEST(Thesis, TheDangerCountSaturates) {
  Params params;
  params.boundary.length_budget = 100_m;
  Puppet p = with_goal(100000, 0, params);
  Decision d;
  for (int i = 0; i < 400; ++i)
    d = p.next_drive([](int deg) { return deg >= 80 || deg <= -80 ? kOpen : kWall; });
  EXPECT_EQ(d.danger_count, UINT8_MAX);
}

TEST(Thesis, GivesUpWhereNoHeadingIsFree) {
  Puppet p = with_goal(3000, 0);
  const Decision d = p.next_drive([](int) { return kWall; });
  EXPECT_EQ(d.outcome, Outcome::gave_up);
  EXPECT_EQ(d.mode, Mode::gave_up);
  EXPECT_EQ(d.why, Why::no_exit);
  EXPECT_EQ(d.manoeuvre.kind, ManoeuvreKind::keep);
}

TEST(Thesis, GivesUpWhereASecondPositionHasNoFreeHeading) {
  Puppet p = with_goal(3000, 0);
  p.next_drive([](int deg) { return deg >= 30 ? kOpen : kWall; });
  const Decision d = p.next_drive([](int) { return kWall; });
  EXPECT_EQ(d.why, Why::no_exit);
  EXPECT_GE(p.turns.size(), 35U);
}

TEST(Thesis, GivesUpWhenTheStepsAreUsedUp) {
  Params params;
  params.boundary.length_budget = 300_mm;
  Puppet p = with_goal(3000, 0, params);
  const auto open = [](int) { return kOpen; };
  for (int i = 0; i < 3; ++i) EXPECT_EQ(p.next_drive(open).manoeuvre.kind, ManoeuvreKind::drive);
  const Decision d = p.next(open);
  EXPECT_EQ(d.outcome, Outcome::gave_up);
  EXPECT_EQ(d.why, Why::step_budget);
}

TEST(Thesis, WaitsForReadingsThatItCanBelieve) {
  Puppet p = with_goal(3000, 0);
  const auto lost = [](int) {
    Echoes e = kOpen;
    e.beam[hal::kRight] = {Length{}, Validity::pending};
    return e;
  };
  p.next(lost);
  p.next(lost);
  for (int i = 0; i < 100; ++i) {
    const Decision d = p.next(lost);
    ASSERT_EQ(d.mode, Mode::looking);
    ASSERT_EQ(d.manoeuvre.kind, ManoeuvreKind::keep);
  }
  EXPECT_EQ(p.looks, 0);
  EXPECT_EQ(p.next([](int) { return kOpen; }).manoeuvre.kind, ManoeuvreKind::drive);
}

TEST(Thesis, ANewGoalStartsAfreshFromAnyState) {
  Puppet p = with_goal(3000, 0);
  p.next_drive([](int deg) { return deg >= 30 ? kOpen : kWall; });
  p.planner().set_goal({{-(1000_mm), 0_mm}, 100_mm});
  const Decision d = p.planner().step(view_of(p.pose, false, {}));
  EXPECT_EQ(d.manoeuvre.kind, ManoeuvreKind::stop);
  EXPECT_EQ(d.why, Why::goal_set);
  EXPECT_EQ(d.danger_count, 0);
  EXPECT_EQ(p.next_drive([](int) { return kOpen; }).mode, Mode::stepping);
}

TEST(Thesis, CancelRestsAtOnce) {
  Puppet p = with_goal(3000, 0);
  p.next_drive([](int) { return kOpen; });
  p.planner().cancel();
  const Decision d = p.planner().step(view_of(p.pose, false, {}));
  EXPECT_EQ(d.manoeuvre.kind, ManoeuvreKind::stop);
  EXPECT_EQ(d.mode, Mode::idle);
  EXPECT_EQ(d.why, Why::cancelled);
  EXPECT_EQ(d.outcome, Outcome::none);
  EXPECT_EQ(p.planner().step(view_of(p.pose, true, kOpen)).manoeuvre.kind, ManoeuvreKind::keep);
}

TEST(State, EveryWordIsNamedOnce) {
  std::vector<std::string> words;
  for (int i = 0; i < kModes; ++i) words.emplace_back(name(static_cast<Mode>(i)));
  for (int i = 0; i < kWhys; ++i) words.emplace_back(name(static_cast<Why>(i)));
  for (const std::string& w : words) EXPECT_NE(w, "?");
  EXPECT_STREQ(name(static_cast<Mode>(kModes)), "?");
  EXPECT_STREQ(name(static_cast<Why>(kWhys)), "?");
}

}  // namespace
}  // namespace whisker::planning
