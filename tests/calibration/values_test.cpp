#include "firmware/calibration/values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "firmware/calibration/tape.hpp"

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

TEST(Tape, IsPlausibleWithinAFifthAndAHundredMetres) {
  EXPECT_TRUE((Tape{5_m, 5_m}.plausible()));
  EXPECT_TRUE((Tape{500_mm, 500_mm}.plausible()));
  EXPECT_TRUE((Tape{4_m, 5_m}.plausible()));
  EXPECT_TRUE((Tape{6_m, 5_m}.plausible()));
  EXPECT_FALSE((Tape{3999_mm, 5_m}.plausible()));
  EXPECT_FALSE((Tape{6001_mm, 5_m}.plausible()));
  EXPECT_FALSE((Tape{499_mm, 500_mm}.plausible()));
  EXPECT_FALSE((Tape{500_mm, 499_mm}.plausible()));
  EXPECT_FALSE((Tape{Length{}, Length{}}.plausible()));
  EXPECT_FALSE((Tape{-5_m, -5_m}.plausible()));
  EXPECT_FALSE((Tape{Length::from_raw(INT32_MIN), Length::from_raw(INT32_MAX)}.plausible()));
  EXPECT_TRUE((Tape{Length::from_raw(100000000), Length::from_raw(100000000)}.plausible()));
  EXPECT_FALSE((Tape{Length::from_raw(100000000), Length::from_raw(100000001)}.plausible()));
}

/// The same in floating point, over the whole range of lengths, counts and readings.
TEST(Tape, CountsAndUncertaintyAreThoseOfTheFormulas) {
  for (const std::int32_t counts : {818, 5000, 100000}) {
    for (const double way : {0.5, 1.0, 5.0, 37.0, 95.0}) {
      for (const double share : {0.82, 0.999, 1.0, 1.0101, 1.19}) {
        for (const std::int32_t sigma_um : {0, 500, 2000, 50000, 1000000}) {
          Params params;
          params.wheels.counts_per_metre = counts;
          const double measured = way * 1.05;
          const Tape tape{Length::from_raw(static_cast<std::int32_t>(std::lround(measured * share * 1e6))),
                          Length::from_raw(static_cast<std::int32_t>(std::lround(measured * 1e6)))};
          if (!tape.plausible()) continue;
          Values values;
          ASSERT_TRUE(take_tape(values, params, tape, Length::from_raw(sigma_um)));
          const Measured& found = values[Quantity::counts_per_metre];
          EXPECT_EQ(found.value, std::lround(counts * (1.0 * tape.driven.raw() / tape.measured.raw())));
          const double reading = std::hypot(sigma_um * 1e-6, 1e-3) / measured;
          EXPECT_NEAR(found.sigma.raw(), 1e6 * std::hypot(reading, std::sqrt(1.0 / 12) / found.value), 0.6);
          EXPECT_NEAR(values[Quantity::track].value, 1.0 * params.body.track.raw() * counts / found.value, 1);
        }
      }
    }
  }
}

TEST(Tape, AnImplausibleOneChangesNothing) {
  Values values, before;
  before[Quantity::track] = values[Quantity::track] = {141000, millionths(100)};
  EXPECT_FALSE(take_tape(values, Params{}, {5_m, 7_m}));
  EXPECT_EQ(values, before);
}

}  // namespace
}  // namespace whisker::calibration
