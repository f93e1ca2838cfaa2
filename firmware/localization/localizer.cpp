#include "firmware/localization/localizer.hpp"

namespace whisker::localization {

void Localizer::configure() noexcept {
  odometry_.configure(params_);
  if (has_gyro()) heading_->configure(params_, odometry_);
  if (!kGyroBuilt) return;
  bound_->configure(params_);
  teacher_->configure(params_, odometry_);
  estimate_.sigma_known = bound_->known();
  restart_bound({});
}

void Localizer::put_down(const Pose& pose) noexcept {
  odometry_.place(pose);
  if (has_gyro()) heading_->restart();
  if (kGyroBuilt) teacher_->restart();
  estimate_.pose = pose;
  frame_.tie(pose, pose);
  restart_bound({});
}

void Localizer::move(const Pose& pose) noexcept {
  if (kGyroBuilt) teacher_->restart();
  restart_bound({});
  tie(pose);
}

void Localizer::restart_lessons() noexcept {
  if (!kGyroBuilt) return;
  teacher_->restart();
  heading_->drop_stretch();
}

bool Localizer::correct(const Pose& pose, const PoseSigma& sigma) noexcept {
  const UncertainPose told{pose, sound(sigma)};
  UncertainPose fix = told;
  if (has_bound()) {
    const UncertainPose estimate{estimate_.pose, bound_->sigma()};
    if (jumps(estimate, fix)) {
      count(health_.fix_jumps);
      if (params_.fix_jumps == JumpPolicy::refuse) {
        count(health_.fixes_refused);
        return false;
      }
    }
    fix = fused(estimate, fix);
  }
  teach(told.pose.heading, told.sigma.heading);
  restart_bound(fix.sigma);
  tie(fix.pose);
  return true;
}

bool Localizer::correct_heading(Angle ahead, Angle sigma) noexcept {
  PoseBound::Correction by;
  if (!bound_->correct_heading(ahead, sigma, by)) return false;
  estimate_.sigma = bound_->sigma();
  const Pose pose = ahead_by(by);
  teach(estimate_.pose.heading + ahead, sigma);
  tie(pose);
  return true;
}

/// By a correction in the odometry frame.
Pose Localizer::ahead_by(const PoseBound::Correction& by) const noexcept {
  const Angle outward = estimate_.pose.heading - odometry_.pose().heading;
  const Vec shift = polar(bearing(by.shift) + outward, norm(by.shift));
  return {estimate_.pose.at + shift, estimate_.pose.heading + by.turn};
}

bool Localizer::learn_bias() noexcept {
  GyroBias::Mean mean;
  heading_->bias().doubt(bound_->heading_wanders());
  if (!heading_->bias().take(params_.gyro, mean)) return false;
  const PoseBound::Correction by = bound_->rest(mean, params_, heading_->bias());
  if (mean.first) {
    estimate_.heading_source = heading_->source();
    return false;
  }
  if (has_bound()) estimate_.sigma = bound_->sigma();
  tie(ahead_by(by));
  return true;
}

void Localizer::teach(Angle fix, Angle sigma) noexcept {
  if (!kGyroBuilt || has_gyro() || !teacher_->fix(fix - odometry_.pose().heading, sigma)) return;
  if (has_bound()) bound_->set_difference(teacher_->gains().skew_sigma() * 2, params_.body.track);
}

bool Localizer::turn_as_taught() noexcept {
  const Angle turn = teacher_->pass(counts_, odometry_);
  if (turn == Angle{}) return false;
  tie({estimate_.pose.at, estimate_.pose.heading + turn});
  return true;
}

void Localizer::tie(const Pose& pose) noexcept {
  if (pose.at == estimate_.pose.at && pose.heading == estimate_.pose.heading) return;
  frame_.tie(odometry_.pose(), pose);
  estimate_.pose = pose;
}

Localizer::Stepped Localizer::step(const Step& step) noexcept {
  if (!odometry_.take(step.counts, step.since, counts_)) return Stepped::jumped;
  advance(step);
  estimate_.pose = frame_.outward(odometry_.pose());
  if (!kGyroBuilt) return Stepped::advanced;
  const bool moved = has_gyro() ? learn_bias() : turn_as_taught();
  return moved ? Stepped::corrected : Stepped::advanced;
}

void Localizer::advance(const Step& step) noexcept {
  if (!kGyroBuilt) return odometry_.advance(counts_);
  if (has_gyro()) {
    const GyroHeading::Step turn{step.gyro, counts_, step.commanded, step.since};
    odometry_.advance(counts_, heading_->turn(turn, odometry_, health_));
    estimate_.heading_source = heading_->source();
  } else {
    odometry_.advance(counts_);
  }
  advance_bound(step.since);
}

void Localizer::advance_bound(Duration since) noexcept {
  if (!has_bound() && !has_gyro()) return;
  const bool by_gyro = estimate_.heading_source == HeadingSource::gyro;
  if (bound_->step({odometry_.pose(), counts_, since, by_gyro})) estimate_.sigma = bound_->sigma();
}

void Localizer::restart_bound(const PoseSigma& sigma) noexcept {
  if (!kGyroBuilt) return;
  bound_->restart(odometry_.pose(), sigma);
  if (has_bound()) estimate_.sigma = bound_->sigma();
}

}  // namespace whisker::localization
