#include "firmware/safety/warning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/worlds/random.hpp"

namespace whisker::test {
namespace {

double shortest_m(const Params& p) { return shortest_warning(p).raw() * 1e-6; }

Params layout(Angle side, Angle incidence) {
  Params p;
  p.rangefinders.side_angle = side;
  p.rangefinders.incidence = incidence;
  return p;
}

TEST(Warning, IsTwoThirdsOfTheWayFromTheFirstEchoOfADiscAtTheFlank) {
  const Params p = layout(Angle::turns(425, 3600), 40_deg);
  const double edge = (42.5 + 12.5) * M_PI / 180;
  EXPECT_NEAR(shortest_m(p), 0.09 * std::sin(40 * M_PI / 180) / std::sin(edge) * 2 / 3, 1e-5);
}

TEST(Warning, TheBodyStopsWithinIt) {
  worlds::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    Params p = layout(Angle::turns(static_cast<int32_t>(random.uniform(10, 80)), 360),
                      Angle::turns(static_cast<int32_t>(random.uniform(20, 89)), 360));
    p.wheels.max_acceleration = Acceleration::from_raw(static_cast<int32_t>(random.uniform(50e3, 5e6)));
    p.rangefinders.latency = milliseconds(static_cast<int32_t>(random.uniform(0, 200)));
    p.rangefinders.rate_hz = static_cast<int32_t>(random.uniform(5, 100));
    const bool err = i % 2 == 1;
    const double v = safety::warned_speed(p, err).raw() * 1e-6;
    const double delay = p.rangefinders.latency.raw() * 1e-3 + (err ? 3.0 : 1.0) / p.rangefinders.rate_hz;
    const double braking = v * v / 2 / (p.wheels.max_acceleration.raw() * 1e-6);
    EXPECT_LE(v * delay + braking, shortest_m(p) * 1.001) << "robot " << i;
    EXPECT_GT(v, 0) << "robot " << i;
  }
}

TEST(Warning, SensorsThatLoseMoreWallsDriveSlower) {
  Speed last = safety::warned_speed(layout(30_deg, 90_deg), false);
  for (const Angle incidence : {75_deg, 60_deg, 45_deg, 30_deg}) {
    const Speed now = safety::warned_speed(layout(30_deg, incidence), false);
    EXPECT_LT(now, last);
    last = now;
  }
}

TEST(Warning, TurningIsSlowerDownToAQuarter) {
  EXPECT_EQ(safety::warned_speed(200_mm_per_s, 0_mm_per_s), 200_mm_per_s);
  EXPECT_EQ(safety::warned_speed(200_mm_per_s, -(80_mm_per_s)), 120_mm_per_s);
  EXPECT_EQ(safety::warned_speed(200_mm_per_s, 300_mm_per_s), 50_mm_per_s);
}

}  // namespace
}  // namespace whisker::test
