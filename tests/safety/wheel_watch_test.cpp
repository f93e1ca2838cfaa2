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

/// The reference body. Both wheels are asked for 150 mm/s; the left one turns from `released` on, the right
/// one swings by this many counts every tenth tick before.
WheelWatch::Finding held(int swing, int released) {
  WheelWatch watch;
  watch.configure(Params{});
  const auto per_tick = static_cast<std::int32_t>(Params{}.wheels.counts_per_metre * 15 / 10000);
  for (int tick = 0; tick < 2000; ++tick) {
    watch.expect({150_mm_per_s, 150_mm_per_s}, kTick);
    const bool turns = tick >= released;
    const std::int32_t right = tick % 10 != 0 ? 0 : tick % 20 == 0 ? swing : -swing;
    const WheelWatch::Finding found = turns ? watch.judge({per_tick, per_tick}) : watch.judge({0, right});
    if (found != WheelWatch::Finding::none) return found;
  }
  return WheelWatch::Finding::none;
}

TEST(WheelWatch, AWheelThatStandsWhileTheOtherOneSwingsIsFound) {
  EXPECT_EQ(held(3, 2000), WheelWatch::Finding::stalled);
  // More than that is a wheel that goes another way than it is asked to.
  for (const int swing : {4, 10}) EXPECT_NE(held(swing, 2000), WheelWatch::Finding::none) << swing;
}

TEST(WheelWatch, TwoWheelsThatAreHeldAndReleasedAreNot) {
  for (const int released : {100, 300, 1000, 2000}) EXPECT_EQ(held(0, released), WheelWatch::Finding::none);
}

TEST(WheelWatch, AShortHoldIsForgotten) {
  for (const int released : {20, 60, 100})
    EXPECT_EQ(held(3, released), WheelWatch::Finding::none) << released;
}

/// The reference body with this lag, and wheels without one. They are asked for half a second each way, at
/// full acceleration, and counted without an error.
TEST(WheelWatch, WheelsThatFollowSoonerThanStatedAreNoRunaway) {
  for (const Duration lag : {50_ms, 200_ms, 500_ms}) {
    Params params;
    params.wheels.motor_lag = lag;
    WheelWatch watch;
    watch.configure(params);
    const double full = static_cast<double>(params.wheels.max_speed.raw());
    const double step = static_cast<double>(params.wheels.max_acceleration.raw()) * kTick.raw() / 1000;
    double command = 0, expected = 0, way_um = 0;
    std::int32_t last = 0;
    for (int tick = 0; tick < 2000; ++tick) {
      const double wanted = tick / 50 % 2 == 0 ? full : -full;
      command += std::fmax(-step, std::fmin(step, wanted - command));
      expected += (command - expected) * kTick.raw() / lag.raw();
      const Speed speed = Speed::from_raw(static_cast<std::int32_t>(expected));
      watch.expect({speed, speed}, kTick);
      way_um += command * kTick.raw() / 1000;
      const auto now = static_cast<std::int32_t>(
          std::floor(way_um * static_cast<double>(params.wheels.counts_per_metre) / 1e6));
      ASSERT_EQ(watch.judge({now - last, now - last}), WheelWatch::Finding::none)
          << lag.raw() << " ms, tick " << tick;
      last = now;
    }
  }
}

}  // namespace
}  // namespace whisker::safety
