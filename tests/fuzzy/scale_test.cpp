#include "firmware/fuzzy/scale.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

TEST(Scale, MapsTheRangesOfTheSensorsToTheRangesOfTheInputs) {
  const Inputs clear_right = scale(0_mm, 2_m, 2_m, 2_m, DistanceSource::front);
  EXPECT_EQ(clear_right.distance.raw(), kDistanceMax);
  EXPECT_EQ(clear_right.bias.raw(), kBiasMax);
  const Inputs clear_left = scale(2_m, 0_mm, 0_mm, 2_m, DistanceSource::front);
  EXPECT_EQ(clear_left.distance.raw(), 0);
  EXPECT_EQ(clear_left.bias.raw(), -kBiasMax);
}

TEST(Scale, TakesTheFrontOrTheMeanOfTheThree) {
  EXPECT_EQ(scale(300_mm, 600_mm, 1200_mm, 2_m, DistanceSource::front).distance.raw(), 384);
  EXPECT_EQ(scale(300_mm, 600_mm, 1200_mm, 2_m, DistanceSource::mean).distance.raw(), 448);
}

TEST(Scale, CountsDistancesWithinZeroAndTheMaximumRange) {
  const Length far = Length::from_raw(INT32_MAX);
  const Length behind = Length::from_raw(INT32_MIN);
  for (const DistanceSource source : {DistanceSource::front, DistanceSource::mean}) {
    const Inputs most = scale(far, far, far, 2_m, source);
    EXPECT_EQ(most.distance.raw(), kDistanceMax);
    EXPECT_EQ(most.bias.raw(), 0);
    EXPECT_EQ(scale(behind, behind, behind, 2_m, source).distance.raw(), 0);
    EXPECT_EQ(scale(behind, far, far, 60_m, source).bias.raw(), kBiasMax);
  }
}

Length any_length() {
  return millimetres(*rc::gen::inRange(-500, 70000)) + micrometres(*rc::gen::inRange(0, 1000));
}

double counted(Length x, Length max_range) {
  return std::clamp(double(x.raw()), 0.0, double(max_range.raw())) / max_range.raw();
}

RC_GTEST_PROP(Scale, IsTheFormulaRoundedToTheNearestUnit, ()) {
  const Length max_range = millimetres(*rc::gen::inRange(200, 60001));
  const Length left = any_length();
  const Length front = any_length();
  const Length right = any_length();
  const double l = counted(left, max_range);
  const double f = counted(front, max_range);
  const double r = counted(right, max_range);
  const Inputs by_front = scale(left, front, right, max_range, DistanceSource::front);
  const Inputs by_mean = scale(left, front, right, max_range, DistanceSource::mean);
  RC_ASSERT(std::abs(by_front.distance.raw() - 1280 * f) <= 0.5 + 1e-9);
  RC_ASSERT(std::abs(by_mean.distance.raw() - 1280 * (l + f + r) / 3) <= 0.5 + 1e-9);
  RC_ASSERT(std::abs(by_front.bias.raw() - 1024 * (r - l)) <= 0.5 + 1e-9);
  RC_ASSERT(by_mean.bias == by_front.bias);
}

RC_GTEST_PROP(Scale, MirrorsExactlyWhenTheSidesAreSwapped, ()) {
  const Length max_range = millimetres(*rc::gen::inRange(200, 60001));
  const Length left = any_length();
  const Length front = any_length();
  const Length right = any_length();
  for (const DistanceSource source : {DistanceSource::front, DistanceSource::mean}) {
    const Inputs here = scale(left, front, right, max_range, source);
    const Inputs there = scale(right, front, left, max_range, source);
    RC_ASSERT(here.distance == there.distance);
    RC_ASSERT(here.bias.raw() == -there.bias.raw());
  }
}

}  // namespace
}  // namespace whisker::fuzzy
