#include "host/harness/sim/plant.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <vector>

#include "host/harness/sim/distance.hpp"
#include "tests/sim/generators.hpp"

namespace whisker::sim {
namespace {

const double kInfinity = std::numeric_limits<double>::infinity();

void run(Plant& plant, int ticks) {
  for (int i = 0; i < ticks; ++i) plant.advance();
}

hal::WheelSpeeds any_speeds(int most) {
  const int left = *rc::gen::inRange(-most, most + 1), right = *rc::gen::inRange(-most, most + 1);
  return {static_cast<int16_t>(left), static_cast<int16_t>(right)};
}

TEST(Plant, StartsAtRestAtTimeZero) {
  const WorldView nothing;
  const Plant plant(nothing, {}, {}, 1, {{1, 2}, 3});
  EXPECT_EQ(plant.time(), 0);
  EXPECT_EQ(plant.pose().at.x, 1);
  EXPECT_EQ(plant.pose().heading, 3);
  EXPECT_EQ(plant.encoders().left, 0U);
  EXPECT_FALSE(plant.in_contact());
  EXPECT_EQ(plant.contact_time(), -1);
  EXPECT_EQ(plant.min_clearance(), kInfinity);
  EXPECT_EQ(plant.ranges().beam[hal::kFront].status, hal::RangeStatus::stale);
}

TEST(Plant, DrivesALineAsItsWheelsRoll) {
  const WorldView nothing;
  Plant plant(nothing, {}, {}, 1, {{0, 0}, 0.5});
  plant.command({3000, 3000});
  run(plant, 1000);
  // 10 s at 0.3 m/s, minus v^2 / 2a + v * lag for the ramp and the lag: see the wheel's step response.
  const double expected = 0.03125 + 0.3 * 9.75 - 0.0025;
  EXPECT_NEAR(plant.path_length(), expected, 1e-12);
  EXPECT_NEAR(plant.pose().at.x, expected * std::cos(0.5), 1e-12);
  EXPECT_NEAR(plant.pose().at.y, expected * std::sin(0.5), 1e-12);
  EXPECT_EQ(plant.encoders().left, static_cast<uint32_t>(expected * 5000));
  EXPECT_EQ(plant.v_left(), 0.3);
  EXPECT_NEAR(plant.time(), 10, 1e-12);
}

TEST(Plant, CutsACommandToItsGreatestSpeed) {
  const WorldView nothing;
  RobotSpec robot;
  robot.max_speed = 0.25;
  Plant plant(nothing, robot, {}, 1, {});
  plant.command({32767, -32768});
  run(plant, 500);
  EXPECT_EQ(plant.v_left(), 0.25);
  EXPECT_EQ(plant.v_right(), -0.25);
  EXPECT_EQ(plant.path_length(), 0);
}

TEST(Plant, TurnsBeyondAWholeTurnWithoutWrapping) {
  const WorldView nothing;
  Plant plant(nothing, {}, {}, 1, {});
  plant.command({-1400, 1400});
  run(plant, 1000);
  // 2 rad/s; 0.14 m/s: a ramp of 90 ms, then the lag.
  const double rolled = 0.09 * 0.09 / 2 + 0.14 * 9.91 - 0.0025;
  EXPECT_NEAR(plant.pose().heading, 2 * rolled / 0.14, 1e-10);
  EXPECT_NEAR(plant.pose().at.x, 0, 1e-15);
}

TEST(Plant, NeverSlidesSideways) {
  EXPECT_TRUE(rc::check([] {
    const WorldView nothing;
    Plant plant(nothing, {}, {}, 1, {point(3), real(-4, 4)});
    for (int part = 0; part < 5; ++part) {
      plant.command(any_speeds(3000));
      for (int i = 0; i < 20; ++i) {
        const Pose before = plant.pose();
        plant.advance();
        const Vec2 moved = plant.pose().at - before.at;
        const double turn = plant.pose().heading - before.heading;
        const double middle = before.heading + turn / 2;
        // Within a tick the turn rate changes by at most 0.14 rad/s and the speed by at most 0.01 m/s, so the
        // end of the chord deviates less than 1.2 um from the mean heading.
        RC_ASSERT(std::fabs(cross({std::cos(middle), std::sin(middle)}, moved)) <= 1.2e-6);
        RC_ASSERT(std::hypot(moved.x, moved.y) <= 0.003 + 1e-12);
      }
    }
  }));
}

TEST(Plant, OdometryFromItsEncodersFollowsItsPose) {
  EXPECT_TRUE(rc::check([] {
    const WorldView nothing;
    RobotSpec robot;
    robot.counts_per_m = 1e6;
    Plant plant(nothing, robot, {}, 1, {});
    double left = 0, right = 0;
    for (int part = 0; part < 5; ++part) {
      plant.command(any_speeds(1500));
      run(plant, 30);
      const hal::EncoderCounts counts = plant.encoders();
      const auto metres = [](uint32_t count) {
        return (count < hal::kEncoderModulus / 2 ? count : double{1} * count - hal::kEncoderModulus) / 1e6;
      };
      left = metres(counts.left);
      right = metres(counts.right);
      RC_ASSERT(std::fabs((right - left) / robot.track - plant.pose().heading) < 2e-5);
    }
    RC_ASSERT(std::fabs(left + right) / 2 <= plant.path_length() + 2e-6);
  }));
}

TEST(Plant, HeadingDriftMovesTheOdometryAndNotTheBody) {
  const WorldView nothing;
  NoiseSpec noise;
  noise.heading_drift_rad_per_sqrt_m = 0.1;
  noise.wheel_scale_sigma = 0.01;
  Plant drifting(nothing, {}, noise, 5, {}), exact(nothing, {}, {}, 5, {});
  for (Plant* plant : {&drifting, &exact}) {
    plant->command({3000, 2800});
    run(*plant, 500);
  }
  EXPECT_EQ(drifting.pose().at.x, exact.pose().at.x);
  EXPECT_EQ(drifting.pose().heading, exact.pose().heading);
  EXPECT_NE(drifting.encoders().left, exact.encoders().left);
  EXPECT_NE(drifting.encoders().right, exact.encoders().right);
}

TEST(Plant, WheelsSlipOnlyWhileTheySpeedUp) {
  const WorldView nothing;
  NoiseSpec noise;
  noise.wheel_slip = 0.2;
  double lost = 0, turned = 0;
  constexpr int kRuns = 200;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    Plant slipping(nothing, {}, noise, seed, {}), firm(nothing, {}, {}, seed, {});
    for (Plant* plant : {&slipping, &firm}) {
      plant->command({3000, 3000});
      run(*plant, 100);
    }
    EXPECT_EQ(slipping.encoders().left, firm.encoders().left);
    const double after_start = firm.path_length() - slipping.path_length();
    EXPECT_GE(after_start, 0);
    lost += after_start;
    turned += std::fabs(slipping.pose().heading);
    for (Plant* plant : {&slipping, &firm}) {
      run(*plant, 100);
      plant->command({0, 0});
      run(*plant, 100);
    }
    EXPECT_NEAR(firm.path_length() - slipping.path_length(), after_start, 1e-9) << "cruising and braking";
  }
  // The wheels roll about 44 mm until their growth falls below a twentieth of the limit; a fifth is lost.
  EXPECT_NEAR(lost / kRuns, 0.2 * 0.070, 0.2 * 0.015);
  EXPECT_GT(turned / kRuns, 0.03) << "each wheel slips on its own";
}

TEST(Plant, AGyroTurnsWithTheBodyUntilItDies) {
  const WorldView nothing;
  RobotSpec robot;
  EXPECT_FALSE(Plant(nothing, robot, {}, 1, {}).gyro_answers());
  robot.gyro = true;
  robot.gyro_dies_s = 3;
  Plant plant(nothing, robot, {}, 1, {});
  plant.command({-500, 700});
  run(plant, 200);
  plant.command({0, 0});
  run(plant, 50);
  ASSERT_TRUE(plant.gyro_answers());
  EXPECT_NEAR(static_cast<int32_t>(plant.gyro().sum) * (robot.gyro_range / 32768) * 0.01,
              plant.pose().heading, 2e-4);
  run(plant, 50);
  EXPECT_FALSE(plant.gyro_answers());
}

TEST(Plant, FreezesWhereItTouchesAWall) {
  const Segment wall{{0.5, -1}, {0.5, 1}};
  const WorldView world{nullptr, 0, &wall, 1, nullptr, 0};
  Plant plant(world, {}, {}, 1, {});
  plant.command({3000, 3000});
  run(plant, 300);
  EXPECT_TRUE(plant.in_contact());
  EXPECT_NEAR(plant.pose().at.x, 0.5 - 0.09, 3 * kContactGap);
  EXPECT_NEAR(plant.path_length(), 0.41, 3 * kContactGap);
  // x(t) = 0.03125 + 0.3 (t - 0.25) - 0.0025 (1 - exp(-(t - 0.25) / 0.05)) = 0.41
  const double t = plant.contact_time();
  EXPECT_NEAR(0.03125 + 0.3 * (t - 0.25) - 0.0025 * (1 - std::exp(-(t - 0.25) / 0.05)), 0.41, 1e-8);
  EXPECT_EQ(plant.min_clearance(), 0);
  EXPECT_EQ(plant.v_left(), 0);
  EXPECT_EQ(plant.encoders().left,
            static_cast<uint32_t>(0.41 * 5000) - (plant.path_length() < 0.41 ? 1U : 0U));

  const Pose frozen = plant.pose();
  const hal::EncoderCounts counts = plant.encoders();
  plant.command({-3000, -3000});
  run(plant, 100);
  EXPECT_EQ(plant.pose().at.x, frozen.at.x);
  EXPECT_EQ(plant.encoders().left, counts.left);
  EXPECT_EQ(plant.contact_time(), t);
  EXPECT_NEAR(plant.time(), 4, 1e-12);
  EXPECT_EQ(plant.ranges().beam[hal::kFront].mm, 90);
  EXPECT_LE(plant.ranges().beam[hal::kFront].age_ms, 40);
}

RobotSpec with_bumper() {
  RobotSpec robot;
  robot.bumper = true;
  return robot;
}

TEST(Plant, ASlowTouchPressesTheBumperAndIsNoContact) {
  const Segment wall{{0.3, -1}, {0.3, 1}};
  const WorldView world{nullptr, 0, &wall, 1, nullptr, 0};
  Plant plant(world, with_bumper(), {}, 1, {});
  plant.command({1000, 1000});
  run(plant, 210);
  EXPECT_EQ(plant.bumper().pressed, 0);
  run(plant, 290);
  EXPECT_FALSE(plant.in_contact());
  EXPECT_EQ(plant.bumper().pressed, 1U << hal::kFront);
  EXPECT_EQ(plant.bumps(), 1U) << "once, however long it pushes";
  EXPECT_NEAR(plant.pose().at.x, 0.21, 3 * kContactGap);
  EXPECT_LT(plant.pose().at.x, 0.21) << "the body does not penetrate";
  EXPECT_LT(plant.v_left(), 0.003);
  EXPECT_GT(plant.min_clearance(), 0);
  EXPECT_NEAR(plant.path_length(), 0.21, 3 * kContactGap);
  EXPECT_NEAR(plant.encoders().left, 0.21 * 5000, 1);

  plant.command({-500, -500});
  run(plant, 100);
  EXPECT_EQ(plant.bumper().pressed, 0);
  EXPECT_LT(plant.pose().at.x, 0.18);
  plant.command({1000, 1000});
  run(plant, 300);
  EXPECT_EQ(plant.bumps(), 2U);
}

// The mean of two wheels may come out a rounding above it.
TEST(Plant, ATouchOnAnArcAtTheFastestSlowSpeedPresses) {
  const Segment wall{{0.3, -1}, {0.3, 1}};
  const WorldView world{nullptr, 0, &wall, 1, nullptr, 0};
  for (std::int16_t apart = 1; apart < 40; ++apart) {
    Plant plant(world, with_bumper(), {}, 1, {});
    plant.command({static_cast<std::int16_t>(1000 - apart), static_cast<std::int16_t>(1000 + apart)});
    run(plant, 500);
    EXPECT_FALSE(plant.in_contact()) << apart;
  }
}

TEST(Plant, AFastTouchIsAContactWithABumperToo) {
  const Segment wall{{0.5, -1}, {0.5, 1}};
  const WorldView world{nullptr, 0, &wall, 1, nullptr, 0};
  Plant plant(world, with_bumper(), {}, 1, {}), plain(world, {}, {}, 1, {});
  for (Plant* each : {&plant, &plain}) {
    each->command({1100, 1100});
    run(*each, 500);
    EXPECT_TRUE(each->in_contact());
    EXPECT_EQ(each->bumps(), 0U);
  }
  EXPECT_EQ(plant.contact_time(), plain.contact_time());
  EXPECT_EQ(plant.pose().at.x, plain.pose().at.x);
}

TEST(Plant, ATouchBehindOrOfAMoverIsAContactWithABumperToo) {
  const Segment wall{{-0.3, -1}, {-0.3, 1}};
  const WorldView behind{nullptr, 0, &wall, 1, nullptr, 0};
  Plant backing(behind, with_bumper(), {}, 1, {});
  backing.command({-500, -500});
  run(backing, 1000);
  EXPECT_TRUE(backing.in_contact());

  const Vec2 path[] = {{0.3, 0}, {0.2, 0}};
  const MovingDisc mover{path, 2, 0.05, 0.02, 0};
  const WorldView moving{nullptr, 0, nullptr, 0, &mover, 1};
  Plant standing(moving, with_bumper(), {}, 1, {{0.1, 0}, 0});
  run(standing, 1000);
  EXPECT_TRUE(standing.in_contact());
  EXPECT_EQ(standing.bumps(), 0U);
}

TEST(Plant, TheSwitchOnTheSideOfTheTouchIsPressed) {
  for (const int degrees : {-80, -45, -31, -29, 0, 29, 31, 45, 80}) {
    const double angle = degrees * kPi / 180;
    const Disc post{{0.1105 * std::cos(angle), 0.1105 * std::sin(angle)}, 0.02};
    const WorldView world{&post, 1, nullptr, 0, nullptr, 0};
    Plant plant(world, with_bumper(), {}, 1, {});
    plant.command({500, 500});
    run(plant, 300);
    const int side = std::abs(degrees) < 30 ? hal::kFront : degrees > 0 ? hal::kLeft : hal::kRight;
    EXPECT_EQ(plant.bumper().pressed, 1U << side) << degrees;
    EXPECT_EQ(plant.bumps(), 1U) << degrees;
    EXPECT_FALSE(plant.in_contact());
  }
}

TEST(Plant, StoppingShortOfAWallIsNoContact) {
  const Segment wall{{0.5, -1}, {0.5, 1}};
  const WorldView world{nullptr, 0, &wall, 1, nullptr, 0};
  Plant plant(world, {}, {}, 1, {});
  plant.command({3000, 3000});
  run(plant, 100);
  plant.command({0, 0});
  run(plant, 300);
  EXPECT_FALSE(plant.in_contact());
  EXPECT_NEAR(plant.min_clearance(), 0.5 - 0.09 - plant.pose().at.x, kClearanceSlack);
  EXPECT_EQ(plant.v_left(), 0);
}

TEST(Plant, AStartThatTouchesIsAContactAtTimeZero) {
  const Disc disc{{0.5, 0}, 0.41};
  const WorldView world{&disc, 1, nullptr, 0, nullptr, 0};
  EXPECT_TRUE(Plant(world, {}, {}, 1, {}).in_contact());
  EXPECT_EQ(Plant(world, {}, {}, 1, {}).contact_time(), 0);
  EXPECT_FALSE(Plant(world, {}, {}, 1, {{-1e-6, 0}, 0}).in_contact());
}

TEST(Plant, AnObstacleDroppedOnItBetweenTwoTicksIsAContact) {
  Disc disc{{5, 0}, 0.2};
  const WorldView world{&disc, 1, nullptr, 0, nullptr, 0};
  Plant plant(world, {}, {}, 1, {});
  run(plant, 10);
  EXPECT_FALSE(plant.in_contact());
  disc.center = {0.1, 0};
  plant.advance();
  EXPECT_TRUE(plant.in_contact());
  EXPECT_NEAR(plant.contact_time(), 0.1, 1e-12);
  EXPECT_NEAR(plant.min_clearance(), 0.1 - 0.2 - 0.09, 1e-12);
}

TEST(Plant, SeesAnObstacleThatItsOwnerDrags) {
  Disc disc{{1.0, 0}, 0.2};
  WorldView world{&disc, 1, nullptr, 0, nullptr, 0};
  Plant plant(world, {}, {}, 1, {});
  run(plant, 10);
  EXPECT_EQ(plant.ranges().beam[hal::kFront].mm, 800);
  disc.center.x = 1.5;
  run(plant, 6);
  EXPECT_EQ(plant.ranges().beam[hal::kFront].mm, 1300);
  world.disc_count = 0;
  run(plant, 6);
  EXPECT_EQ(plant.ranges().beam[hal::kFront].status, hal::RangeStatus::clear);
}

TEST(Plant, SmallestClearanceAgreesWithManyPosesOfARun) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Disc> discs;
    for (int i = 0; i < 2; ++i) discs.push_back({point(1), real(0.01, 0.2)});
    const std::vector<Segment> segments{{point(1), point(1)}};
    const std::vector<Vec2> path{point(1), point(1)};
    const MovingDisc mover{path.data(), 2, 0.05, real(0, 0.4), 0};
    const WorldView world{discs.data(), discs.size(), segments.data(), 1, &mover, 1};
    RobotSpec robot;
    robot.period_s = 0.005;
    Plant plant(world, robot, {}, 1, {point(1), real(-4, 4)});
    RC_PRE(!plant.in_contact());
    double least = clearance(world, plant.pose().at, 0, robot.radius);
    for (int part = 0; part < 6 && !plant.in_contact(); ++part) {
      plant.command(any_speeds(3000));
      for (int i = 0; i < 60; ++i) {
        plant.advance();
        if (plant.in_contact()) break;
        least = std::fmin(least, clearance(world, plant.pose().at, plant.time(), robot.radius));
      }
    }
    RC_CLASSIFY(plant.in_contact(), "contact");
    if (plant.in_contact()) {
      RC_ASSERT(plant.min_clearance() <= 0);
      RC_ASSERT(clearance(world, plant.pose().at, plant.contact_time(), robot.radius) <= 3 * kContactGap);
    } else {
      RC_ASSERT(least > 0);
      RC_ASSERT(plant.min_clearance() <= least + kClearanceSlack);
      // Between two poses the gap is smaller by at most half the path.
      RC_ASSERT(plant.min_clearance() >= least - 0.5 * 0.005 * (0.3 + mover.speed) - 1e-12);
    }
  }));
}

TEST(Plant, MeasuresFromWhereItIsAtThatMomentBetweenTwoSteps) {
  const Segment wall{{30, -50}, {30, 50}};
  const WorldView world{nullptr, 0, &wall, 1, nullptr, 0};
  RobotSpec robot;
  robot.max_speed = 3;
  robot.max_acceleration = 1000;
  robot.motor_lag = 0;
  robot.beams[hal::kFront].max_range = 60;
  robot.rate_hz = 30;
  robot.latency_s = 0;
  Plant plant(world, robot, {}, 1, {});
  plant.command({30000, 30000});
  for (int tick = 1; tick <= 300; ++tick) {
    plant.advance();
    const hal::RangeReading front = plant.ranges().beam[hal::kFront];
    const int taken = tick * 30 / 100;
    const double t = taken / 30.0;
    // 3 ms to full speed.
    const double x = taken == 0 ? 0 : 3 * t - 0.0045;
    ASSERT_NEAR(front.mm, (30 - x) * 1000, 0.51) << tick;
    ASSERT_EQ(front.age_ms, std::lround(plant.time() * 1000 - t * 1000)) << tick;
    ASSERT_EQ(front.sequence, taken % 16) << tick;
  }
}

TEST(Plant, AMoverThatPassesRightThroughWithinATickIsAContact) {
  // A disc that is removed later sets a smallest gap far below the mover's gap when the tick starts.
  const Disc near_by{{0, 0.2}, 0.1};
  const Vec2 path[] = {{1.03, 0}, {-1.03, 0}};
  const MovingDisc mover{path, 2, 0.05, 200, 0};
  WorldView world{&near_by, 1, nullptr, 0, &mover, 1};
  Plant plant(world, {}, {}, 1, {});
  EXPECT_NEAR(plant.min_clearance(), 0.01, 1e-12);
  world.disc_count = 0;
  plant.advance();
  EXPECT_TRUE(plant.in_contact());
  EXPECT_NEAR(plant.contact_time(), (1.03 - 0.14) / 200, 1e-9);
}

TEST(Plant, TheReferenceRobotIsTheCoresDefault) {
  const RobotSpec ours, core = robot_spec(Params{});
  EXPECT_EQ(core.radius, ours.radius);
  EXPECT_EQ(core.track, ours.track);
  EXPECT_EQ(core.max_speed, ours.max_speed);
  EXPECT_EQ(core.max_acceleration, ours.max_acceleration);
  EXPECT_EQ(core.motor_lag, ours.motor_lag);
  EXPECT_EQ(core.counts_per_m, ours.counts_per_m);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(core.beams[i].angle, ours.beams[i].angle, 1e-9);
    EXPECT_NEAR(core.beams[i].cone_half_width, ours.beams[i].cone_half_width, 1e-9);
    EXPECT_EQ(core.beams[i].min_range, ours.beams[i].min_range);
    EXPECT_EQ(core.beams[i].max_range, ours.beams[i].max_range);
    EXPECT_EQ(core.beams[i].x, ours.beams[i].x);
    EXPECT_EQ(core.beams[i].y, ours.beams[i].y);
  }
  EXPECT_EQ(core.rate_hz, ours.rate_hz);
  EXPECT_EQ(core.latency_s, ours.latency_s);
  EXPECT_EQ(core.period_s, ours.period_s);
}

}  // namespace
}  // namespace whisker::sim
