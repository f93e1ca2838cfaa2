#include "firmware/localization/fix_teacher.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace whisker::localization::fix_teacher_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Angle angle(double rad) {
  return Angle::from_raw(
      static_cast<uint32_t>(std::llround(std::remainder(rad, 2 * kPi) * 2147483648.0 / kPi)));
}
double radians(Angle a) { return a.wrapped() * (kPi / 2147483648.0); }

/// Straight ahead on wheels of which the counts of the right one are `skew` too many, after a first exact
/// fix.
class Straight {
 public:
  Straight(double skew, const Params& params) : skew_(skew) {
    odometry_.configure(params);
    odometry_.place({});
    teacher_.configure(params, odometry_);
    EXPECT_FALSE(teacher_.fix({}, {}));
    CountStep step;
    odometry_.take({0, 0}, 10_ms, step);
  }
  void drive(double metres) {
    for (const double end = way_ + metres; way_ < end; way_ += 0.003) {
      CountStep step;
      EXPECT_TRUE(odometry_.take({count(way_), count(way_ * (1 + skew_))}, 10_ms, step));
      odometry_.advance(step);
      ahead_ += teacher_.pass(step, odometry_);
    }
  }
  bool fix(double error, double sigma) {
    return teacher_.fix(angle(error) - odometry_.pose().heading, angle(sigma));
  }
  void restart() { teacher_.restart(); }
  /// In the user's frame.
  double heading() const { return radians(odometry_.pose().heading + ahead_); }
  const FixTeacher& teacher() const { return teacher_; }

 private:
  static uint32_t count(double metres) {
    return static_cast<uint32_t>(metres * 5000) & (hal::kEncoderModulus - 1);
  }
  const double skew_;
  double way_ = 0;
  Odometry odometry_;
  FixTeacher teacher_;
  Angle ahead_;
};

Params declared(int32_t ppm) {
  Params p;
  p.pose_error.wheel_scale = millionths(ppm);
  return p;
}

TEST(FixTeacher, TheHeadingsOfFixesTeachTheDifferenceOfTheWheels) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const double sigma = kPi / 180;
  double before = 0, after = 0;
  for (int robot = 0; robot < 40; ++robot) {
    Straight wheels(0.007 * normal(random), declared(5000));
    wheels.drive(2);
    before += std::pow(wheels.heading(), 2);
    for (int i = 0; i < 5; ++i) {
      EXPECT_TRUE(wheels.fix(sigma * normal(random), sigma));
      wheels.drive(2);
    }
    const double from = wheels.heading();
    wheels.drive(2);
    after += std::pow(wheels.heading() - from, 2);
  }
  EXPECT_LT(std::sqrt(after), std::sqrt(before) / 8);
}

TEST(FixTeacher, ClaimsToKnowNoMoreThanItKnows) {
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  const double sigma = kPi / 180;
  double squares = 0, claimed = 0;
  constexpr int kRobots = 60;
  for (int robot = 0; robot < kRobots; ++robot) {
    Straight wheels(0.007 * normal(random), declared(5000));
    for (int i = 0; i < 3; ++i) {
      wheels.drive(2);
      wheels.fix(sigma * normal(random), sigma);
    }
    const double from = wheels.heading();
    wheels.drive(2);
    squares += std::pow((wheels.heading() - from) / (2 * 2 / 0.14), 2);
    claimed = wheels.teacher().gains().skew_sigma().raw() * 1e-6;
  }
  const double ratio = std::sqrt(squares / kRobots) / claimed;
  EXPECT_GT(ratio, 0.35) << "the errors of successive stretches partly cancel, which it does not count on";
  EXPECT_LT(ratio, 1.1);
}

TEST(FixTeacher, GoodWheelsAreNotSpoiledByRoughFixes) {
  std::mt19937 random(13);
  std::normal_distribution<double> normal;
  const double sigma = kPi / 36;
  Straight wheels(0, declared(200));
  for (int i = 0; i < 5; ++i) {
    wheels.drive(2);
    wheels.fix(sigma * normal(random), sigma);
  }
  const double from = wheels.heading();
  wheels.drive(2);
  EXPECT_NEAR(wheels.heading(), from, 0.004);
}

TEST(FixTeacher, FixesCloseTogetherTeachNothingUntilTheWayIsLongEnough) {
  Straight wheels(0.005, declared(5000));
  wheels.drive(0.2);
  EXPECT_FALSE(wheels.fix(0, 0.01));
  wheels.drive(0.2);
  EXPECT_TRUE(wheels.fix(0, 0.01));
}

TEST(FixTeacher, TheFirstFixAfterARestartIsNoLesson) {
  Straight wheels(0.005, declared(5000));
  wheels.drive(2);
  wheels.restart();
  EXPECT_FALSE(wheels.fix(0.1, 0.01)) << "a place that was set wrong";
  wheels.drive(2);
  EXPECT_TRUE(wheels.fix(0.1, 0.01));
  const double from = wheels.heading();
  wheels.drive(2);
  EXPECT_NEAR(wheels.heading(), from, 0.005) << "71 mrad untaught";
}

TEST(FixTeacher, WithoutADeclaredErrorThereIsNoLesson) {
  Straight wheels(0.005, Params{});
  wheels.drive(2);
  EXPECT_FALSE(wheels.fix(0, 0.01));
  wheels.drive(2);
  EXPECT_NEAR(wheels.heading(), 4 * 0.005 / 0.14, 0.003);
}

TEST(FixTeacher, LiesTeachNoMoreThanThreeDeclaredSigmas) {
  Straight wheels(0, declared(1000));
  for (double lie = 0; lie < 6; lie += 0.05) {
    wheels.drive(2);
    wheels.fix(lie, 0.01);
  }
  const double from = wheels.heading();
  wheels.drive(2);
  const double most = 3 * 0.000707 * 2 * 2 / 0.14;
  EXPECT_GT(wheels.heading() - from, 0.5 * most);
  EXPECT_LT(wheels.heading() - from, 1.02 * most);
}

TEST(FixTeacher, ExactFixesOfExactWheelsDivideByNothing) {
  Params common;
  common.pose_error.wheel_scale_common = millionths(10000);
  for (const Params& params : {declared(1), declared(10), common}) {
    Straight wheels(0, params);
    for (int i = 0; i < 3; ++i) {
      wheels.drive(1);
      EXPECT_TRUE(wheels.fix(0, 0));
    }
    EXPECT_NEAR(wheels.heading(), 0, 1e-4);
  }
}

TEST(FixTeacher, AJumpOfTheHeadingTeachesNothing) {
  Straight wheels(0, declared(5000));
  wheels.drive(2);
  wheels.fix(1.5, 0.01);
  const double from = wheels.heading();
  wheels.drive(2);
  EXPECT_NEAR(wheels.heading(), from, 0.002);
}

}  // namespace
}  // namespace whisker::localization::fix_teacher_test
