#include "firmware/perception/ground_age.hpp"

#include "firmware/params/reach.hpp"
#include "firmware/part.hpp"

namespace whisker::perception {

using namespace literals;

namespace {

constexpr int32_t kOne = 1000000;  // Ratio of 1

// The least ages that the parameters may set: with shorter ones, ground expires before the body has looked
// around.
constexpr Length kLeastTravel = 100_mm;
constexpr Angle kLeastTurn = 90_deg;

/// part / error, between `least` and `most`. An error of zero allows everything.
constexpr int64_t age_until(int64_t part, int64_t error, int64_t least, int64_t most) noexcept {
  const int64_t age = error == 0 ? most : quotient_64(part, error);
  return age > most ? most : age < least ? least : age;
}

}  // namespace

GroundAge ground_age(const Params& params) noexcept {
  GroundAge age{derived::kAgeTravel, derived::kAgeTurn};
  const PoseErrorParams& e = params.pose_error;
  if (!kGyroBuilt || (e.wheel_scale == Ratio{} && e.wheel_scale_common == Ratio{})) return age;
  const Reach reach = whisker::reach(params);
  // One standard deviation of the heading, millionths of a radian.
  const int64_t allowed =
      quotient_64(int64_t{grid_cell(params).raw()} * kOne, 4 * int64_t{(reach.guard + reach.probe).raw()});
  const bool gyro = params.gyro.fitted == Fitted::yes;
  // Errors of two wheels: their difference is off by sqrt(2) of one, their mean by 1 / sqrt(2).
  const int64_t apart = gyro ? 0 : quotient(int64_t{e.wheel_scale.raw()} * 1414, 1000);
  age.travel = Length::from_raw(narrow<int32_t>(
      age_until(allowed * params.body.track.raw(), apart, kLeastTravel.raw(), age.travel.raw())));
  const int32_t together = max(e.wheel_scale * 707 / 1000, e.wheel_scale_common).raw();
  const int32_t turning = gyro ? e.gyro_scale.raw() : together;
  constexpr int64_t kPerRadian = 683565276;  // 2^32 / (2 pi)
  age.turn = Angle::from_raw(
      narrow<uint32_t>(age_until(allowed * kPerRadian, turning, kLeastTurn.raw(), age.turn.raw())));
  return age;
}

}  // namespace whisker::perception
