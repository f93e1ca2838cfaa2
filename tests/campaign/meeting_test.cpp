#include "host/lab/campaign/meeting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/harness/worlds/meeting.hpp"
#include "host/lab/campaign/comparison.hpp"
#include "tests/effort.hpp"

namespace whisker::campaign {
namespace {

using worlds::Course;

Scenario scene(const std::string& mover) {
  return parse_scenario(R"(
    time_limit_s = 60.0
    [start]
    x_m = 0.0
    y_m = 0.0
    heading_deg = 0.0
    [goal]
    x_m = 4.0
    y_m = 0.0
    [[mover]]
)" + mover,
                        "scene.toml");
}

double after_10_s(const Scenario&, double) { return 10; }

Scenario meeting(Course course, double speed_mps, std::uint64_t seed, PlannerKind planner,
                 const Scenario& own = {}) {
  return timed_meeting(course, speed_mps, seed, own, planner);
}

TEST(WorldsMeeting, IsTheSameForTheSameSeedAndLoadsAgain) {
  for (const Course course : worlds::kCourses) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const auto text_of = [course](std::uint64_t s) {
        return to_toml(worlds::meeting(course, 0.2, s, after_10_s));
      };
      const std::string text = text_of(seed);
      EXPECT_EQ(text, text_of(seed));
      EXPECT_NE(text, text_of(seed + 1));
      EXPECT_EQ(to_toml(parse_scenario(text, "meeting.toml")), text);
    }
  }
}

// The disc's edge reaches the robot's line when a robot that drives alone is there, to 1.5 s.
TEST(WorldsMeeting, IsTimedToTheRobotsOwnPace) {
  Scenario slow;
  slow.robot.wheels.max_speed = 120_mm_per_s;
  double latest_s = 0;
  for (const Scenario& own : {Scenario{}, slow}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Scenario crossed = meeting(Course::crossing, 0.2, seed, kDefaultPlanner, own);
      const Mover& m = crossed.movers[0];
      const sim::Vec2 ahead{std::cos(crossed.start.heading), std::sin(crossed.start.heading)};
      const double at = m.center.x * ahead.x + m.center.y * ahead.y;
      const double aside = std::fabs(m.center.y * ahead.x - m.center.x * ahead.y);
      const double crosses_s = (aside - m.radius_m) / m.speed_mps;
      double off_s = INFINITY;
      Scenario alone = crossed;
      alone.movers.clear();
      RunOptions options;
      options.watch = [&](const Moment& moment) {
        const TickRecord& r = moment.record;
        if (r.x_m * ahead.x + r.y_m * ahead.y < at) off_s = std::fabs(r.t_s - crosses_s);
      };
      run(alone, options);
      EXPECT_LE(off_s, 1.5) << "seed " << seed;
      latest_s = std::fmax(latest_s, crosses_s);
    }
  }
  EXPECT_GT(latest_s, 20);  // the slow robot's
}

// Most of these runs would end in a contact if the robot did not give way.
TEST(WorldsMeeting, BringsTheTwoTogether) {
  int near = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const RunResult r = run(meeting(Course::crossing, 0.2, seed, kDefaultPlanner));
    near += r.min_clearance_m < 0.4 ? 1 : 0;
  }
  EXPECT_GT(near, 50);
}

TEST(Meet, ARobotThatIsCrossedWaitsOrGoesAroundAndSaysSo) {
  // The mover crosses when the robot arrives: 0.3 m/s after a survey of 2.5 s.
  for (const char* y : {"1.1", "1.2", "1.3"}) {
    const Scenario s = scene("center = [1.5, " + std::string(y) + "]\nradius_m = 0.15\npath = [[1.5, " + y +
                             "], [1.5, -20.0]]\nspeed_mps = 0.2\n");
    const Meeting m = meet(s, PlannerKind::boundary);
    EXPECT_EQ(m.verdict, Verdict::reached) << y;
    EXPECT_TRUE(m.said) << y;
  }
}

// It would run into a robot that only stops before it.
TEST(Meet, ARobotInThePathOfSomethingSlowLeavesIt) {
  for (const PlannerKind planner : {PlannerKind::boundary, kDefaultPlanner}) {
    for (const Course course : {Course::oncoming, Course::crossing}) {
      MeetingCount count;
      for (std::uint64_t seed = 1; seed <= test::effort(60); ++seed) {
        count.add(meet(meeting(course, 0.1, seed, planner), planner));
      }
      // docs/perception.md: 3 to 7 % and 20 to 30 %.
      EXPECT_LE(count.contacts, count.missions * (course == Course::oncoming ? 12 : 36) / 100)
          << name(course);
    }
  }
}

// What moves is not smaller because the body is.
TEST(Meet, ASmallRobotLeavesAsFar) {
  Scenario small;
  small.robot.body.radius = 40_mm;
  small.robot.body.track = 60_mm;
  MeetingCount count;
  for (std::uint64_t seed = 1; seed <= test::effort(60); ++seed) {
    count.add(meet(meeting(Course::oncoming, 0.1, seed, kDefaultPlanner, small), kDefaultPlanner));
  }
  EXPECT_LE(count.contacts, count.missions * 12 / 100);
}

TEST(Meet, NothingIsSaidOfWhatStands) {
  const Meeting m = meet(scene("center = [2.0, 0.05]\nradius_m = 0.2\npath = [[2.0, 0.05], [2.0, 9.0]]\n"
                               "speed_mps = 0.0\n"),
                         PlannerKind::boundary);
  EXPECT_EQ(m.verdict, Verdict::reached);
  EXPECT_FALSE(m.said);
}

// By a planner that does not leave the path of the object.
TEST(Meet, KnowsWhatTheBeamsShowed) {
  const Meeting ahead = meet(scene("center = [1.5, 0.0]\nradius_m = 0.3\npath = [[1.5, 0.0], [-30.0, 0.0]]\n"
                                   "speed_mps = 0.3\n"),
                             PlannerKind::thesis);
  ASSERT_EQ(ahead.verdict, Verdict::contact);
  EXPECT_GT(ahead.near_s, 0.5);
  EXPECT_GE(ahead.shown_s, ahead.near_s);

  const Meeting behind =
      meet(scene("center = [-1.0, 0.0]\nradius_m = 0.3\npath = [[-1.0, 0.0], [30.0, 0.0]]\n"
                 "speed_mps = 0.6\n"),
           PlannerKind::thesis);
  ASSERT_EQ(behind.verdict, Verdict::contact);
  EXPECT_EQ(behind.shown_s, 0);
  EXPECT_EQ(behind.near_s, 0);
}

TEST(MeetingCount, CountsEachContactOnce) {
  const auto contact = [](double speed_mps, double shown_s, double near_s) {
    Meeting m;
    m.verdict = Verdict::contact;
    m.speed_mps = speed_mps;
    m.shown_s = shown_s;
    m.near_s = near_s;
    return m;
  };
  MeetingCount count;
  count.add(contact(0.01, 9, 9));
  count.add(contact(0.03, 0.5, 0.5));
  count.add(contact(0.03, 0.7, 0.5));
  count.add(contact(0.3, 0.7, 0.7));
  Meeting reached;
  reached.verdict = Verdict::reached;
  reached.said = true;
  reached.shown_s = reached.near_s = 9;
  count.add(reached);
  EXPECT_EQ(count.missions, 5U);
  EXPECT_EQ(count.reached, 1U);
  EXPECT_EQ(count.said, 1U);
  EXPECT_EQ(count.contacts, 4U);
  EXPECT_EQ(count.moving, 3U);
  EXPECT_EQ(count.shown, 2U);
  EXPECT_EQ(count.seen, 1U);
}

class MeetAt : public testing::TestWithParam<double> {};

// The robot hardly ever drives into a mover that it could detect in time.
TEST_P(MeetAt, NothingThatWasSeenIsTouchedByAMovingRobot) {
  for (const Course course : {Course::oncoming, Course::crossing}) {
    MeetingCount count;
    for (std::uint64_t seed = 1; seed <= test::effort(200); ++seed) {
      count.add(meet(meeting(course, GetParam(), seed, PlannerKind::boundary), PlannerKind::boundary));
    }
    // docs/perception.md: the rate is one in some thousands.
    EXPECT_LE(count.seen, 1U) << name(course);
    EXPECT_GT(count.said, count.missions / 4) << name(course);
  }
}

INSTANTIATE_TEST_SUITE_P(Speed, MeetAt, testing::Values(0.05, 0.1, 0.2, 0.3));

Row reached(double time_s, double path_m, std::uint64_t stops = 0, double clearance_m = 0.05) {
  Row row;
  row.verdict = Verdict::reached;
  row.time_s = time_s;
  row.path_m = path_m;
  row.stops = stops;
  row.min_clearance_m = clearance_m;
  row.shortest_m = 4.0;
  return row;
}

Row ended(Verdict verdict) {
  Row row;
  row.verdict = verdict;
  row.shortest_m = 4.0;
  return row;
}

TEST(Comparison, RatiosAreGeometricMeansOfPairs) {
  const Comparison c = compare({{reached(10, 4), reached(20, 4)}, {reached(20, 4), reached(10, 4)}});
  EXPECT_DOUBLE_EQ(c.time->value, 1.0);
  EXPECT_LT(*c.time->low, 1.0);
  EXPECT_GT(*c.time->high, 1.0);
  EXPECT_DOUBLE_EQ(*c.time->low * *c.time->high, 1.0);
  EXPECT_DOUBLE_EQ(c.path->value, 1.0);
}

TEST(Comparison, EqualPairsLeaveNoDoubt) {
  const Comparison c = compare({{reached(10, 5), reached(5, 5)}, {reached(8, 4), reached(4, 4)}});
  EXPECT_DOUBLE_EQ(c.time->value, 0.5);
  EXPECT_DOUBLE_EQ(*c.time->low, 0.5);
  EXPECT_DOUBLE_EQ(*c.time->high, 0.5);
}

TEST(Comparison, OnlyWorldsThatBothReachAreTimed) {
  const Comparison c = compare({{reached(10, 4), reached(11, 4)},
                                {reached(10, 4), ended(Verdict::contact)},
                                {ended(Verdict::gave_up), reached(99, 4)},
                                {ended(Verdict::contact), ended(Verdict::contact)}});
  EXPECT_EQ(c.worlds, 4u);
  EXPECT_EQ(c.both, 1u);
  EXPECT_EQ(c.only_a, 1u);
  EXPECT_EQ(c.only_b, 1u);
  EXPECT_EQ(c.contacts_a, 1u);
  EXPECT_EQ(c.contacts_b, 2u);
  EXPECT_DOUBLE_EQ(c.success_a.value, 0.5);
  EXPECT_DOUBLE_EQ(c.time->value, 1.1);
  EXPECT_FALSE(c.time->low);
}

TEST(Comparison, NothingToTimeIsNoFigure) {
  const Comparison c = compare({{ended(Verdict::fault), reached(3, 3)}});
  EXPECT_FALSE(c.time || c.path || c.jerk || c.stops || c.flips || c.clearance);
}

TEST(Comparison, DifferencesCountPerMetreOfTheShortestPath) {
  const Comparison c = compare({{reached(10, 4, 2, 0.05), reached(10, 4, 6, 0.02)}});
  EXPECT_DOUBLE_EQ(c.stops->value, 1.0);
  EXPECT_DOUBLE_EQ(c.clearance->value, -0.03);
}

TEST(JerkMeter, OfASineIsItsAmplitudeOverRootTwo) {
  JerkMeter meter;
  const double w = 2.0, amplitude = 0.1;  // v = A sin(w t): jerk = -A w^2 sin(w t)
  for (int i = 0; i <= 31416; ++i) meter.add(i * 1e-3, amplitude * std::sin(w * i * 1e-3));
  EXPECT_NEAR(meter.rms(), amplitude * w * w / std::sqrt(2.0), 1e-4);
}

TEST(JerkMeter, SteadyAccelerationHasNone) {
  JerkMeter meter;
  EXPECT_EQ(meter.rms(), 0);
  for (int i = 0; i < 100; ++i) meter.add(i * 0.5, i * 0.25);
  EXPECT_NEAR(meter.rms(), 0, 1e-12);
}

}  // namespace
}  // namespace whisker::campaign
