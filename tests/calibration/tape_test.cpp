#include "firmware/calibration/tape.hpp"

#include <cmath>
#include <initializer_list>

#include <gtest/gtest.h>

namespace whisker::calibration {
namespace {

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
