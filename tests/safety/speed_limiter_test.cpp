// For any commands of a planner, the speed limiter prevents contact with static obstacles, and in open ground
// it does not interfere.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdio>
#include <tuple>

#include "host/harness/scenario/contact.hpp"
#include "host/harness/worlds/beside.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/perception/rig.hpp"
#include "tests/safety/adversary.hpp"

namespace whisker::test {
namespace {

using worlds::Random;

constexpr double kMission_s = 20;

struct Torment {
  double gap = 1;     // m, starting with room
  double beside = 1;  // m, starting beside an obstacle
  double path = 0;
  int worlds = 0;
};

Torment torment(std::uint64_t seed, int count, bool noise, Length margin = Params{}.boundary.guard_margin) {
  Torment nearest;
  for (int i = 0; i < count; ++i) {
    Random random(seed + static_cast<std::uint64_t>(i));
    Scenario scenario = worlds::beside_obstacle(random, worlds::kAllClasses, noise, {});
    scenario.robot.boundary.guard_margin = margin;
    Adversary adversary(random.bits());
    Rig rig(scenario, &adversary);
    while (rig.plant().time() < kMission_s && rig.step()) {
    }
    EXPECT_FALSE(rig.plant().in_contact()) << "seed " << seed + static_cast<std::uint64_t>(i)
                                           << ": contact at " << rig.plant().contact_time() << " s";
    // The adversary waits and drives at walls for longer than a planner may.
    const Fault fault = rig.status().health.fault;
    EXPECT_TRUE(fault == Fault::none || fault == Fault::range_unsteady || fault == Fault::no_progress)
        << name(fault) << " seed " << seed + static_cast<std::uint64_t>(i);
    const bool room = nearest_obstacle(scenario, scenario.start.at).distance_m > 0.09 + 0.02;
    double& gap = room ? nearest.gap : nearest.beside;
    gap = std::fmin(gap, rig.plant().min_clearance());
    nearest.path += rig.plant().path_length();
    ++nearest.worlds;
  }
  return nearest;
}

/// Share of the missions, and whether with the reference noise.
class GuardAgainst : public testing::TestWithParam<std::tuple<int, bool>> {};

constexpr int kParts = 4;

TEST_P(GuardAgainst, AnAdversaryThatAsksForEveryManoeuvre) {
  const auto [part, noise] = GetParam();
  const auto count = static_cast<int>(test::effort(150, 5000 / kParts));
  const std::uint64_t seed = 1 + static_cast<std::uint64_t>(part) * 5000 + (noise ? 1000000 : 0);
  const Torment n = torment(seed, count, noise);
  std::printf(
      "%d missions%s from seed %llu, %.0f m: the smallest gap is %.4f m, begun beside something %.4f m\n",
      n.worlds, noise ? " with noise" : "", static_cast<unsigned long long>(seed), n.path, n.gap, n.beside);
  EXPECT_GT(n.path, n.worlds * 0.25);
}

INSTANTIATE_TEST_SUITE_P(Part, GuardAgainst, testing::Combine(testing::Range(0, kParts), testing::Bool()));

TEST(SpeedLimiter, TouchesNothingWithoutAMarginEither) {
  const auto count = static_cast<int>(test::effort(25, 1250));
  const Torment n = torment(1, count, false, Length{});
  std::printf("%d missions without a margin from seed 1: the smallest gap is %.4f m\n", n.worlds, n.gap);
}

RC_GTEST_PROP(SpeedLimiter, NeverTouchesFromAnySeed, (std::uint64_t seed, bool noise)) {
  const auto margin = micrometres(*rc::gen::inRange(0, 6001));
  const Torment n = torment(seed, 1, noise, margin);
  RC_ASSERT(n.gap > 0);
  RC_ASSERT(n.beside > 0);
}

// In open ground the speed limiter does not interfere.
TEST(SpeedLimiter, GrantsAStraightRequestInOpenGroundInFull) {
  class Straight final : public planning::Planner {
    void set_goal(const planning::Goal&) noexcept override {}
    void move_goal(Vec) noexcept override {}
    void cancel() noexcept override {}
    planning::Decision step(const planning::View& view) noexcept override {
      planning::Decision d;
      d.outcome = planning::Outcome::running;
      d.manoeuvre.kind = planning::ManoeuvreKind::cruise;
      // The beams do not cover the flanks: first a turn to both sides.
      const int32_t part = ++ticks_ / 120;
      const bool drives = part >= 4;
      d.manoeuvre.forward = drives ? 300_mm_per_s : Speed{};
      d.manoeuvre.turning = drives ? Speed{} : part == 0 || part == 3 ? 65_mm_per_s : -65_mm_per_s;
      if (ticks_ > 4 * 120 + 1) all_ = all_ && view.granted == Q14::ratio(1, 1);
      return d;
    }
    int32_t ticks_ = 0;

   public:
    bool all_ = true;
  } straight;
  Scenario s;
  s.goal.at = {100, 0};
  Rig rig(s, &straight);
  while (rig.plant().time() < 12 && rig.step()) {
  }
  EXPECT_TRUE(straight.all_);
  EXPECT_GT(rig.plant().path_length(), 0.29 * (12 - 5.2));
}

// Straight on from the start, where no beam has seen the flanks.
TEST(SpeedLimiter, CreepsOverUnseenGroundIfItMayAndStopsBeforeAnEcho) {
  class Ahead final : public planning::Planner {
    void set_goal(const planning::Goal&) noexcept override {}
    void move_goal(Vec) noexcept override {}
    void cancel() noexcept override {}
    planning::Decision step(const planning::View&) noexcept override {
      planning::Decision d;
      d.outcome = planning::Outcome::running;
      d.manoeuvre.kind = planning::ManoeuvreKind::cruise;
      d.manoeuvre.forward = 300_mm_per_s;
      return d;
    }
  };
  const auto path = [](Speed creep) {
    Scenario s;
    s.goal.at = {100, 0};
    s.walls.push_back({{0.5, -2}, {0.5, 2}});
    s.robot.bumper = {Fitted::yes, creep};
    Ahead ahead;
    Rig rig(s, &ahead);
    while (rig.plant().time() < 20 && rig.step()) {
    }
    EXPECT_EQ(rig.plant().bumps(), 0U);
    EXPECT_FALSE(rig.plant().in_contact());
    return rig.plant().path_length();
  };
  const double strict = path({}), creeping = path(50_mm_per_s);
  std::printf("%.3f m strict, %.3f m creeping\n", strict, creeping);
  EXPECT_LT(strict, 0.1);
  EXPECT_GT(creeping, 0.3);
  EXPECT_LT(creeping, 0.41);
}

// The body would pass 0.2 mm into a cell beside the middle of its way, which the disc at the end of the way,
// 19 mm ahead, does not touch.
TEST(SpeedLimiter, ChecksTheWholeWayOfTheSmallestBody) {
  Params p;
  p.body.radius = 20_mm;
  p.body.track = 30_mm;
  p.boundary.guard_margin = micrometres(900);
  p.wheels.max_speed = 115_mm_per_s;
  const auto granted = [&](Length beside) {
    const Pose pose{{micrometres(1350), micrometres(17778) - beside}, {}};
    perception::LocalGrid grid;
    grid.configure(p);
    grid.reset(pose);
    for (int i = 0; i < 24; ++i) {
      perception::ConeObservation around;
      around.beam = {pose.at, 15_deg * i, 40_deg};
      around.free = 200_mm;
      grid.mark(around);
    }
    grid.block({10_mm, 20_mm}, micrometres(100));
    safety::SpeedLimiter limiter;
    const WheelPair full{p.wheels.max_speed, p.wheels.max_speed};
    static_cast<void>(
        limiter.step({p.wheels.max_speed, {}, true}, pose, {full, full, full}, grid, p.safety.period, p));
    return limiter.granted();
  };
  EXPECT_EQ(granted(micrometres(19800)), Q14{});
  EXPECT_EQ(granted(micrometres(21500)), Q14::ratio(1, 1));
}

// Around it, nothing has been seen. Rounding shortens the way of a small speed below the shortest one that
// the grid looks at, but many of them add up.
TEST(SpeedLimiter, NoSpeedIsTooSmallToBeChecked) {
  const Params p;
  int granted = 0, commands = 0;
  for (int deg = 0; deg < 360; deg += 5) {
    const Pose pose{{}, 1_deg * deg};
    perception::LocalGrid grid;
    grid.configure(p);
    grid.reset(pose);
    for (const Speed turning : {Speed{}, 5_mm_per_s, 50_mm_per_s, -100_mm_per_s}) {
      for (int32_t um_per_s = 1; um_per_s <= 2000; um_per_s += 2) {
        safety::SpeedLimiter limiter;
        const Speed forward = Speed::from_raw(um_per_s);
        const WheelPair rolls = inverse_kinematics(forward, turning, p.wheels.max_speed);
        const WheelPair command =
            limiter.step({forward, turning, true}, pose, {rolls, rolls, rolls}, grid, p.safety.period, p);
        granted += limiter.granted() > Q14{} && command.left + command.right != Speed{};
        ++commands;
      }
    }
  }
  EXPECT_EQ(granted, 0) << "of " << commands;
}

}  // namespace
}  // namespace whisker::test
