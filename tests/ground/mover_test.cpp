#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "host/sim/cone.hpp"
#include "host/sim/spec.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/ground/rig.hpp"

namespace whisker::test {
namespace {

constexpr double kMoving = 0.02;  // m/s
constexpr double kTimeLimit = 120;
constexpr double kInTime = 0.6;  // s: three readings, latency, and the way to rest

struct Tally {
  int missions = 0;
  int reached = 0;
  int hit_moving = 0;    // contacts while the body moved
  int seen = 0;          // of these, with something that it could have seen in time
  int hit_standing = 0;  // something ran into the standing body
  double worst = 0;      // m/s, of the body at a contact
};

enum class Course { oncoming, crossing, overtaking };

const char* name(Course course) {
  return course == Course::oncoming ? "oncoming" : course == Course::crossing ? "crossing" : "overtaking";
}

/// An open world of 4 m, one disc that moves, timed so that it comes near the robot's straight way.
Scenario draw(Course course, double speed, worlds::Random& random) {
  Scenario s;
  s.name = "mover";
  s.time_limit_s = kTimeLimit;
  const double turn = random.uniform(-3.14159, 3.14159);
  const auto place = [&](double along, double aside) {
    return sim::Vec2{along * std::cos(turn) - aside * std::sin(turn),
                     along * std::sin(turn) + aside * std::cos(turn)};
  };
  s.start = {{0, 0}, turn};
  s.goal.at = place(4, 0);
  Mover m;
  m.radius_m = random.uniform(0.03, 0.3);
  m.speed_mps = speed;
  const double aside = random.uniform(-0.3, 0.3);
  switch (course) {
    case Course::oncoming: m.path = {place(random.uniform(2, 3.5), aside), place(-30, aside)}; break;
    case Course::crossing: {
      const double at = random.uniform(0.8, 3);
      // The robot drives 0.3 m/s after a survey of about 2.5 s.
      const double far = (at / 0.3 + 2.5 + random.uniform(-1.5, 1.5)) * speed;
      const double side = random.chance(0.5) ? 1 : -1;
      m.path = {place(at, side * (far + m.radius_m)), place(at + random.uniform(-3, 3), -30 * side)};
      break;
    }
    case Course::overtaking: m.path = {place(-random.uniform(0.5, 1), aside), place(30, aside)}; break;
  }
  m.center = m.path[0];
  s.movers = {m};
  return s;
}

/// For how long some beam has shown the one mover at the distance that it has, near enough to be judged: of
/// what passes by, a cone may see no more than the far end.
class Sighting {
 public:
  void look(const Rig& rig, const Scenario& scenario) {
    const sim::RobotSpec spec = sim::robot_spec(scenario.robot);
    const sim::Pose& pose = rig.plant().pose();
    const sim::WorldView& world = rig.world();
    const double near = sim::clearance(world, pose.at, rig.plant().time(), 0) + kOff;
    bool seen = false;
    for (int beam = -1; beam <= 1; ++beam) {
      const double axis = pose.heading + beam * spec.side_angle;
      const sim::Cone cone{pose.at,
                           {std::cos(axis), std::sin(axis)},
                           std::cos(spec.cone_half_width),
                           std::sin(spec.cone_half_width)};
      seen = seen || sim::range(cone, world, rig.plant().time(), kReach) < std::fmin(kReach, near);
    }
    since_ = seen ? since_ : rig.plant().time();
  }
  double lasting(const Rig& rig) const { return rig.plant().time() - since_; }

 private:
  static constexpr double kReach = 0.7;  // m
  static constexpr double kOff = 0.03;
  double since_ = 0;
};

Tally drive(Course course, double speed, int missions) {
  Tally tally;
  for (int i = 0; i < missions; ++i) {
    worlds::Random random(static_cast<std::uint64_t>(i) * 1000 + static_cast<std::uint64_t>(speed * 100));
    const Scenario scenario = draw(course, speed, random);
    Rig rig(scenario);
    Sighting sighting;
    while (rig.plant().time() < kTimeLimit && rig.step()) sighting.look(rig, scenario);
    ++tally.missions;
    if (rig.status().decision.outcome == nav::Outcome::reached) ++tally.reached;
    if (!rig.plant().in_contact()) continue;
    const bool moving = rig.speed() > kMoving;
    ++(moving ? tally.hit_moving : tally.hit_standing);
    if (moving && sighting.lasting(rig) > kInTime) ++tally.seen;
    tally.worst = std::fmax(tally.worst, rig.speed());
  }
  std::printf(
      "%-10s %.2f m/s: %3d missions, %3d reached, contacts %2d moving (%d seen; worst %.3f m/s), %2d "
      "standing\n",
      name(course), speed, tally.missions, tally.reached, tally.hit_moving, tally.seen, tally.worst,
      tally.hit_standing);
  return tally;
}

class Movers : public testing::TestWithParam<double> {};

TEST_P(Movers, ComeTowardsTheRobot) {
  const Tally t = drive(Course::oncoming, GetParam(), static_cast<int>(test::effort(200)));
  if (GetParam() <= 0.3) {
    EXPECT_EQ(t.seen, 0);
  }
}

TEST_P(Movers, CrossItsWay) {
  const Tally t = drive(Course::crossing, GetParam(), static_cast<int>(test::effort(200)));
  if (GetParam() <= 0.3) {
    EXPECT_EQ(t.seen, 0);
  }
}

TEST_P(Movers, OvertakeIt) { drive(Course::overtaking, GetParam(), 100); }

INSTANTIATE_TEST_SUITE_P(At, Movers, testing::Values(0.1, 0.2, 0.3, 0.5));

// What stands still never looks as if it moved.
TEST(Witness, IsNeverContradictedByAWorldAtRest) {
  int ticks = 0;
  for (const worlds::Kind kind : worlds::kKinds) {
    for (std::uint64_t seed = 1; seed <= test::effort(8); ++seed) {
      worlds::Options options;
      options.seed = 40 + seed;
      Rig rig(worlds::generate(kind, options));
      while (rig.plant().time() < 60 && rig.step()) {
        ++ticks;
        ASSERT_FALSE(rig.patch()->doubting())
            << worlds::name(kind) << " seed " << options.seed << " at " << rig.plant().time() << " s";
      }
    }
  }
  EXPECT_GT(ticks, static_cast<int>(test::effort(40000)));
}

/// Ticks, and those with doubt, in noisy worlds at rest.
struct Doubts {
  int ticks = 0;
  int doubting = 0;
  int begun = 0;
};

Doubts drive_noisy(worlds::Kind kind, bool odometry) {
  Doubts d;
  for (std::uint64_t seed = 1; seed <= test::effort(8); ++seed) {
    worlds::Options options;
    options.seed = 60 + seed;
    options.noise = true;
    Scenario scenario = worlds::generate(kind, options);
    if (!odometry) scenario.noise.wheel_scale_sigma = scenario.noise.heading_drift_deg_per_sqrt_m = 0;
    Rig rig(scenario);
    bool before = false;
    while (rig.plant().time() < 60 && rig.step()) {
      const bool now = rig.patch()->doubting();
      ++d.ticks;
      d.doubting += now ? 1 : 0;
      d.begun += now && !before ? 1 : 0;
      before = now;
    }
  }
  std::printf("%s%s: %.0f s, doubted %d times, %.2f %% of the time\n", worlds::name(kind),
              odometry ? "" : ", odometry without error", d.ticks * 0.01, d.begun,
              100.0 * d.doubting / d.ticks);
  return d;
}

// Neither do outliers: 1 % of the readings miss what is there, 2 % are lost, and all are off by 1 cm.
TEST(Witness, IsRarelyContradictedByNoise) {
  for (const worlds::Kind kind : {worlds::Kind::discs, worlds::Kind::rooms}) {
    const Doubts ranges = drive_noisy(kind, false);
    EXPECT_LT(ranges.doubting, ranges.ticks / 100);
    const Doubts all = drive_noisy(kind, true);
    EXPECT_LT(all.doubting, all.ticks / 20);
  }
}

}  // namespace
}  // namespace whisker::test
