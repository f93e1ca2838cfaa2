// What the keys of [sensor] make of the simulated robot.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "hal/types.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/sensor_models.hpp"
#include "host/harness/scenario/world.hpp"

namespace whisker {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
const double kInfinity = __builtin_huge_val();

sim::RobotSpec spec(const Sensor& sensor, Length believed = 2_m) {
  Scenario s;
  s.sensor = sensor;
  s.robot.rangefinders.max_range = believed;
  return robot_spec(s);
}
Sensor model(const char* name) {
  Sensor s;
  apply(*find_sensor_model(name), s);
  return s;
}
/// The range up to which this model gives an echo, m.
double reach(const char* name, double reflectance, double ambient_klux) {
  Sensor s = model(name);
  s.reflectance = reflectance;
  s.ambient_klux = ambient_klux;
  return *s.max_range_m * echo_share(s);
}

TEST(SensorSpec, IsTheCoresRobotByDefault) {
  const sim::RobotSpec core = sim::robot_spec(Params{}), ours = spec({});
  EXPECT_EQ(ours.beams[hal::kFront].max_range, core.beams[hal::kFront].max_range);
  EXPECT_EQ(ours.beams[hal::kFront].min_range, core.beams[hal::kFront].min_range);
  EXPECT_EQ(ours.beams[hal::kFront].cone_half_width, core.beams[hal::kFront].cone_half_width);
  EXPECT_EQ(ours.echo_range, kInfinity);
  EXPECT_EQ(ours.corner_scatter, core.corner_scatter);
  EXPECT_EQ(ours.range_sigma, 0);
  EXPECT_EQ(ours.range_sigma_share, 0);
  EXPECT_EQ(ours.cover_glass, 0);
  EXPECT_GE(ours.cone_far_half_width, ours.beams[hal::kFront].cone_half_width) << "no taper";
}

TEST(SensorSpec, TakesTheShorterOfTheTwoRanges) {
  EXPECT_EQ(spec(model("gp2y0a21")).beams[hal::kFront].max_range, 0.8);
  const sim::RobotSpec far = spec(model("hc-sr04"));
  EXPECT_EQ(far.beams[hal::kFront].max_range, 2);
  EXPECT_EQ(far.taper_range, 4) << "the cone has its far width at the sensor's own range";
  EXPECT_NEAR(far.beams[hal::kFront].cone_half_width, 20 * kDegree, 1e-15);
  EXPECT_NEAR(far.cone_far_half_width, 7.5 * kDegree, 1e-15);
  EXPECT_EQ(spec(model("hc-sr04"), 6_m).beams[hal::kFront].max_range, 4);
  EXPECT_EQ(spec(model("tfmini")).beams[hal::kFront].min_range, 0.3);
}

TEST(SensorSpec, ShowsWhatIsBeyondTheBelievedRangeIfTheDriverDoes) {
  Sensor far = model("hc-sr04");
  far.far_is = Far::distance;
  EXPECT_EQ(spec(far).beams[hal::kFront].max_range, 4);
  EXPECT_EQ(spec(far, 6_m).beams[hal::kFront].max_range, 4);
}

TEST(SensorSpec, LightActsOnTheRangeOfTheSensorItself) {
  Sensor s = model("tfmini");
  s.reflectance = 0.225;
  EXPECT_DOUBLE_EQ(spec(s).echo_range, 6);
  EXPECT_EQ(spec(s).beams[hal::kFront].max_range, 2);
  Sensor own;
  own.reflectance = 0.25;
  EXPECT_DOUBLE_EQ(spec(own).echo_range, 1);
  own.reflectance = 0;
  EXPECT_EQ(spec(own).echo_range, 0);
}

// The law of light against the data sheets.
TEST(EchoShare, FollowsTheDataSheets) {
  EXPECT_DOUBLE_EQ(reach("vl53l0x", 0.88, 0), 2.0);
  EXPECT_DOUBLE_EQ(reach("vl53l0x", 1, 0), 2.0);
  EXPECT_NEAR(reach("vl53l0x", 0.17, 0), 0.8, 0.1);
  EXPECT_NEAR(reach("vl53l0x", 0.88, 5), 0.8, 0.01);
  EXPECT_NEAR(reach("vl53l0x", 0.17, 5), 0.5, 0.16);
  EXPECT_NEAR(reach("vl53l1x", 0.17, 0), 1.7, 0.13);
  EXPECT_NEAR(reach("vl53l1x", 0.88, 100), 0.73, 0.01);
  EXPECT_NEAR(reach("tfmini", 0.9, 70), 7, 0.05);
  EXPECT_NEAR(reach("tfmini", 0.1, 0), 5, 1.01);
}

TEST(EchoShare, IsOneWhereLightDoesNotMatter) {
  EXPECT_EQ(reach("hc-sr04", 0.01, 100), 4);
  EXPECT_EQ(reach("gp2y0a21", 0.1, 100), 0.8);
}

constexpr int kCount = 10000;

Scenario discs(double soft, std::uint64_t seed) {
  Scenario s;
  s.seed = seed;
  s.sensor.soft = soft;
  s.discs.assign(kCount, {{5, 5}, 0.1});
  return s;
}
int count(const World& world) { return std::accumulate(world.soft.begin(), world.soft.end(), 0); }

TEST(SoftObstacles, AreTheStatedShare) {
  for (const double share : {0.1, 0.5, 0.9}) {
    const World world = make_world(discs(share, 4711));
    ASSERT_EQ(world.soft.size(), std::size_t{kCount});
    EXPECT_NEAR(count(world), share * kCount, 4 * std::sqrt(share * (1 - share) * kCount)) << "seed 4711";
  }
  EXPECT_TRUE(make_world(discs(0, 1)).soft.empty());
  EXPECT_EQ(count(make_world(discs(1, 1))), kCount);
}

TEST(SoftObstacles, DependOnTheSeedAndAreTheSameEachTime) {
  EXPECT_EQ(make_world(discs(0.5, 7)).soft, make_world(discs(0.5, 7)).soft);
  EXPECT_NE(make_world(discs(0.5, 7)).soft, make_world(discs(0.5, 8)).soft);
}

TEST(SoftObstacles, AreSoftAsAWhole) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Scenario s;
    s.seed = seed;
    s.sensor.soft = 0.5;
    s.polygons = {{{1, 1}, {2, 1}, {1, 2}}, {{3, 3}, {4, 3}, {4, 4}, {3, 4}}};
    s.walls = {{{5, 5}, {6, 5}, {7, 6}}};
    s.bounds = Bounds{{-9, -9}, {9, 9}};
    const World world = make_world(s);
    ASSERT_EQ(world.soft.size(), world.segments.size());
    constexpr std::size_t kFrom[] = {0, 3, 7, 9, 13};
    for (int k = 0; k < 4; ++k) {
      for (std::size_t i = kFrom[k]; i < kFrom[k + 1]; ++i) {
        ASSERT_EQ(world.soft.at(i), world.soft.at(kFrom[k])) << seed;
      }
    }
  }
}

TEST(SoftObstacles, OfOneKindDoNotChangeThoseOfAnother) {
  Scenario s = discs(0.5, 3);
  s.discs.resize(40);
  s.movers.assign(30, {{7, 7}, 0.1, {{7, 7}, {8, 7}}, 0});
  const World more = make_world(s);
  s.discs.resize(20);
  const World fewer = make_world(s);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(more.soft[i], fewer.soft[i]);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(more.soft[40 + i], fewer.soft[20 + i]);
}

}  // namespace
}  // namespace whisker
