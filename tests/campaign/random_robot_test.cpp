#include "host/lab/campaign/random_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "firmware/planning/goal_planner.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/lab/campaign/mission.hpp"
#include "host/lab/campaign/worlds.hpp"
#include "tests/effort.hpp"

namespace whisker::campaign {
namespace {

const std::atomic<bool> kNeverStopped{false};

/// Least and greatest value.
class Span {
 public:
  void add(double x) {
    least_ = std::min(least_, x);
    greatest_ = std::max(greatest_, x);
  }
  /// Lies in [low, high], and comes within a tenth of it of each end.
  bool fills(double low, double high) const {
    const double near = (high - low) / 10;
    return least_ >= low - 1e-6 && least_ <= low + near && greatest_ <= high + 1e-6 &&
           greatest_ >= high - near;
  }

 private:
  double least_ = 1e9, greatest_ = -1e9;
};

double degrees(Angle a) { return a.wrapped() * (180.0 / 2147483648.0); }

TEST(RandomRobot, IsAccepted) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const RandomRobot robot = random_robot(seed);
    EXPECT_EQ(check(robot.params), ParamFault::none) << seed;
    EXPECT_EQ(robot.refusals[static_cast<std::size_t>(ParamFault::none)], 0U);
  }
}

TEST(RandomRobot, DependsOnTheSeedAlone) {
  std::vector<std::string> robots;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    robots.push_back(robot_toml(random_robot(seed).params));
    EXPECT_EQ(robots.back(), robot_toml(random_robot(seed).params));
  }
  std::sort(robots.begin(), robots.end());
  EXPECT_EQ(std::adjacent_find(robots.begin(), robots.end()), robots.end()) << "two seeds, one robot";
}

TEST(RandomRobot, SpansTheStatedRanges) {
  Span radius, track, speed, lag, side, offset, rate, latency, cone, period, counts, turn_rate, reach;
  int own = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Params p = random_robot(seed).params;
    const RangefinderParams& r = p.rangefinders;
    const double size_m = p.body.radius.raw() * 1e-6;
    radius.add(sim::natural_log(size_m));
    track.add(p.body.track.raw() * 1e-6 / size_m);
    speed.add(sim::natural_log(p.wheels.max_speed.raw() * 1e-6));
    turn_rate.add(sim::natural_log(p.wheels.max_turn_rate.raw() * 1e-6));
    lag.add(p.wheels.motor_lag.raw());
    counts.add(sim::natural_log(p.wheels.counts_per_metre));
    side.add(degrees(r.side_angle));
    offset.add(r.offset.raw() * 1e-6 / size_m);
    rate.add(r.rate_hz);
    latency.add(r.latency.raw());
    reach.add(r.max_range.raw() * 1e-6 / std::max(1.5, size_m / 0.09));
    period.add(p.safety.period.raw());
    for (int beam = 0; beam < 3; ++beam) cone.add(sim::natural_log(degrees(beam_cone(r, beam))));
    own += r.beams[hal::kFront].cone != Angle{} ? 1 : 0;
  }
  EXPECT_TRUE(radius.fills(sim::natural_log(0.02), 0));
  EXPECT_TRUE(track.fills(0.8, 2));
  EXPECT_TRUE(speed.fills(sim::natural_log(0.02), sim::natural_log(3.2)));
  EXPECT_TRUE(turn_rate.fills(sim::natural_log(0.3), sim::natural_log(20)));
  EXPECT_TRUE(lag.fills(0, 150));
  EXPECT_TRUE(counts.fills(sim::natural_log(100), sim::natural_log(100000)));
  EXPECT_TRUE(side.fills(10, 80));
  EXPECT_TRUE(offset.fills(0, 1.1));
  EXPECT_TRUE(rate.fills(5, 100));
  EXPECT_TRUE(latency.fills(0, 100));
  EXPECT_TRUE(reach.fills(1, 4));
  EXPECT_TRUE(period.fills(5, 20));
  EXPECT_TRUE(cone.fills(sim::natural_log(2), sim::natural_log(60)));
  EXPECT_NEAR(own, 1000, 100);
}

TEST(RandomRobot, GetsAWorldOfItsSizeAndTimeForIt) {
  const Generated reference{worlds::Kind::discs, {}, 1}, random{worlds::Kind::discs, {}, 1, true};
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Mission small = mission(reference, i), m = mission(random, i);
    const Params robot = random_robot(i + 1).params;
    const double size = size_of(robot);
    EXPECT_EQ(m.world, "discs --robots random");
    EXPECT_EQ(robot_toml(m.scenario.robot), robot_toml(robot));
    EXPECT_EQ(m.scenario.goal.tolerance_m, std::max(small.scenario.goal.tolerance_m * size,
                                                    planning::smallest_tolerance(robot).raw() * 1e-6));
    EXPECT_EQ(m.scenario.discs.back().radius, small.scenario.discs.back().radius * size);
    const double driving = size * 300000 / robot.wheels.max_speed.raw();
    const double turning = 3000000.0 / turn_rate(robot).raw();
    EXPECT_NEAR(m.scenario.time_limit_s, 1800 * std::max(driving, turning), 1e-6);
  }
}

TEST(RandomRobot, DrivesTheSameFromItsSavedScenario) {
  for (std::uint64_t i = 0; i < 3; ++i) {
    const Mission m = mission(Generated{worlds::Kind::discs, {}, 1, true}, i);
    const Row row = drive(m.scenario, kDefaultPlanner, kNeverStopped);
    const Scenario saved = parse_scenario(to_toml(m.scenario), "saved");
    EXPECT_EQ(run(saved).hash, row.hash) << m.seed;
  }
}

// Each of these robots has stopped with a fault, because of: turns by less than a count, an echo at a maximum
// range of no whole millimetres, looks by turns on coarse encoders that make other ground unclear, a look
// that waits for longer than the supervisor.
TEST(RandomRobot, ReachesItsGoalIfItIsOneOfTheHardOnes) {
  struct Hard {
    worlds::Kind kind;
    std::uint64_t seed;
  };
  for (const Hard& hard : {Hard{worlds::Kind::maze, 402695}, Hard{worlds::Kind::discs, 401847},
                           Hard{worlds::Kind::maze, 400669}, Hard{worlds::Kind::maze, 403013},
                           Hard{worlds::Kind::u_trap, 400170}, Hard{worlds::Kind::discs, 411654}}) {
    const Mission m = mission(Generated{hard.kind, {}, hard.seed, true}, 0);
    const Row row = drive(m.scenario, kDefaultPlanner, kNeverStopped);
    EXPECT_EQ(row.verdict, Verdict::reached) << m.world << " seed " << m.seed << ": " << row.detail;
  }
}

class AnyRobot : public testing::TestWithParam<worlds::Kind> {};

TEST_P(AnyRobot, ReachesItsGoalWithoutContactAndFault) {
  constexpr std::uint64_t kFirstSeed = 1;
  const std::uint64_t count = test::effort(2, 1000);
  const Generated generated{GetParam(), {}, kFirstSeed, true};
  std::uint64_t reached = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Mission m = mission(generated, i);
    const Row row = drive(m.scenario, kDefaultPlanner, kNeverStopped);
    EXPECT_NE(row.verdict, Verdict::contact) << m.world << " seed " << m.seed;
    EXPECT_NE(row.verdict, Verdict::fault) << m.world << " seed " << m.seed << ": " << row.detail;
    if (row.verdict == Verdict::reached) {
      ++reached;
    } else {
      std::printf("seed %llu: %s\n", static_cast<unsigned long long>(m.seed), row.detail.c_str());
    }
  }
  std::printf("%llu of %llu robots from seed %llu reached their goals\n",
              static_cast<unsigned long long>(reached), static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(kFirstSeed));
  EXPECT_GE(reached, count - (count + 99) / 100);
}

INSTANTIATE_TEST_SUITE_P(Kind, AnyRobot,
                         testing::Values(worlds::Kind::discs, worlds::Kind::maze, worlds::Kind::u_trap));

TEST(AnyWorld, HasRandomRobotsIfItsNameSaysSo) {
  EXPECT_TRUE(has_random_robots("discs --noise --robots random"));
  EXPECT_FALSE(has_random_robots("discs --noise"));
  EXPECT_FALSE(has_random_robots("a --robots random/b.toml"));
}

}  // namespace
}  // namespace whisker::campaign
