#include <gtest/gtest.h>

#include <cstdio>

#include "hal/boards/atmega1284p/robot_params.hpp"
#include "host/sim/elementary.hpp"
#include "tests/boards/avr/avr_robot.hpp"

namespace whisker::hal::atmega1284p {
namespace {

constexpr double kCyclesPerPeriod = 0.020 * 16e6;
constexpr int kRam = 2048;

class AvrLoopTest : public ::testing::Test {
 protected:
  void TearDown() override {
    EXPECT_FALSE(robot.crashed());
    EXPECT_FALSE(robot.plant().in_contact());
    EXPECT_GE(robot.shortest_period_ms(), 18.9);
    EXPECT_LE(robot.longest_period_ms(), 21.1);
    EXPECT_LT(static_cast<double>(robot.worst_tick_cycles()), kCyclesPerPeriod);
    EXPECT_LE(robot.static_ram() + robot.deepest_stack(), kRam);
    std::printf("ticks %llu, worst %llu cycles of %.0f, period %.2f to %.2f ms, RAM %d + stack %d bytes\n",
                static_cast<unsigned long long>(robot.ticks()),
                static_cast<unsigned long long>(robot.worst_tick_cycles()), kCyclesPerPeriod,
                robot.shortest_period_ms(), robot.longest_period_ms(), robot.static_ram(),
                robot.deepest_stack());
  }
  bool stands() const { return robot.duty(0) == 0 && robot.duty(1) == 0; }

  sim::Disc disc{{9, 9}, 0.1};
  sim::WorldView world{&disc, 1};
  AvrRobot robot{WHISKER_AVR_IMAGE, world};
};

TEST_F(AvrLoopTest, ReachesItsGoalInAnEmptyField) {
  EXPECT_TRUE(robot.run_until(60, [this] { return robot.outcome() == planning::Outcome::reached; }));
  EXPECT_NEAR(robot.plant().pose().at.x, 1.5, 0.12);
  EXPECT_NEAR(robot.plant().pose().at.y, 0.0, 0.12);
  EXPECT_EQ(robot.fault(), Fault::none);
  EXPECT_EQ(robot.troubles(), 0);
  robot.run(0.5);
  EXPECT_TRUE(stands());
}

TEST_F(AvrLoopTest, GoesRoundADiscInItsWay) {
  disc = {{0.75, 0.02}, 0.12};
  EXPECT_TRUE(robot.run_until(120, [this] { return robot.outcome() == planning::Outcome::reached; }));
  EXPECT_EQ(robot.fault(), Fault::none);
  EXPECT_EQ(robot.troubles(), 0);
}

/// Where every direction is blocked it looks all around and judges its steps by the most that it can know.
TEST_F(AvrLoopTest, PennedInItHoldsItsPeriodAndTouchesNothing) {
  constexpr int kPosts = 24;
  sim::Disc pen[kPosts];
  for (int i = 0; i < kPosts; ++i) {
    const sim::SinCos at = sim::sin_cos(i * (2 * sim::kPi / kPosts));
    const double away = 0.26 + 0.008 * (i % 5);  // else its sensors would seem stuck
    pen[i] = {{away * at.cos, away * at.sin}, 0.05};
  }
  world.discs = pen;
  world.disc_count = kPosts;
  robot.run(20);
  EXPECT_EQ(robot.fault(), Fault::none);
  EXPECT_NE(robot.outcome(), planning::Outcome::reached);
}

TEST_F(AvrLoopTest, ASonarThatDiesStopsItWithAName) {
  robot.echo_dead[1] = true;
  robot.run(4);
  EXPECT_EQ(robot.fault(), Fault::range_lost);
  EXPECT_GE(robot.troubles(), 10);
  EXPECT_TRUE(stands());
}

TEST_F(AvrLoopTest, AnEchoLineThatStaysHighStopsItWithAName) {
  ASSERT_TRUE(robot.run_until(10, [this] { return robot.plant().v_left() > 0.1; }));
  robot.echo_line_high = true;
  robot.run(4);
  EXPECT_EQ(robot.fault(), Fault::range_lost);
  EXPECT_GE(robot.troubles(), 10);
  EXPECT_TRUE(stands());
}

TEST_F(AvrLoopTest, DeadEncodersStopIt) {
  robot.encoder_dead[0] = robot.encoder_dead[1] = true;
  robot.run(8);
  EXPECT_EQ(robot.fault(), Fault::wheels_stalled);
  EXPECT_TRUE(stands());
}

TEST_F(AvrLoopTest, InfraredSeesWhatTheSonarsDoNot) {
  robot.infrared_only = true;
  disc = {{0.6, 0}, 0.2};
  robot.run(12);
  EXPECT_EQ(robot.fault(), Fault::none);
}

TEST(AvrParamsTest, AreOnesThatTheCoreAccepts) { EXPECT_EQ(check(kRobotParams), ParamFault::none); }

}  // namespace
}  // namespace whisker::hal::atmega1284p
