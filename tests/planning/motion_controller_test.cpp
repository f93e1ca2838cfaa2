#include "firmware/planning/motion_controller.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/wheel_kinematics.hpp"

namespace whisker::planning {
namespace {

/// Wheels with a first-order lag and encoders, to close the loop around the controller.
class Loop {
 public:
  explicit Loop(const Params& params) : params_(params) {
    odometry_.configure(params);
    controller_.configure(params);
    odometry_.place({});
    tick(false);
  }
  void begin(const Manoeuvre& m) { controller_.begin(m, odometry_.pose()); }
  void tick(bool paused) {
    const double counts = params_.wheels.counts_per_metre;
    localization::CountStep step;
    const auto count = [&](double way) {
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(way * counts)) & 0xFFFFFF);
    };
    odometry_.update({count(way_[0]), count(way_[1])}, params_.safety.period, step);
    const WheelPair before = speeds_;
    const Duration period = params_.safety.period;
    const Speed most = params_.wheels.max_acceleration * period;
    const VelocityRequest r =
        paused ? VelocityRequest{} : controller_.request(odometry_.pose(), period, held_for_, params_);
    const Speed fastest = params_.wheels.max_speed;
    speeds_ = slew(speeds_, inverse_kinematics(r.forward, r.turning, fastest), most);
    controller_.settle(&step, speeds_.left != Speed{} || speeds_.right != Speed{}, period, params_);
    EXPECT_LE(abs(speeds_.left - before.left), most);
    EXPECT_LE(abs(speeds_.right - before.right), most);
    EXPECT_LE(abs(speeds_.left), params_.wheels.max_speed);
    EXPECT_LE(abs(speeds_.right), params_.wheels.max_speed);
    const double want[2] = {speeds_.left.raw() * 1e-6, speeds_.right.raw() * 1e-6};
    for (int sub = 0; sub < 10; ++sub) {
      for (int w = 0; w < 2; ++w) {
        v_[w] += (want[w] - v_[w]) * 0.001 / 0.05;
        if (!blocked_) way_[w] += v_[w] * 0.001;
      }
    }
  }
  int run(int limit = 3000) {
    int ticks = 0;
    do tick(false);
    while (!controller_.settled() && ++ticks < limit);
    return ticks;
  }
  void block() { blocked_ = true; }
  void hold(Duration held_for) { held_for_ = held_for; }
  Pose pose() const { return odometry_.pose(); }
  const MotionController& controller() const { return controller_; }
  WheelPair speeds() const { return speeds_; }

 private:
  const Params& params_;
  localization::Odometry odometry_;
  MotionController controller_;
  WheelPair speeds_;
  Duration held_for_;
  double way_[2] = {0, 0};
  double v_[2] = {0, 0};
  bool blocked_ = false;
};

double degrees(Angle a) { return a.wrapped() * (180.0 / 2147483648.0); }

TEST(MotionController, TurnsTheShorterWayAndStopsWithinToleranceAtEveryAngle) {
  const Params params;
  double worst = 0;
  for (int deg = -179; deg <= 179; ++deg) {
    Loop loop(params);
    loop.begin({ManoeuvreKind::turn, Angle::turns(deg, 360), {}});
    ASSERT_LT(loop.run(), 300) << deg;
    worst = std::fmax(worst, std::fabs(degrees(loop.pose().heading - Angle::turns(deg, 360))));
    ASSERT_LT(std::abs(loop.pose().at.x.raw()) + std::abs(loop.pose().at.y.raw()), 1500) << deg;
  }
  std::printf("turns: worst error %.2f degrees\n", worst);
  EXPECT_LE(worst, 1.1);
}

TEST(MotionController, DrivesEveryLengthAndStopsWithinTolerance) {
  const Params params;
  double worst = 0;
  double aside = 0;
  for (int mm = 5; mm <= 1500; mm += 13) {
    Loop loop(params);
    loop.begin({ManoeuvreKind::drive, {}, millimetres(mm)});
    ASSERT_LT(loop.run(), 1000) << mm;
    worst = std::fmax(worst, std::fabs(loop.pose().at.x.raw() * 1e-3 - mm));
    aside = std::fmax(aside, std::fabs(loop.pose().at.y.raw() * 1e-3));
  }
  std::printf("drives: worst error %.2f mm ahead, %.2f mm aside\n", worst, aside);
  EXPECT_LE(worst, 2.5);
  EXPECT_LE(aside, 1.0);
}

TEST(MotionController, HoldsTheHeadingThatItWasGiven) {
  const Params params;
  Loop loop(params);
  loop.begin({ManoeuvreKind::drive, Angle::turns(4, 360), 1_m});
  loop.run();
  EXPECT_NEAR(degrees(loop.pose().heading), 4, 1.0);
}

TEST(MotionController, AStopOnTheMoveBrakesAndSettles) {
  const Params params;
  Loop loop(params);
  loop.begin({ManoeuvreKind::drive, {}, 1_m});
  for (int i = 0; i < 100; ++i) loop.tick(false);
  const Length before = loop.pose().at.x;
  EXPECT_FALSE(loop.controller().settled());
  loop.begin({ManoeuvreKind::stop, {}, {}});
  EXPECT_LT(loop.run(), 80);
  EXPECT_LT(loop.pose().at.x - before, 66_mm);  // 0.30 m/s: 45 mm of braking, 15 mm of lag, one tick
}

TEST(MotionController, APausedDriveIsTakenUpAgainAndEndsAtTheSamePlace) {
  const Params params;
  Loop loop(params);
  loop.begin({ManoeuvreKind::drive, {}, 500_mm});
  for (int i = 0; i < 60; ++i) loop.tick(false);
  for (int i = 0; i < 100; ++i) loop.tick(true);
  EXPECT_EQ(loop.speeds().left, Speed{});
  EXPECT_FALSE(loop.controller().settled());
  loop.run();
  EXPECT_NEAR(loop.pose().at.x.raw() * 1e-3, 500, 2.5);
}

TEST(MotionController, KeepChangesNothing) {
  const Params params;
  Loop loop(params);
  loop.begin({ManoeuvreKind::drive, {}, 300_mm});
  for (int i = 0; i < 20; ++i) loop.tick(false);
  loop.begin({});
  loop.run();
  EXPECT_NEAR(loop.pose().at.x.raw() * 1e-3, 300, 2.5);
}

TEST(MotionController, ADriveThatTheGuardHoldsIsCut) {
  const Params params;
  Loop loop(params);
  loop.begin({ManoeuvreKind::drive, {}, 300_mm});
  loop.hold(200_ms);
  for (int i = 0; i < 20; ++i) loop.tick(false);
  EXPECT_FALSE(loop.controller().cut());
  EXPECT_GT(loop.speeds().left, Speed{});
  loop.hold(201_ms);
  loop.run();
  EXPECT_TRUE(loop.controller().cut());
  EXPECT_LT(loop.pose().at.x, 100_mm);
  loop.begin({ManoeuvreKind::turn, 90_deg, {}});
  EXPECT_FALSE(loop.controller().cut());
  loop.run();
  EXPECT_NEAR(degrees(loop.pose().heading), 90, 1.1) << "a turn is not cut";
}

TEST(MotionController, ADriveThatComesNoNearerIsCut) {
  const Params params;
  Loop loop(params);
  loop.begin({ManoeuvreKind::drive, {}, 300_mm});
  loop.block();
  const int patience = derived::stalled_after(params).raw() / params.safety.period.raw();
  for (int i = 0; i < patience; ++i) loop.tick(false);
  EXPECT_FALSE(loop.controller().cut());
  loop.run(100);
  EXPECT_TRUE(loop.controller().cut());
}

}  // namespace
}  // namespace whisker::planning
