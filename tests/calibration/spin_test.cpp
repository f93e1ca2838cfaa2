#include "host/calibration/spin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/calibration/collector.hpp"
#include "host/scenario/bearing.hpp"

namespace whisker::calibration {
namespace {

/// A body that turns as its wheels say.
struct Body {
  double turned = 0;
  double most = 0;
  double least = 0;
  double t_s = 0;

  void drive(Spin& spin, const Params& p, double share = 1) {
    while (!spin.done() && !spin.failed() && t_s < 1000) {
      const hal::WheelSpeeds v = spin.step(turned, 0, t_s);
      EXPECT_EQ(v.left, -v.right) << "on the spot";
      turned += share * (v.right - v.left) * 1e-4 / (p.body.track.raw() * 1e-6) * 0.01;
      most = std::max(most, turned);
      least = std::min(least, turned);
      t_s += 0.01;
    }
  }
};

TEST(Spin, TurnsMoreThanHalfAroundToEachSide) {
  const Params p;
  Spin spin(p);
  Body body;
  body.drive(spin, p);
  EXPECT_TRUE(spin.done());
  EXPECT_NEAR(body.most / kRadPerDeg, 190, 1);
  EXPECT_NEAR(body.least / kRadPerDeg, -190, 1);
  EXPECT_NEAR(body.turned / kRadPerDeg, 0, 1);
  EXPECT_NEAR(body.t_s, spin.duration_s(), 0.5);
}

TEST(Spin, DrivesAlongTheWallToASecondTurn) {
  const Params p;
  Spin spin(p, 0.2);
  double turned = 0, x = 0, y = 0, least = 0, most = 0, t_s = 0;
  for (; !spin.done() && !spin.failed() && t_s < 1000; t_s += 0.01) {
    const hal::WheelSpeeds v = spin.step(turned, std::hypot(x, y), t_s);
    turned += (v.right - v.left) * 1e-4 / (p.body.track.raw() * 1e-6) * 0.01;
    x += std::cos(turned) * (v.left + v.right) * 0.5e-4 * 0.01;
    y += std::sin(turned) * (v.left + v.right) * 0.5e-4 * 0.01;
    least = std::min(least, turned);
    most = std::max(most, turned);
  }
  EXPECT_TRUE(spin.done());
  EXPECT_NEAR(x, 0, 0.01);
  EXPECT_NEAR(y, -0.2, 0.01) << "to the right";
  EXPECT_NEAR(turned / kRadPerDeg, 0, 1);
  EXPECT_NEAR(most / kRadPerDeg, 190, 1);
  EXPECT_NEAR(least / kRadPerDeg, -190, 1);
  EXPECT_NEAR(t_s, spin.duration_s(), 0.5);
}

TEST(Spin, SlowSensorsTurnTheBodySlowly) {
  Params slow;
  slow.rangefinders.rate_hz = 20;
  EXPECT_NEAR(Spin(slow).duration_s(), 2 * 380 / 10.0 + 2, 0.1) << "half a degree a measurement";
  slow.rangefinders.rate_hz = 5;
  EXPECT_NEAR(Spin(slow).duration_s(), 2 * 380 / 8.0 + 2, 0.1) << "the slowest";
}

TEST(Spin, FailsIfTheWheelsDoNotTurn) {
  const Params p;
  Spin spin(p);
  Body body;
  body.drive(spin, p, 0.3);
  EXPECT_TRUE(spin.failed());
  EXPECT_FALSE(spin.done());
  EXPECT_EQ(spin.step(1, 0, body.t_s + 1).left, 0);
}

hal::RangeReadings readings(hal::RangeReading r) { return {{r, r, r}}; }

TEST(Collector, TakesEachMeasurementOnceAtItsTime) {
  Collector c{Params{}};
  for (int tick = 0; tick < 10; ++tick) {
    const auto sequence = static_cast<std::uint8_t>(tick / 2);
    const auto age = static_cast<std::uint8_t>(15 + 10 * (tick % 2));
    c.add(0.01 * tick, {{}, Angle::turns(tick, 360)}, readings({300, hal::RangeStatus::ok, age, sequence}));
  }
  ASSERT_EQ(c.sweep()[0].size(), 4U) << "five, of which the first is older than the first tick";
  EXPECT_NEAR(c.sweep()[0][0].heading_rad / kRadPerDeg, 2 - 1.5, 1e-6);
  EXPECT_NEAR(c.sweep()[2][3].heading_rad / kRadPerDeg, 8 - 1.5, 1e-6);
  EXPECT_EQ(c.sweep()[1][0].metres, 0.3);
}

TEST(Collector, HeadingsGoOnBeyondATurn) {
  Collector c{Params{}};
  for (int tick = 0; tick < 500; ++tick) {
    c.add(0.01 * tick, {{}, Angle::turns(tick, 360)}, readings({0, hal::RangeStatus::clear, 0, 0}));
  }
  EXPECT_NEAR(c.turned_rad() / kRadPerDeg, 499, 1e-5);
}

TEST(Collector, TellsTheStatusesApart) {
  Collector c{Params{}};
  using S = hal::RangeStatus;
  std::uint8_t sequence = 0;
  for (const S status : {S::ok, S::clear, S::too_near, S::invalid, S::stale}) {
    c.add(0.01 * sequence, {}, readings({500, status, 0, sequence}));
    ++sequence;
  }
  c.add(1, {}, readings({500, S::ok, 255, sequence}));
  const Samples& s = c.sweep()[0];
  ASSERT_EQ(s.size(), 4U) << "no stale one, and none of unknown age";
  EXPECT_EQ(s[0].metres, 0.5);
  EXPECT_EQ(s[1].reading, Reading::clear);
  EXPECT_EQ(s[2].metres, 0.02) << "at the minimum range";
  EXPECT_EQ(s[3].reading, Reading::lost);
}

}  // namespace
}  // namespace whisker::calibration
