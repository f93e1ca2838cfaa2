#include "firmware/localization/pose_bound.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace whisker::localization::pose_bound_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180;
constexpr double kTick_s = 0.01;

struct Errors {
  double left = 0, right = 0;  // of the counts, relative
  double gyro_scale = 0;
  double bias = 0;     // rad/s
  double warm_up = 0;  // rad/s in ten minutes
};

/// Speed in m/s and turn rate in rad/s at a time in s.
struct Velocity {
  double forward, turning;
};
Velocity course(double t_s) {
  const double phase = std::fmod(t_s, 12);
  if (phase < 5) return {0.3, 0};
  if (phase < 6) return {0, kPi / 2};
  if (phase < 9) return {0.25, -0.5};
  return {0.2, t_s < 24 ? 0.4 : 0};
}

/// A drive with these errors: odometry and bound see the counts, and the gyro if there is one.
class Drive {
 public:
  Drive(const Params& params, bool gyro) : params_(params), gyro_(gyro) {
    odometry_.configure(params);
    odometry_.place({});
    bound_.configure(params);
    bound_.restart({}, {});
    GyroBias bias;
    if (gyro) bound_.rest({0, 0, GyroBias::kFirstRest, true}, params, bias);
  }

  void go(double seconds, const Errors& errors, double walk_per_sqrt_s, double drift_per_sqrt_m,
          std::mt19937& random) {
    std::normal_distribution<double> normal;
    for (double t = 0; t < seconds; t += kTick_s) {
      const Velocity v = course(t);
      const double turn = v.turning * kTick_s, way = v.forward * kTick_s;
      x_ += way * std::cos(heading_ + turn / 2);
      y_ += way * std::sin(heading_ + turn / 2);
      heading_ += turn;
      const double half = 0.5 * params_.body.track.raw() * 1e-6;
      const double drift = drift_per_sqrt_m * std::sqrt(way) * normal(random) * half;
      left_ += (way - half * turn) * (1 + errors.left) - drift;
      right_ += (way + half * turn) * (1 + errors.right) + drift;
      CountStep step;
      EXPECT_TRUE(odometry_.take({count(left_), count(right_)}, 10_ms, step));
      if (gyro_) {
        const double bias = errors.bias + errors.warm_up * t / 600;
        const double read = turn * (1 + errors.gyro_scale) + bias * kTick_s +
                            walk_per_sqrt_s * std::sqrt(kTick_s) * normal(random);
        by_gyro_ += read;
        odometry_.advance(step, angle(by_gyro_) - odometry_.pose().heading);
      } else {
        odometry_.advance(step);
      }
      bound_.step({odometry_.pose(), step, 10_ms, gyro_});
    }
  }

  struct Off {
    double along, across, heading;
  };
  Off off() const {
    const Pose pose = odometry_.pose();
    const double x = pose.at.x.raw() * 1e-6 - x_, y = pose.at.y.raw() * 1e-6 - y_;
    const double c = std::cos(heading_), s = std::sin(heading_);
    return {x * c + y * s, y * c - x * s, radians(pose.heading - angle(heading_))};
  }
  PoseSigma sigma() const { return bound_.sigma(); }
  /// The gyro is at rest, and this rate (rad/s) is measured.
  PoseBound::Correction rest(double rate) {
    GyroBias bias;
    const auto off = static_cast<int32_t>(std::lround(rate * 16777216));
    return bound_.rest({0, off, 1000_ms, false}, params_, bias);
  }
  static double radians(Angle a) { return a.wrapped() * (kPi / 2147483648.0); }

 private:
  static Angle angle(double rad) {
    return Angle::from_raw(
        static_cast<uint32_t>(std::llround(std::remainder(rad, 2 * kPi) * 2147483648.0 / kPi)));
  }
  uint32_t count(double metres) const {
    const auto counts = static_cast<int64_t>(std::floor(metres * params_.wheels.counts_per_metre));
    return static_cast<uint32_t>(counts) & (hal::kEncoderModulus - 1);
  }

  const Params& params_;
  const bool gyro_;
  double x_ = 0, y_ = 0, heading_ = 0, by_gyro_ = 0;
  double left_ = 0, right_ = 0;
  Odometry odometry_;
  PoseBound bound_;
};

/// Compares the sigmas of a drive without errors with the root mean square of the errors of many drives.
void expect_calibrated(const Params& params, bool gyro, double seconds) {
  const PoseErrorParams& e = params.pose_error;
  const double each = e.wheel_scale.raw() * 1e-6, both = e.wheel_scale_common.raw() * 1e-6;
  const double walk = Drive::radians(e.gyro_walk) / 60, drift = Drive::radians(e.heading_drift);
  std::mt19937 random(5);
  Drive nominal(params, gyro);
  nominal.go(seconds, {}, 0, 0, random);
  const PoseSigma sigma = nominal.sigma();

  std::normal_distribution<double> normal;
  Drive::Off sum{};
  constexpr int kDrives = 300;
  for (int i = 0; i < kDrives; ++i) {
    const double common = both * normal(random);
    const Errors errors{each * normal(random) + common, each * normal(random) + common,
                        e.gyro_scale.raw() * 1e-6 * normal(random), walk / std::sqrt(2.0) * normal(random),
                        Drive::radians(e.gyro_warm_up) * normal(random)};
    Drive drive(params, gyro);
    drive.go(seconds, errors, walk, drift, random);
    const Drive::Off off = drive.off();
    sum.along += off.along * off.along;
    sum.across += off.across * off.across;
    sum.heading += off.heading * off.heading;
  }
  const auto rms = [](double squares) { return std::sqrt(squares / kDrives); };
  const double slack = 0.12;  // three standard errors of a root mean square of 300
  const double floor_m = 0.004;
  EXPECT_NEAR(sigma.along.raw() * 1e-6, rms(sum.along), floor_m + slack * rms(sum.along));
  EXPECT_NEAR(sigma.across.raw() * 1e-6, rms(sum.across), floor_m + slack * rms(sum.across));
  EXPECT_NEAR(Drive::radians(sigma.heading), rms(sum.heading), 0.0005 + slack * rms(sum.heading));
}

Angle degrees(double deg) {
  return Angle::from_raw(static_cast<uint32_t>(std::llround(deg / 360 * 4294967296.0)));
}

TEST(PoseBound, WheelsThatDiffer) {
  Params params;
  params.pose_error.wheel_scale = millionths(5000);
  expect_calibrated(params, false, 20);
}

TEST(PoseBound, WheelsWithACommonError) {
  Params params;
  params.pose_error.wheel_scale_common = millionths(20000);
  expect_calibrated(params, false, 40);
}

TEST(PoseBound, AHeadingThatDrifts) {
  Params params;
  params.pose_error.heading_drift = degrees(1);
  expect_calibrated(params, false, 40);
}

TEST(PoseBound, EverythingThatAGyroGetsWrong) {
  Params params;
  params.pose_error.wheel_scale = millionths(1000);
  params.pose_error.wheel_scale_common = millionths(3000);
  params.pose_error.gyro_scale = millionths(10000);
  params.pose_error.gyro_walk = degrees(1);
  params.pose_error.gyro_warm_up = degrees(0.5);
  expect_calibrated(params, true, 60);
}

TEST(PoseBound, TheWalkOfAGyro) {
  Params params;
  params.pose_error.wheel_scale_common = millionths(1);
  params.pose_error.gyro_scale = Ratio{};
  params.pose_error.gyro_walk = degrees(4);
  params.pose_error.gyro_warm_up = Angle{};
  expect_calibrated(params, true, 60);
}

TEST(PoseBound, ARestCorrectsWhatTheBiasHasDoneToThePose) {
  Params params;
  params.pose_error.wheel_scale_common = millionths(1);
  params.pose_error.gyro_scale = millionths(1);
  params.pose_error.gyro_walk = degrees(0.05);
  Errors errors;
  errors.warm_up = 0.15 * kDegree;
  std::mt19937 random(7);
  for (const double seconds : {20.0, 60.0, 120.0}) {
    Drive drive(params, true);
    drive.go(seconds, errors, 0, 0, random);
    const Drive::Off off = drive.off();
    const PoseSigma before = drive.sigma();
    const PoseBound::Correction by = drive.rest(errors.warm_up * seconds / 600);
    EXPECT_NEAR(Drive::radians(by.turn), -off.heading, 0.1 * std::fabs(off.heading) + 0.0001) << seconds;
    const double place = std::hypot(off.along, off.across);
    EXPECT_NEAR(norm(by.shift).raw() * 1e-6, place, 0.2 * place + 0.004) << seconds;
    EXPECT_LT(drive.sigma().heading.raw(), before.heading.raw() / 2) << seconds;
  }
}

/// Sigmas saturate if a covariance of the bias does, and the rest then takes too much of them.
TEST(PoseBound, ARestLeavesASigmaWhateverTheGyro) {
  std::mt19937 random(11);
  for (const double walk : {0.0, 0.05, 0.4, 10.0})
    for (const double warm_up : {0.0, 0.1, 1.0})
      for (const int32_t range : {1000000, 8726646, 40000000})
        for (const int32_t rate : {20, 100, 1000}) {
          SCOPED_TRACE(testing::Message() << walk << ' ' << warm_up << ' ' << range << ' ' << rate);
          Params params;
          params.pose_error.wheel_scale_common = millionths(1000);
          params.pose_error.gyro_scale = millionths(1);
          params.pose_error.gyro_walk = degrees(walk);
          params.pose_error.gyro_warm_up = degrees(warm_up);
          params.gyro.range = AngularRate::from_raw(range);
          params.gyro.rate_hz = rate;
          Drive drive(params, true);
          drive.go(90, {}, 0, 0, random);
          const PoseSigma before = drive.sigma();
          drive.rest(0);
          const PoseSigma after = drive.sigma();
          EXPECT_GT(after.along.raw(), 2900);
          EXPECT_GT(after.across.raw(), 2900);
          EXPECT_GT(after.heading.raw(), 0u);
          EXPECT_LE(after.along.raw(), before.along.raw() * 1.001);
          EXPECT_LE(after.across.raw(), before.across.raw() * 1.001);
          EXPECT_LE(after.heading.raw(), before.heading.raw());
        }
}

TEST(PoseBound, IsUnknownUnlessAnErrorOfTheWheelsIsDeclared) {
  Params params;
  PoseBound bound;
  bound.configure(params);
  EXPECT_FALSE(bound.known());
  params.pose_error.wheel_scale_common = millionths(1);
  bound.configure(params);
  EXPECT_TRUE(bound.known());
}

TEST(PoseBound, RestartsWithTheGivenSigmaWhateverTheHeading) {
  PoseBound bound;
  bound.configure(Params{});
  for (const double deg : {0.0, 30.0, 90.0, 200.0, 345.0}) {
    bound.restart({{}, degrees(deg)}, {200_mm, 50_mm, 3_deg});
    const PoseSigma sigma = bound.sigma();
    EXPECT_NEAR(sigma.along.raw(), 200000, 300) << deg;
    EXPECT_NEAR(sigma.across.raw(), 50000, 1500) << deg;
    EXPECT_NEAR(Drive::radians(sigma.heading), 3 * kDegree, 1e-5) << deg;
  }
}

TEST(PoseBound, SaturatesInsteadOfWrapping) {
  Params params;
  params.pose_error = {millionths(100000), millionths(100000), 5_deg, millionths(100000), 10_deg, 1_deg};
  for (const bool gyro : {false, true}) {
    std::mt19937 random(1);
    Drive drive(params, gyro);
    Length before;
    for (int i = 0; i < 20; ++i) {
      drive.go(240, {}, 0, 0, random);
      const PoseSigma sigma = drive.sigma();
      EXPECT_LE(sigma.along, PoseBound::kMost);
      EXPECT_LE(sigma.across, PoseBound::kMost);
      EXPECT_GT(sigma.across, 10_mm);
      EXPECT_GT(sigma.along, 10_mm);
      EXPECT_LE(sigma.heading.wrapped(), (90_deg).wrapped());
      EXPECT_GT(distance_bound(sigma), i == 0 ? 1_m : before / 4);
      before = distance_bound(sigma);
    }
  }
}

TEST(PoseBound, TheDistanceIsTwiceTheRootMeanSquare) {
  EXPECT_EQ(distance_bound({30_mm, 40_mm, 1_deg}), 100_mm);
}

/// One metre straight ahead, with wheels that are almost perfect, from a heading that is known within a
/// degree.
PoseBound after_a_metre() {
  Params params;
  params.pose_error.wheel_scale_common = millionths(1);
  PoseBound bound;
  bound.configure(params);
  bound.restart({}, {{}, {}, degrees(1)});
  for (int i = 1; i <= 200; ++i) bound.step({{{millimetres(5 * i), {}}, {}}, {10, 10}, 10_ms, false});
  return bound;
}

TEST(PoseBound, AMeasuredHeadingCorrectsThePlaceThatItHasMoved) {
  PoseBound bound = after_a_metre();
  ASSERT_NEAR(bound.sigma().across.raw(), 17700, 200);
  PoseBound::Correction by;
  ASSERT_TRUE(bound.correct_heading(degrees(2), degrees(0.1), by));
  // The measurement has a weight of 1 / (1 + 0.01), and a degree moves the place by 17.45 mm.
  EXPECT_NEAR(Drive::radians(by.turn) / kDegree, 2 / 1.01, 0.001);
  EXPECT_NEAR(by.shift.x.raw(), 0, 2);
  EXPECT_NEAR(by.shift.y.raw(), 2 * 17453 / 1.01, 40);
  const PoseSigma sigma = bound.sigma();
  EXPECT_NEAR(Drive::radians(sigma.heading) / kDegree, 0.0995, 0.001);
  // 17.45 mm of the 0.0995 degrees that remain, and the floor of 3 mm.
  EXPECT_NEAR(sigma.across.raw(), std::hypot(17453 * 0.0995, 3000), 50);
}

TEST(PoseBound, AHeadingMeasuredAgainCorrectsLittleMore) {
  PoseBound bound = after_a_metre();
  PoseBound::Correction by;
  ASSERT_TRUE(bound.correct_heading(degrees(1), degrees(0.1), by));
  ASSERT_TRUE(bound.correct_heading(degrees(0.01), degrees(0.1), by));
  EXPECT_LT(by.shift.y.raw(), 100);
}

TEST(PoseBound, AHeadingThatIsTooFarOffChangesNothing) {
  PoseBound bound = after_a_metre();
  const PoseSigma before = bound.sigma();
  PoseBound::Correction by;
  EXPECT_FALSE(bound.correct_heading(degrees(4.1), degrees(0.1), by));
  EXPECT_EQ(bound.sigma().across, before.across);
  EXPECT_EQ(bound.sigma().heading.raw(), before.heading.raw());
  EXPECT_TRUE(bound.correct_heading(degrees(-3.9), degrees(0.1), by));
}

}  // namespace
}  // namespace whisker::localization::pose_bound_test
