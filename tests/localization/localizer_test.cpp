// What is told from outside, and the frame in which ground was seen.
#include "firmware/localization/localizer.hpp"

#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace whisker::localization::localizer_test {
namespace {

/// Turns and straight ways at random, for any number of localizers.
class Wheels {
 public:
  explicit Wheels(unsigned seed) : random_(seed) {}
  hal::EncoderCounts next() {
    if (left_for_ == 0) {
      left_for_ = pick(20, 400);
      const int forward = pick(-1, 1) * 10;
      const int turning = pick(0, 1) * pick(-6, 6);
      step_[0] = forward - turning;
      step_[1] = forward + turning;
    }
    --left_for_;
    for (int i = 0; i < 2; ++i) {
      counts_[i] = (counts_[i] + static_cast<std::uint32_t>(step_[i])) % hal::kEncoderModulus;
    }
    return {counts_[0], counts_[1]};
  }
  bool drives() const { return step_[0] != 0 || step_[1] != 0; }
  int turning() const { return step_[1] - step_[0]; }
  int pick(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }

 private:
  std::mt19937 random_;
  int left_for_ = 0;
  int step_[2] = {};
  std::uint32_t counts_[2] = {};
};

struct Rig {
  explicit Rig(const Params& p) : params(p), localizer(params, estimate, health) {
    localizer.configure();
    localizer.put_down({});
  }
  const Params params;
  Estimate estimate;
  Health health;
  Localizer localizer;
};

/// Anything that may be told of the pose, true or not.
void tell(Rig& rig, Wheels& any) {
  const Pose at{{millimetres(any.pick(-3000, 3000)), millimetres(any.pick(-3000, 3000))},
                Angle::turns(any.pick(0, 359), 360)};
  const Pose near{rig.estimate.pose.at, rig.estimate.pose.heading + Angle::turns(any.pick(-8, 8), 360)};
  const Angle sigma = Angle::turns(any.pick(0, 3), 720);
  switch (any.pick(0, 4)) {
    case 0: rig.localizer.correct(at, {30_mm, 30_mm, sigma}); break;
    case 1: rig.localizer.correct(near, {30_mm, 30_mm, sigma}); break;
    case 2: rig.localizer.correct(near, {}); break;
    case 3: rig.localizer.move(any.pick(0, 1) == 0 ? at : near); break;
    default:
      if (!rig.estimate.sigma_known) break;
      rig.localizer.correct_heading(Angle::turns(any.pick(-15, 15), 720), Angle::turns(1, 720));
  }
}

Params declared(std::int32_t each, std::int32_t common) {
  Params p;
  p.pose_error.wheel_scale = millionths(each);
  p.pose_error.wheel_scale_common = millionths(common);
  return p;
}

Params with_gyro(Params params) {
  params.gyro.fitted = Fitted::yes;
  return params;
}

TEST(Localizer, NothingThatIsToldMovesTheOdometryFrame) {
  for (const Params& params : {Params{}, declared(5000, 0), declared(0, 20000), declared(100000, 100000),
                               with_gyro(Params{}), with_gyro(declared(5000, 1000))}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Rig plain{params}, told{params};
      Wheels wheels{seed}, any{seed + 100};
      hal::GyroReading gyro{};
      for (int tick = 0; tick < 6000; ++tick) {
        Localizer::Step step;
        step.counts = wheels.next();
        step.since = 10_ms;
        step.commanded = wheels.drives();
        // A bias, and some noise; it is silent at times.
        gyro.sum += static_cast<std::uint32_t>(wheels.turning() * 200 + 70 + wheels.pick(-3, 3));
        ++gyro.samples;
        if (tick % 1000 < 900) step.gyro = &gyro;
        plain.localizer.step(step);
        told.localizer.step(step);
        ASSERT_EQ(told.localizer.inside().at, plain.localizer.inside().at) << tick;
        ASSERT_EQ(told.localizer.inside().heading, plain.localizer.inside().heading) << tick;
        ASSERT_EQ(told.localizer.travelled_um(), plain.localizer.travelled_um()) << tick;
        if (any.pick(0, 60) == 0) tell(told, any);
      }
      EXPECT_NE(told.estimate.pose.heading, plain.estimate.pose.heading);
    }
  }
}

/// On wheels of which the right one counts 1 % too many, straight ahead by the true heading 0, with exact
/// fixes.
class Skewed {
 public:
  explicit Skewed(const Params& params) : rig(params) {}
  void drive(double metres) {
    for (const double end = way_ + metres; way_ < end; way_ += 0.003) {
      Localizer::Step step;
      step.counts = {static_cast<std::uint32_t>(way_ * 5000), static_cast<std::uint32_t>(way_ * 5050)};
      step.since = 10_ms;
      rig.localizer.step(step);
    }
  }
  void fix() {
    rig.localizer.correct({{millimetres(static_cast<std::int32_t>(way_ * 1000)), 0_mm}, 0_deg}, kFix);
  }
  double heading_deg() const { return rig.estimate.pose.heading.wrapped() * (360 / 4294967296.0); }
  Rig rig;

 private:
  static constexpr PoseSigma kFix{3_mm, 3_mm, Angle::turns(1, 7200)};
  double way_ = 0;
};

TEST(Localizer, FixesTeachTheUsersFrameHowTheWheelsTurnTheBody) {
  Skewed robot{declared(10000, 0)};
  robot.drive(1);
  robot.fix();
  robot.drive(1);
  EXPECT_GT(robot.heading_deg(), 3.5) << "the first fix is only the one to compare with";
  robot.fix();
  robot.drive(1);
  EXPECT_LT(robot.heading_deg(), 0.5);
}

TEST(Localizer, WheelsThatDeclareNoErrorAreNotTaught) {
  Skewed robot{Params{}};
  for (int i = 0; i < 3; ++i) {
    robot.fix();
    robot.drive(1);
  }
  EXPECT_NEAR(robot.heading_deg(), 360 * 0.01 / 0.14 / 6.2832, 0.1);
}

TEST(Localizer, WhatIsLearnedStaysWithinThreeDeclaredSigmas) {
  // 3.7 of them.
  Skewed robot{declared(1900, 0)};
  for (int i = 0; i < 20; ++i) {
    robot.fix();
    robot.drive(1);
  }
  const double rest = 360 * (0.01 - 2 * 3 * 0.0019 * 0.7071) / 0.14 / 6.2832;
  EXPECT_NEAR(robot.heading_deg(), rest, 0.2);
}

TEST(Localizer, APlaceUnderWayAndAResetMakeTheNextFixTheFirst) {
  for (int how = 0; how < 3; ++how) {
    Skewed robot{declared(10000, 0)};
    robot.fix();
    robot.drive(1);
    if (how == 0) robot.rig.localizer.move({{}, 10_deg});
    if (how == 1) robot.rig.localizer.restart_lessons();
    if (how == 2) robot.rig.localizer.put_down({{}, 10_deg});
    robot.fix();
    const double fixed = robot.heading_deg();
    robot.drive(1);
    EXPECT_GT(robot.heading_deg() - fixed, 3.5) << how;
  }
}

TEST(Localizer, NeitherTheLargestNorTheLeastOfWhatIsAcceptedBreaksTheArithmetic) {
  for (const std::int32_t counts : {100, 5000, 400000, 1000000}) {
    for (const Length track : {20_mm, 140_mm, 2000_mm}) {
      for (const std::int32_t each : {0, 1, 10, 100000}) {
        Params params = declared(each, each);
        params.wheels.counts_per_metre = counts;
        params.body.track = track;
        params.pose_error.heading_drift = 5_deg;
        Rig rig{params};
        Wheels wheels{7};
        std::uint32_t left = 0, right = 0;
        for (int tick = 0; tick < 2000; ++tick) {
          left += static_cast<std::uint32_t>(counts / 1000);
          right += static_cast<std::uint32_t>(counts / 1000 + wheels.pick(-1, 1) * counts / 2000);
          Localizer::Step step;
          step.counts = {left % hal::kEncoderModulus, right % hal::kEncoderModulus};
          step.since = 10_ms;
          rig.localizer.step(step);
          if (tick % 97 == 0) {
            const Length size = Length::from_raw(tick % 2 == 0 ? 0 : tick % 3 == 0 ? INT32_MIN : INT32_MAX);
            const Angle heading = Angle::from_raw(static_cast<std::uint32_t>(tick % 5) << 30);
            rig.localizer.correct({{1000_m, -1000_m}, heading}, {size, size, heading});
          }
          if (tick % 331 == 0 && rig.estimate.sigma_known) rig.localizer.correct_heading(15_deg, 1_deg);
          ASSERT_LE(rig.estimate.sigma.along, PoseBound::kMost);
          ASSERT_GE(rig.estimate.sigma.along, Length{});
        }
      }
    }
  }
}

}  // namespace
}  // namespace whisker::localization::localizer_test
