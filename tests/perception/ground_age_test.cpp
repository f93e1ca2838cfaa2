#include "firmware/perception/ground_age.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/params/reach.hpp"

namespace whisker::perception {
namespace {

double radians(Angle a) { return a.raw() * 2 * M_PI / 4294967296.0; }

Params wheels(int32_t millionth) {
  Params p;
  p.pose_error.wheel_scale = millionths(millionth);
  return p;
}

TEST(GroundAge, IsThatOfTheParametersIfNoErrorIsDeclared) {
  Params p;
  p.gyro.fitted = Fitted::yes;
  const GroundAge age = ground_age(p);
  EXPECT_EQ(age.travel, derived::kAgeTravel);
  EXPECT_EQ(age.turn, derived::kAgeTurn);
}

TEST(GroundAge, TwoStandardDeviationsOfTheHeadingMoveTheGroundByHalfACell) {
  for (const int32_t millionth : {6000, 12000, 18000}) {
    const Params p = wheels(millionth);
    const GroundAge age = ground_age(p);
    const Reach reach = whisker::reach(p);
    const double far = (reach.guard + reach.probe).raw() * 1e-6;
    const double most = grid_cell(p).raw() * 1e-6 / 2;
    const double each = millionth * 1e-6;
    const double by_travel = age.travel.raw() * 1e-6 * each * std::sqrt(2) / (p.body.track.raw() * 1e-6);
    EXPECT_NEAR(2 * by_travel * far, most, most * 0.01) << millionth;
    const double by_turn = radians(age.turn) * each / std::sqrt(2);
    EXPECT_LE(2 * by_turn * far, most * 1.01) << millionth;
  }
}

TEST(GroundAge, TheLargestErrorsLeaveWhatTheParametersMaySet) {
  for (const int32_t millionth : {50000, 100000}) {
    EXPECT_EQ(ground_age(wheels(millionth)).travel, 100_mm) << millionth;
    EXPECT_EQ(ground_age(wheels(millionth)).turn, 90_deg) << millionth;
  }
}

TEST(GroundAge, GoodWheelsAreNoReasonToAgeSooner) {
  const GroundAge age = ground_age(wheels(1000));
  EXPECT_EQ(age.travel, derived::kAgeTravel);
  EXPECT_EQ(age.turn, derived::kAgeTurn);
}

TEST(GroundAge, AGyroCountsInsteadOfTheWheels) {
  Params p = wheels(50000);
  p.gyro.fitted = Fitted::yes;
  p.pose_error.gyro_scale = millionths(1000);
  EXPECT_EQ(ground_age(p).travel, derived::kAgeTravel);
  EXPECT_EQ(ground_age(p).turn, derived::kAgeTurn);
  p.pose_error.gyro_scale = millionths(50000);
  EXPECT_LT(ground_age(p).turn.raw(), derived::kAgeTurn.raw());
}

TEST(GroundAge, ACommonErrorOfTheWheelsTurnsTheBodyToo) {
  Params p;
  p.pose_error.wheel_scale_common = millionths(30000);
  EXPECT_EQ(ground_age(p).travel, derived::kAgeTravel);
  EXPECT_LT(ground_age(p).turn.raw(), derived::kAgeTurn.raw());
}

}  // namespace
}  // namespace whisker::perception
