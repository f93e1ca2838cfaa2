#include "firmware/localization/fix_teacher.hpp"

namespace whisker::localization {
namespace {

constexpr Angle kPortion = Angle::turns(1, 8192);

}  // namespace

void FixTeacher::configure(const Params& params, const Odometry& odometry) noexcept {
  gains_.configure(params, odometry);
  gains_.expect_declared();
}

void FixTeacher::restart() noexcept {
  has_fix_ = false;
  ahead_ = Angle{};
}

bool FixTeacher::fix(Angle offset, Angle sigma) noexcept {
  if (!gains_.declared()) return false;
  const bool lesson = has_fix_ && gains_.teaches(since_);
  if (has_fix_ && !lesson) return false;
  since_.error = (offset - offset_).wrapped();
  if (lesson) gains_.observe(since_, gains_.noise_of(sigma_) + gains_.noise_of(sigma), 0);
  has_fix_ = true;
  since_ = {};
  offset_ = offset;
  sigma_ = sigma;
  return lesson;
}

Angle FixTeacher::pass(const CountStep& step, const Odometry& odometry) noexcept {
  since_.way = saturating_add(since_.way, step.left + step.right);
  since_.turn = saturating_add(since_.turn, step.right - step.left);
  if (!gains_.learned()) return {};
  ahead_ += odometry.turn_of(gains_.difference(step));
  if (magnitude(ahead_.wrapped()) < kPortion.raw()) return {};
  const Angle portion = ahead_;
  ahead_ = Angle{};
  return portion;
}

}  // namespace whisker::localization
