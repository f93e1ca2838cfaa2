#include "host/calibration/sample.hpp"

#include <gtest/gtest.h>

#include "host/scenario/bearing.hpp"

namespace whisker::calibration {
namespace {

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
