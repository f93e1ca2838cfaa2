#include "firmware/safety/wheel_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whisker::safety {
namespace {

constexpr Duration kTick = 10_ms;

/// Encoders of 2 mm a count. The right wheel runs at 20 mm/s; the left one at `command(tick)`, if it turns.
template <class Command>
WheelWatch::Finding finding(bool turns, Command command) {
  Params params;
  params.body.radius = 20_mm;
  params.wheels.max_speed = 20_mm_per_s;
  params.wheels.counts_per_metre = 500;
  WheelWatch watch;
  watch.configure(params);
  double left_um = 1000, right_um = 1000;
  localization::CountStep last;
  for (int tick = 0; tick < 10000; ++tick) {
    const WheelPair speeds{command(tick), 20_mm_per_s};
    watch.expect(speeds, kTick);
    if (turns) left_um += (speeds.left * kTick).raw();
    right_um += (speeds.right * kTick).raw();
    const localization::CountStep now{static_cast<std::int32_t>(std::floor(left_um / 2000)),
                                      static_cast<std::int32_t>(std::floor(right_um / 2000))};
    const WheelWatch::Finding found = watch.judge({now.left - last.left, now.right - last.right});
    if (found != WheelWatch::Finding::none) return found;
    last = now;
  }
  return WheelWatch::Finding::none;
}

Speed there_and_back(int tick) { return tick / 20 % 2 == 0 ? 20_mm_per_s : -20_mm_per_s; }

// 4 mm to and fro: two counts, as many as steady() takes for the oscillation of a wheel at rest.
TEST(WheelWatch, AWheelThatSwingsWithinItsCountsIsNotStalled) {
  EXPECT_EQ(finding(true, there_and_back), WheelWatch::Finding::none);
}

TEST(WheelWatch, AWheelThatStandsIsStalled) {
  EXPECT_EQ(finding(false, [](int) { return 20_mm_per_s; }), WheelWatch::Finding::stalled);
  EXPECT_EQ(finding(false, [](int tick) { return tick / 200 % 2 == 0 ? 20_mm_per_s : -20_mm_per_s; }),
            WheelWatch::Finding::stalled);
}

}  // namespace
}  // namespace whisker::safety
