/// The first stage: the pose from the encoder counts, the gyro and fixes.
#pragma once

#include "firmware/health.hpp"
#include "firmware/localization/fix_teacher.hpp"
#include "firmware/localization/frame.hpp"
#include "firmware/localization/gyro_heading.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/localization/pose_bound.hpp"
#include "firmware/localization/pose_fix.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/part.hpp"
#include "hal/types.hpp"

namespace whisker::localization {

/// The estimate of the pose, in the user's frame.
struct Estimate {
  Pose pose;
  bool sigma_known = false;  ///< the parameters declare an error of the wheels, and the image has the code
  PoseSigma sigma;           ///< standard deviations of the pose, if known
  HeadingSource heading_source = HeadingSource::wheels;
};

/// Perception and planning work in the odometry frame: inside(). Only counts and gyro move the body in it.
/// What is told from outside, fixes, places and the direction of walls, moves the user's frame, in which the
/// estimate is: whatever is told, ground that was seen stays where it is around the body.
class Localizer {
 public:
  struct Step {
    hal::EncoderCounts counts{};
    const hal::GyroReading* gyro = nullptr;  ///< null: it did not answer, or there is none
    bool commanded = false;                  ///< a wheel is commanded to turn
    Duration since;                          ///< the last step
  };

  /// All must outlive it.
  Localizer(const Params& params, Estimate& estimate, Health& health) noexcept
      : params_(params), estimate_(estimate), health_(health) {}
  void configure() noexcept;

  /// The body was put down here: the next counts are the new zero, and both frames are the same.
  void put_down(const Pose& pose) noexcept;
  /// The body was here at the last step, exactly.
  void move(const Pose& pose) noexcept;
  /// The body was here at the last step, by a fix from outside: see Robot::correct. False: the fix is
  /// refused.
  bool correct(const Pose& pose, const PoseSigma& sigma) noexcept;
  /// Counts may have been lost: what is being learned of the wheels begins anew.
  void restart_lessons() noexcept;
  /// The heading is measured: it is off by `ahead`, with this standard deviation. See
  /// PoseBound::correct_heading(), also for false. Needs a bound of the pose.
  bool correct_heading(Angle ahead, Angle sigma) noexcept;
  enum class Stepped : uint8_t {
    jumped,  ///< the counts did, and the pose ignores them: see Odometry::take
    advanced,
    corrected  ///< advanced, and the user's frame has moved: so has the goal in the odometry frame
  };
  Stepped step(const Step& step) noexcept;

  Pose inside() const noexcept { return odometry_.pose(); }
  /// The same in the user's frame.
  Pose outside() const noexcept { return estimate_.pose; }
  uint32_t travelled_um() const noexcept { return odometry_.travelled_um(); }
  /// Counts of the last step.
  const CountStep& counts() const noexcept { return counts_; }
  Frame& frame() noexcept { return frame_; }

  bool has_gyro() const noexcept { return kGyroBuilt && params_.gyro.fitted == Fitted::yes; }
  /// With a gyro only: the robot should stand to measure the bias.
  bool wants_rest() const noexcept { return heading_->wants_rest(); }
  GyroBias& gyro_bias() noexcept { return heading_->bias(); }

 private:
  bool has_bound() const noexcept { return kGyroBuilt && estimate_.sigma_known; }
  void advance(const Step& step) noexcept;
  void advance_bound(Duration since) noexcept;
  bool learn_bias() noexcept;
  bool turn_as_taught() noexcept;
  Pose ahead_by(const PoseBound::Correction& by) const noexcept;
  void restart_bound(const PoseSigma& sigma) noexcept;
  void teach(Angle fix, Angle sigma) noexcept;
  void tie(const Pose& pose) noexcept;

  const Params& params_;
  Estimate& estimate_;
  Health& health_;
  CountStep counts_;
  Frame frame_;
  Odometry odometry_;
  Part<GyroHeading, kGyroBuilt> heading_;
  Part<PoseBound, kGyroBuilt> bound_;
  Part<FixTeacher, kGyroBuilt> teacher_;
};

}  // namespace whisker::localization
