#include "firmware/localization/fix_teacher.hpp"

namespace whisker::localization {

void FixTeacher::configure(const Params& params, const Odometry& odometry) noexcept {
  gains_.configure(odometry.counts_per_turn(), params.wheels.counts_per_metre, odometry.skew());
  const PoseErrorParams& e = params.pose_error;
  if (e.wheel_scale == Ratio{} && e.wheel_scale_common == Ratio{}) return;
  // The mean of two wheels is off by 1 / sqrt(2) of one, and so is half of their difference.
  const Ratio half = millionths(multiply_divide(e.wheel_scale.raw(), 70711, 100000));
  gains_.expect(half + e.wheel_scale_common, half);
}

void FixTeacher::restart(Angle offset, Angle sigma) noexcept {
  offset_ = offset;
  sigma_ = sigma;
  way_ = turn_ = 0;
}

void FixTeacher::pass(const CountStep& step) noexcept {
  way_ = saturating_add(way_, step.left + step.right);
  turn_ = saturating_add(turn_, step.right - step.left);
}

bool FixTeacher::fix(Angle offset, Angle sigma) noexcept {
  if (!gains_.teaches(way_, turn_)) return false;
  // A slip teaches nothing, but the next way begins here all the same.
  gains_.observe({way_, turn_, (offset - offset_).wrapped()},
                 gains_.noise_of(sigma_) + gains_.noise_of(sigma));
  return taught_ = true;
}

}  // namespace whisker::localization
