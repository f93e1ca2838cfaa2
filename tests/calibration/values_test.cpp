#include "firmware/calibration/values.hpp"

#include <gtest/gtest.h>

namespace whisker::calibration {
namespace {

Values all_known() {
  Values values;
  values[Quantity::gyro_scale] = {1012345, millionths(70)};
  values[Quantity::wheel_ratio] = {998000, millionths(60)};
  values[Quantity::counts_per_metre] = {4950, millionths(1000)};
  values[Quantity::track] = {141200, millionths(160)};
  return values;
}

TEST(CalibrationValues, BecomeParameters) {
  Params params;
  ASSERT_EQ(apply(all_known(), params), ParamFault::none);
  EXPECT_EQ(params.gyro.scale, millionths(1012345));
  EXPECT_EQ(params.wheels.ratio, millionths(998000));
  EXPECT_EQ(params.wheels.counts_per_metre, 4950);
  EXPECT_EQ(params.body.track, micrometres(141200));
  for (int i = 0; i < kQuantities; ++i) {
    EXPECT_EQ(value_in(params, static_cast<Quantity>(i)), all_known().of[i].value) << i;
  }
}

TEST(CalibrationValues, WhatIsNotMeasuredStays) {
  Params params;
  params.body.track = 150_mm;
  Values values;
  values[Quantity::wheel_ratio] = {1001000, {}};
  ASSERT_EQ(apply(values, params), ParamFault::none);
  EXPECT_EQ(params.body.track, 150_mm);
  EXPECT_EQ(params.wheels.ratio, millionths(1001000));
  const Params before = params;
  ASSERT_EQ(apply({}, params), ParamFault::none);
  EXPECT_EQ(params.wheels.ratio, before.wheels.ratio);
}

// Each value just outside and far outside its range, or against another parameter: nothing changes.
TEST(CalibrationValues, AreRefusedAsCheckRefusesThem) {
  const struct {
    Quantity quantity;
    std::int32_t value;
    ParamFault fault;
  } kCases[] = {
      {Quantity::gyro_scale, 799999, ParamFault::out_of_range},
      {Quantity::gyro_scale, -1, ParamFault::out_of_range},
      {Quantity::wheel_ratio, 1100001, ParamFault::out_of_range},
      {Quantity::wheel_ratio, INT32_MIN, ParamFault::out_of_range},
      {Quantity::counts_per_metre, 99, ParamFault::out_of_range},
      {Quantity::counts_per_metre, 400, ParamFault::tolerance_below_encoder},
      {Quantity::track, 181000, ParamFault::track_wider_than_body},
      {Quantity::track, INT32_MAX, ParamFault::out_of_range},
  };
  for (const auto& c : kCases) {
    Params params;
    Values values;
    values[Quantity::gyro_scale] = {1010000, {}};
    values[c.quantity] = {c.value, {}};
    EXPECT_EQ(apply(values, params), c.fault) << name(c.quantity) << " " << c.value;
    EXPECT_EQ(params.gyro.scale, Params{}.gyro.scale);
    EXPECT_EQ(value_in(params, c.quantity), value_in(Params{}, c.quantity));
    EXPECT_EQ(check(params), ParamFault::none);
  }
}

TEST(CalibrationValues, OtherCountsPerMetreTurnTheBodyAsBefore) {
  const Params params;  // 5000 counts, 140 mm
  Values values;
  rescale(values, params, {5050, millionths(800)});
  EXPECT_EQ(values[Quantity::counts_per_metre].value, 5050);
  EXPECT_EQ(values[Quantity::track].value, 138614);
  EXPECT_EQ(values[Quantity::track].sigma, millionths(800));

  values = all_known();
  rescale(values, params, {9900, {}});
  EXPECT_EQ(values[Quantity::track].value, 70600);
  EXPECT_EQ(values[Quantity::track].sigma, millionths(160));
}

TEST(CalibrationValues, AreCorrectedByAShare) {
  EXPECT_EQ(corrected(140000, millionths(10000)), 141400);
  EXPECT_EQ(corrected(1000000, millionths(-300)), 999700);
  EXPECT_EQ(corrected(INT32_MAX, millionths(1)), INT32_MAX);
}

}  // namespace
}  // namespace whisker::calibration
