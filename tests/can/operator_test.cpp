// A third party beside controller and base: its orders and parameters, and who wins.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "firmware/can/mission.hpp"
#include "host/harness/hil/planners.hpp"
#include "tests/can/guard_rig.hpp"
#include "tests/can/rig.hpp"

namespace whisker {
namespace {

using can::MissionStatus;
using can::NodeState;
using can::Order;
using can::ParamAction;
using can::ParamStatus;
using planning::Outcome;
using test::open_ground;

constexpr std::uint8_t kMaxSpeed = 3;
constexpr std::uint32_t kSlow_um_per_s = 150000;
constexpr planning::Goal kNear{{1_m, 500_mm}, 100_mm};

/// R: Rig or GuardRig.
template <class R>
class Operated : public R {
 public:
  using R::R;

  void send(Order order, const planning::Goal& goal, std::uint8_t number) {
    const can::MissionValues values = can::values_of({{}, goal});
    for (int i = 0; i < can::kMissionValues; ++i) {
      this->hand.say(can::MissionValue{static_cast<can::MissionPart>(i + 1), number, values.of[i]});
    }
    this->hand.say(can::MissionOrder{can::MissionPart::order, number, order, can::digest_of(values)});
  }
  /// With a new number.
  MissionStatus ask(Order order, const planning::Goal& goal = kNear) {
    send(order, goal, ++number_);
    return answer();
  }
  MissionStatus answer() {
    this->hand.forget();
    this->drive(1);
    can::MissionReply reply;
    EXPECT_TRUE(this->hand.last(reply));
    EXPECT_EQ(reply.to_operator, 1);
    EXPECT_EQ(reply.mission, number_);
    return reply.status;
  }
  can::ParamReply ask(const can::ParamRequest& request) {
    this->hand.forget();
    this->hand.say(request);
    this->drive(1);
    can::ParamReply reply;
    EXPECT_TRUE(this->hand.last(reply));
    EXPECT_EQ(reply.to_operator, 1);
    EXPECT_EQ(reply.index, request.index);
    return reply;
  }
  ParamStatus write(std::uint32_t speed) { return ask({ParamAction::write, kMaxSpeed, speed}).status; }
  ParamStatus commit() { return ask({ParamAction::commit, can::kCommitIndex, 0}).status; }
  std::uint32_t read() { return ask({ParamAction::read, kMaxSpeed, 0}).value; }
  std::uint8_t number() const { return number_; }

 private:
  std::uint8_t number_ = 40;
};

/// The whole core, on its way to a goal 30 m ahead.
class DrivenRobot : public Operated<test::Rig> {
 public:
  DrivenRobot() : Operated(open_ground(), {}, {}, 1, &maker()) {
    drive(20);
    give(Order::start);
    drive(500);
    EXPECT_TRUE(drives());
  }
  bool drives() { return now().base == NodeState::running && outcome() == Outcome::running; }
  Outcome outcome() { return base().status().outcome; }
  bool stands() const { return now().speeds.left == 0 && now().speeds.right == 0; }
  /// Ticks until the outcome is another than running; at most 6000.
  Outcome end() {
    for (int i = 0; i < 6000 && outcome() == Outcome::running; ++i) drive(1);
    return outcome();
  }
  double distance_to(double x, double y) const {
    return std::hypot(plant().pose().at.x - x, plant().pose().at.y - y);
  }
  void stop_and_stand() {
    EXPECT_EQ(ask(Order::cancel), MissionStatus::accepted);
    drive(100);
    EXPECT_TRUE(stands());
  }

 private:
  hil::HostPlanners& maker() {
    static hil::HostPlanners planners(kDefaultPlanner, nullptr);
    return planners;
  }
};

TEST(Operator, GoalIsDrivenToWithoutAStopAndReported) {
  DrivenRobot robot;
  ASSERT_EQ(robot.ask(Order::resume), MissionStatus::accepted);
  EXPECT_EQ(robot.end(), Outcome::reached);
  EXPECT_LT(robot.distance_to(1, 0.5), 0.12);
  EXPECT_EQ(robot.base().state(), NodeState::running) << "the order of the base holds on";
  EXPECT_EQ(robot.base().health().stops, 0U);
  EXPECT_EQ(robot.base().health().stale, 0U);
  ASSERT_EQ(robot.ask(Order::resume, {{0_m, 0_m}, 100_mm}), MissionStatus::accepted) << "and again";
  EXPECT_EQ(robot.outcome(), Outcome::running);
  EXPECT_EQ(robot.end(), Outcome::reached);
  EXPECT_LT(robot.distance_to(0, 0), 0.12);
}

TEST(Operator, CancelStopsAndANewGoalDrivesOn) {
  DrivenRobot robot;
  ASSERT_EQ(robot.ask(Order::cancel), MissionStatus::accepted);
  robot.drive(40);
  EXPECT_TRUE(robot.stands());
  EXPECT_EQ(robot.outcome(), Outcome::none);
  EXPECT_EQ(robot.base().state(), NodeState::running);
  const double there = robot.plant().path_length();
  robot.drive(200);
  EXPECT_NEAR(robot.plant().path_length(), there, 1e-3);
  ASSERT_EQ(robot.ask(Order::start), MissionStatus::accepted);
  EXPECT_EQ(robot.end(), Outcome::reached);
  EXPECT_LT(robot.distance_to(1, 0.5), 0.12) << "from the estimated pose";
}

TEST(Operator, StartsOnlyFromStandstill) {
  DrivenRobot robot;
  EXPECT_EQ(robot.ask(Order::start), MissionStatus::refused);
  EXPECT_TRUE(robot.drives());
  robot.ask(Order::cancel);
  EXPECT_EQ(robot.ask(Order::start), MissionStatus::refused) << "it still brakes";
}

TEST(Operator, AnOrderOfTheBaseWins) {
  DrivenRobot robot;
  ASSERT_EQ(robot.ask(Order::resume), MissionStatus::accepted);
  robot.give(Order::cancel);
  robot.drive(60);
  EXPECT_EQ(robot.base().state(), NodeState::ready);
  for (const Order order : {Order::start, Order::resume, Order::cancel}) {
    EXPECT_EQ(robot.ask(order), MissionStatus::refused) << "the operator drives nothing by itself";
  }
  robot.give(Order::start);
  robot.drive(600);
  EXPECT_TRUE(robot.drives());
  EXPECT_GT(robot.plant().pose().at.x, 0.8);
  EXPECT_LT(std::fabs(robot.plant().pose().at.y - robot.status().pose.at.y.raw() * 1e-6), 2.0);
}

TEST(Operator, NothingEndsAnEStopOrASafeStopForIt) {
  DrivenRobot robot;
  robot.hand.send(can::encode(can::EStop{}, 0, 0));
  robot.drive(60);
  EXPECT_EQ(robot.ask(Order::resume), MissionStatus::refused);
  robot.hand.send(can::encode(can::EStop{can::kClearCommand}, 0, 0));
  robot.drive(5);
  EXPECT_EQ(robot.ask(Order::resume), MissionStatus::refused) << "cleared: the base must order";
  EXPECT_TRUE(robot.stands());
  robot.give(Order::resume);
  robot.drive(100);
  EXPECT_TRUE(robot.drives());
  EXPECT_EQ(robot.ask(Order::resume), MissionStatus::accepted);
}

TEST(Operator, ARepeatedOrderIsOneAndANumberIsNewAfterASilence) {
  DrivenRobot robot;
  robot.stop_and_stand();
  ASSERT_EQ(robot.ask(Order::resume), MissionStatus::accepted);
  robot.drive(20);
  const can::BusHealth was = robot.controller().health();
  robot.send(Order::cancel, kNear, robot.number());
  EXPECT_EQ(robot.answer(), MissionStatus::accepted);
  robot.drive(20);
  EXPECT_TRUE(robot.drives()) << "the number is that of the order before";
  EXPECT_EQ(robot.controller().health().out_of_sequence, was.out_of_sequence);
  robot.drive(40);
  robot.send(Order::cancel, kNear, robot.number());
  EXPECT_EQ(robot.answer(), MissionStatus::accepted);
  EXPECT_EQ(robot.outcome(), Outcome::none);
}

TEST(Operator, OrdersThatItMayNotGiveAndDamagedOnes) {
  DrivenRobot robot;
  EXPECT_EQ(robot.ask(Order::spin), MissionStatus::unsupported);
  EXPECT_EQ(robot.ask(Order::straight), MissionStatus::unsupported);
  EXPECT_EQ(robot.ask(Order::resume, {{kPlaceLimit + micrometres(1), 0_m}, 100_mm}),
            MissionStatus::out_of_range);
  robot.hand.say(can::MissionOrder{can::MissionPart::order, robot.number(), Order::cancel, 1});
  EXPECT_EQ(robot.answer(), MissionStatus::incomplete);
  robot.send(Order::resume, kNear, static_cast<std::uint8_t>(robot.number() + 1));
  robot.hand.say(can::MissionValue{can::MissionPart::goal_x, 77, 0});
  robot.hand.say(can::MissionOrder{can::MissionPart::order, robot.number(), Order::cancel, 1});
  EXPECT_EQ(robot.answer(), MissionStatus::incomplete) << "a part of another order begins anew";
}

/// Every bit of both requests; the CRC finds it, and the next one counts.
TEST(Operator, ObeysNoFrameWithAWrongBit) {
  DrivenRobot robot;
  robot.stop_and_stand();
  const can::BusHealth& health = robot.controller().health();
  const can::ParamRequest request{ParamAction::write, kMaxSpeed, kSlow_um_per_s};
  for (int bit = 0; bit < 8 * 7; ++bit) {
    for (const hal::CanFrame& good :
         {robot.hand.frame(request), robot.hand.frame(can::MissionOrder{can::MissionPart::order, 1})}) {
      hal::CanFrame bad = good;
      bad.data[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      const can::BusHealth was = health;
      robot.hand.forget();
      robot.hand.send(bad);
      robot.drive(1);
      EXPECT_EQ(health.crc, was.crc + 1) << bit;
      EXPECT_EQ(robot.hand.heard<can::ParamReply>() + robot.hand.heard<can::MissionReply>(), 0) << bit;
    }
  }
  EXPECT_EQ(robot.read(), 300000U);
  for (const hal::CanFrame& good : {robot.hand.frame(request)}) {
    hal::CanFrame shorter = good, extended = good, of_two = good;
    shorter.size = 6;
    test::repair(shorter);
    extended.extended = true;
    of_two.id += 1;
    test::repair(of_two);
    const can::BusHealth was = health;
    for (const hal::CanFrame& bad : {shorter, extended, of_two, good, good}) robot.hand.send(bad);
    robot.drive(1);
    EXPECT_EQ(health.malformed, was.malformed + 2);
    EXPECT_EQ(health.foreign, was.foreign + 1);
    EXPECT_EQ(health.repeated, was.repeated + 1);
    EXPECT_EQ(health.duplicates, 0U);
  }
  EXPECT_EQ(robot.read(), kSlow_um_per_s);
}

TEST(Operator, WritesParametersAtStandstillOnly) {
  DrivenRobot robot;
  EXPECT_EQ(robot.read(), 300000U);
  EXPECT_EQ(robot.write(kSlow_um_per_s), ParamStatus::busy);
  EXPECT_EQ(robot.commit(), ParamStatus::busy);
  robot.ask(Order::cancel);
  EXPECT_EQ(robot.write(kSlow_um_per_s), ParamStatus::busy) << "it still brakes";
  robot.drive(100);
  EXPECT_EQ(robot.write(9000000), ParamStatus::out_of_range);
  EXPECT_EQ(robot.write(kSlow_um_per_s), ParamStatus::ok);
  EXPECT_EQ(robot.read(), kSlow_um_per_s);
  EXPECT_EQ(robot.controller().params().wheels.max_speed.raw(), 300000) << "not before a commit";
  EXPECT_EQ(robot.commit(), ParamStatus::ok);
  EXPECT_EQ(robot.controller().params().wheels.max_speed.raw(), 150000);
  ASSERT_EQ(robot.ask(Order::start), MissionStatus::accepted);
  int fastest = 0;
  while (robot.outcome() == Outcome::running) {
    robot.drive(1);
    fastest = std::max<int>(fastest, robot.now().speeds.left);
  }
  EXPECT_EQ(robot.outcome(), Outcome::reached);
  EXPECT_LE(fastest, 1500) << "start drives with what was committed";
  EXPECT_GT(fastest, 1000);
}

TEST(Operator, ResumeDrivesWithTheParametersOfTheLastStart) {
  DrivenRobot robot;
  robot.stop_and_stand();
  robot.write(kSlow_um_per_s);
  robot.commit();
  ASSERT_EQ(robot.ask(Order::resume), MissionStatus::accepted);
  int fastest = 0;
  for (int i = 0; i < 400; ++i) {
    robot.drive(1);
    fastest = std::max<int>(fastest, robot.now().speeds.left);
  }
  EXPECT_GT(fastest, 2000);
}

TEST(Operator, WhatOneStagesIsVoidWhenAnotherStages) {
  DrivenRobot robot;
  robot.give(Order::cancel);
  robot.drive(60);
  ASSERT_EQ(robot.write(kSlow_um_per_s), ParamStatus::ok) << "no order holds";
  robot.base().request({ParamAction::write, 0, 95000});
  robot.drive(1);
  EXPECT_EQ(robot.read(), 300000U) << "the base transfers";
  EXPECT_EQ(robot.write(kSlow_um_per_s), ParamStatus::busy);
  EXPECT_EQ(robot.commit(), ParamStatus::busy);
  robot.base().request({ParamAction::commit, can::kCommitIndex, 0});
  robot.drive(1);
  EXPECT_EQ(robot.controller().params().body.radius, 95_mm);
  EXPECT_EQ(robot.controller().params().wheels.max_speed.raw(), 300000);
  EXPECT_EQ(robot.write(kSlow_um_per_s), ParamStatus::ok);
  robot.drive(40);
  EXPECT_EQ(robot.read(), 300000U) << "an operator that falls silent leaves nothing staged";
}

TEST(Operator, RepliesToItAreNotThoseToTheBase) {
  DrivenRobot robot;
  robot.base().request({ParamAction::read, 0, 0});
  robot.drive(1);
  robot.ask({ParamAction::read, 1, 0});
  can::ParamReply reply;
  ASSERT_TRUE(robot.base().replied(reply));
  EXPECT_EQ(reply.index, 0) << "not that of the operator, which came later";
  EXPECT_EQ(robot.base().health().malformed, 0U);
}

TEST(Operator, GetsTheTableWhenItAppears) {
  DrivenRobot robot;
  robot.hand.forget();
  robot.drive(100);
  EXPECT_EQ(robot.hand.heard<can::Info>(), 0);
  robot.hand.say(can::ParamRequest{});
  robot.drive(1);
  EXPECT_EQ(robot.hand.heard<can::Info>(), 2);
  robot.hand.say(can::ParamRequest{});
  robot.drive(1);
  EXPECT_EQ(robot.hand.heard<can::Info>(), 2);
}

TEST(Operator, AGuardNodeTakesItsParametersButNoGoal) {
  Operated<test::GuardRig> rig(open_ground());
  rig.begin();
  for (const Order order : {Order::start, Order::resume, Order::cancel}) {
    EXPECT_EQ(rig.ask(order), MissionStatus::unsupported);
  }
  EXPECT_EQ(rig.write(kSlow_um_per_s), ParamStatus::ok) << "nothing is asked of it";
  EXPECT_EQ(rig.commit(), ParamStatus::ok);
  rig.wish = can::VelocityCommand{3000, 0};
  rig.drive(100);
  EXPECT_GT(rig.speed(), 0.25) << "from the next start on";
  EXPECT_EQ(rig.write(200000), ParamStatus::busy);
  EXPECT_EQ(rig.read(), kSlow_um_per_s);
  EXPECT_EQ(rig.report().armed, 1);
}

}  // namespace
}  // namespace whisker
