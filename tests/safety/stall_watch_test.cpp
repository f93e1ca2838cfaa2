#include "firmware/safety/stall_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/control/wheel_drive.hpp"

namespace whisker::safety {
namespace {

constexpr Duration kStep = 10_ms;
constexpr int kSteps = 10000;

/// Ticks until a body whose encoders count nothing is found to stand; kSteps: never.
template <class Command>
int found_after(Command command, localization::CountStep counts = {}) {
  const Params params;
  StallWatch watch;
  for (int tick = 0; tick < kSteps; ++tick) {
    const WheelPair speeds = command(tick);
    if (watch.stalled(counts, control::turns_on_wire(speeds), speeds, kStep, params)) return tick;
  }
  return kSteps;
}

TEST(StallWatch, WheelsThatCountNothingAreStalledAfterTheTimeout) {
  const int timeout = derived::stalled_after(Params{}).raw() / kStep.raw();
  EXPECT_EQ(found_after([](int) { return WheelPair{200_mm_per_s, 200_mm_per_s}; }), timeout);
  EXPECT_EQ(found_after([](int) { return WheelPair{-200_mm_per_s, 200_mm_per_s}; }), timeout);
  EXPECT_EQ(found_after([](int) { return WheelPair{{}, 200_mm_per_s}; }), timeout);
}

TEST(StallWatch, ACountOfEitherWheelOrAPauseBeginsAnew) {
  const auto ahead = [](int) { return WheelPair{200_mm_per_s, 200_mm_per_s}; };
  EXPECT_EQ(found_after(ahead, {1, 0}), kSteps);
  EXPECT_EQ(found_after(ahead, {0, -1}), kSteps);
  EXPECT_EQ(found_after([&](int tick) { return tick % 20 == 0 ? WheelPair{} : ahead(0); }), kSteps);
}

// A turn by less than a count.
TEST(StallWatch, ACommandOfLessThanACountSaysNothing) {
  const Speed creep = Speed::from_raw(100);
  const int found = found_after([&](int) { return WheelPair{-creep, creep}; });
  const int ten_counts_ms = 10 * 1000000 / Params{}.wheels.counts_per_metre * 1000 / creep.raw();
  EXPECT_GE(found, std::min(kSteps, ten_counts_ms / kStep.raw()));
}

TEST(StallWatch, ASpeedThatRoundsToNoneOnTheWireSaysNothing) {
  const Speed creep = Speed::from_raw(49);
  EXPECT_EQ(found_after([&](int) { return WheelPair{-creep, creep}; }), kSteps);
}

TEST(StallWatch, CommandsToAndFroWithinTheCountsSayNothing) {
  const auto swing = [](int tick) {
    return tick % 2 == 0 ? WheelPair{20_mm_per_s, -20_mm_per_s} : WheelPair{-20_mm_per_s, 20_mm_per_s};
  };
  EXPECT_EQ(found_after(swing), kSteps);
}

}  // namespace
}  // namespace whisker::safety
