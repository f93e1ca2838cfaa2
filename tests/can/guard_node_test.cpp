// The guard as a node: who may move it, what stops it, and that it touches nothing.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "host/harness/worlds/beside.hpp"
#include "host/lab/guard/operators.hpp"
#include "tests/can/guard_rig.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

using can::NodeState;
using can::VelocityCommand;
using test::GuardRig;
using test::open_ground;

constexpr VelocityCommand kAhead{3000, 0};

std::string reason(const GuardRig& rig) { return can::kGuardReasonWords[rig.report().reason]; }
bool stands(const GuardRig& rig) { return rig.wheels().left == 0 && rig.wheels().right == 0; }

Scenario wall_at(double x) {
  Scenario s = open_ground();
  s.walls.push_back({{x, -3}, {x, 3}});
  return s;
}

TEST(GuardNode, NamesTheReasonsAsTheGuardDoes) {
  for (int i = 0; i < kGuardReasons; ++i) {
    EXPECT_STREQ(can::word_in<can::kGuardReasonWords>(i), name(static_cast<GuardReason>(i)));
  }
  EXPECT_STREQ(can::word_in<can::kGuardReasonWords>(can::GuardReport{}.reason), "command_timeout");
}

TEST(GuardNode, DrivesAsTheOperatorAsks) {
  GuardRig rig(open_ground());
  rig.begin();
  EXPECT_EQ(rig.report().vouched, 1);
  EXPECT_EQ(rig.report().armed, 1);
  rig.wish = VelocityCommand{2500, 500};
  rig.drive(100);
  EXPECT_EQ(reason(rig), "clear");
  EXPECT_EQ(rig.report().asked_forward, 2500);
  EXPECT_EQ(rig.report().asked_turning, 500);
  EXPECT_EQ(rig.report().granted_forward, 100);
  EXPECT_EQ(rig.report().granted_turning, 100);
  EXPECT_NEAR(rig.speed(), 0.25, 0.005);
  EXPECT_GT(rig.plant().pose().heading, 0.3);
  EXPECT_EQ(rig.base().status().outcome, planning::Outcome::running);
}

TEST(GuardNode, StandsBeforeAnObstacleAndNamesIt) {
  GuardRig rig(wall_at(0.6));
  rig.begin();
  rig.wish = kAhead;
  rig.drive(600);
  EXPECT_EQ(reason(rig), "obstacle");
  EXPECT_EQ(rig.report().granted_forward, 0);
  EXPECT_TRUE(stands(rig));
  EXPECT_FALSE(rig.plant().in_contact());
  EXPECT_GT(rig.plant().path_length(), 0.4);
}

/// Measured at the wheels. The braking is that of docs/guard.md: 0.3 s, and the lag of the motors.
TEST(GuardNode, StandsWithinTheTimeOutATickAndBrakingAfterTheLastVelocity) {
  for (std::uint32_t every_ms : {3U, 10U, 17U, 20U, 40U}) {
    GuardRig rig(open_ground());
    rig.every_ms = every_ms;
    rig.begin();
    rig.wish = kAhead;
    rig.drive(150);
    ASSERT_EQ(rig.wheels().left, 3000) << every_ms;
    rig.wish.reset();
    std::uint32_t brakes_ms = 0, rests_ms = 0, stands_ms = 0;
    for (int i = 0; i < 100; ++i) {
      rig.drive(1);
      const std::uint32_t passed = rig.now_ms() - rig.said_ms();
      if (brakes_ms == 0 && rig.wheels().left < 3000) brakes_ms = passed;
      if (rests_ms == 0 && stands(rig)) rests_ms = passed;
      if (stands_ms == 0 && std::fabs(rig.speed()) < 1e-3) stands_ms = passed;
    }
    EXPECT_GT(brakes_ms, 50U) << "no sooner than its time-out";
    EXPECT_LE(brakes_ms, 70U) << "time-out, tick, and the tick that the wheels need";
    EXPECT_LE(rests_ms, 50U + 10 + 300) << every_ms;
    EXPECT_LE(stands_ms, 570U) << every_ms;
    EXPECT_EQ(reason(rig), "command_timeout");
    EXPECT_EQ(rig.base().state(), NodeState::running) << "no safe stop: the next Velocity drives again";
    rig.wish = kAhead;
    rig.drive(60);
    EXPECT_GT(rig.speed(), 0.25);
  }
}

/// 23 bytes in a millisecond are 230,400 bit/s.
TEST(GuardNode, WorksBehindASerialLineOf230400BitsASecond) {
  GuardRig rig(wall_at(1.5), {}, {}, 1, 23);
  rig.drive(30);
  rig.begin();
  EXPECT_EQ(rig.report().vouched, 1);
  rig.wish = kAhead;
  rig.drive(150);
  ASSERT_EQ(rig.wheels().left, 3000);
  EXPECT_EQ(rig.line().counts().expired, 0U);
  EXPECT_EQ(rig.guard().node().health().skipped, 0U);
  rig.wish.reset();
  std::uint32_t rests_ms = 0;
  while (!stands(rig) && rests_ms < 1000) {
    rig.drive(1);
    rests_ms = rig.now_ms() - rig.said_ms();
  }
  EXPECT_LE(rests_ms, 50U + 10 + 300 + 10) << "one tick more for the line";
  rig.wish = kAhead;
  rig.drive(600);
  EXPECT_EQ(reason(rig), "obstacle");
  EXPECT_FALSE(rig.plant().in_contact());
}

TEST(GuardNode, AShorterTimeOutOfTheParametersHolds) {
  GuardRig rig(open_ground());
  rig.drive(20);
  rig.base().request({can::ParamAction::write, 77, 20});
  rig.drive(2);
  rig.base().request({can::ParamAction::commit, 255, 0});
  rig.drive(2);
  rig.begin();
  rig.every_ms = 40;
  rig.wish = kAhead;
  bool late = false;
  for (int i = 0; i < 100; ++i) {
    rig.drive(1);
    late = late || reason(rig) == "command_timeout";
  }
  EXPECT_TRUE(late);
  EXPECT_GT(rig.plant().path_length(), 0.005);
}

TEST(GuardNode, AnOrderMovesNothingAndTheStickMustBeLetGoFirst) {
  GuardRig rig(open_ground());
  rig.wish = kAhead;
  rig.drive(20);
  rig.give(can::Order::start);
  rig.drive(100);
  EXPECT_EQ(rig.base().state(), NodeState::running);
  EXPECT_EQ(rig.report().armed, 0);
  EXPECT_EQ(reason(rig), "command_timeout");
  EXPECT_EQ(rig.plant().path_length(), 0);
  rig.wish = VelocityCommand{0, 1000};
  rig.drive(50);
  EXPECT_EQ(rig.plant().pose().heading, 0);
  rig.wish = VelocityCommand{};
  rig.drive(5);
  EXPECT_EQ(rig.report().armed, 1);
  rig.wish = VelocityCommand{0, 1000};
  rig.drive(50);
  EXPECT_GT(rig.plant().pose().heading, 0.1);
}

TEST(GuardNode, AnEStopStopsItAndOnlyAnOrderAndALetGoStickEndIt) {
  GuardRig rig(open_ground());
  rig.begin();
  rig.wish = kAhead;
  rig.drive(150);
  rig.hand.send(can::encode(can::EStop{}, 0, 0));
  rig.drive(32);
  EXPECT_TRUE(stands(rig));
  EXPECT_EQ(rig.guard().node().state(), NodeState::e_stopped);
  rig.drive(60);
  rig.hand.send(can::encode(can::EStop{can::kClearCommand}, 0, 0));
  rig.drive(30);
  const double there = rig.plant().path_length();
  EXPECT_NE(rig.guard().node().state(), NodeState::e_stopped);
  rig.give(can::Order::resume);
  rig.drive(50);
  EXPECT_EQ(rig.base().state(), NodeState::running);
  EXPECT_NEAR(rig.plant().path_length(), there, 1e-6) << "the stick is still at full speed";
  rig.wish = VelocityCommand{};
  rig.drive(5);
  rig.wish = kAhead;
  rig.drive(300);
  EXPECT_GT(rig.plant().path_length(), there + 0.1);
}

TEST(GuardNode, WithoutAnOrderNothingMoves) {
  GuardRig rig(open_ground());
  rig.wish = VelocityCommand{};
  rig.drive(20);
  rig.wish = kAhead;
  rig.drive(50);
  EXPECT_EQ(rig.plant().path_length(), 0);
  EXPECT_EQ(rig.guard().node().state(), NodeState::ready);
  EXPECT_GT(rig.hand.heard<can::GuardReport>(), 4) << "it shows that it is a guard node";
  EXPECT_LT(rig.hand.heard<can::GuardReport>(), 12);
}

TEST(GuardNode, AnOperatorThatAppearsGetsTheTable) {
  GuardRig rig(open_ground());
  rig.drive(50);
  rig.hand.forget();
  rig.wish = VelocityCommand{};
  rig.drive(5);
  EXPECT_EQ(rig.hand.heard<can::Info>(), 3);
  rig.drive(100);
  EXPECT_EQ(rig.hand.heard<can::Info>(), 3);
  rig.wish.reset();
  rig.drive(40);
  rig.wish = VelocityCommand{};
  rig.drive(5);
  EXPECT_EQ(rig.hand.heard<can::Info>(), 6) << "again after a silence";
}

TEST(GuardNode, AVouchCountsOnceAndNotAfterTheFirstMovement) {
  GuardRig rig(open_ground());
  rig.begin(0);
  EXPECT_EQ(rig.report().vouched, 0);
  rig.wish = VelocityCommand{0, 1000};
  rig.drive(20);
  rig.wish = VelocityCommand{};
  rig.drive(60);
  rig.hand.say(can::VouchRequest{1, 350});
  rig.drive(5);
  EXPECT_EQ(rig.report().vouched, 0) << "it has moved";
  rig.give(can::Order::resume);
  rig.drive(10);
  rig.hand.say(can::VouchRequest{1, 350});
  rig.drive(5);
  EXPECT_EQ(rig.report().vouched, 1);
  const can::BusHealth& health = rig.guard().node().health();
  const std::uint32_t bad = health.out_of_range;
  rig.hand.say(can::VouchRequest{2, 10001});
  rig.hand.say(can::VouchRequest{3, 0});
  rig.drive(2);
  EXPECT_EQ(health.out_of_range, bad + 2);
}

TEST(GuardNode, ObeysNoDamagedRepeatedOrForeignVelocity) {
  GuardRig rig(open_ground());
  rig.begin();
  rig.wish.reset();
  const can::BusHealth& health = rig.guard().node().health();
  const can::BusHealth was = health, base = rig.base().health();
  hal::CanFrame frame = rig.hand.frame(kAhead);
  hal::CanFrame damaged = frame, of_base = frame, of_two = frame, shorter = frame, extended = frame;
  damaged.data[3] ^= 1;
  of_base.id = can::id_of(can::message_of(can::MessageKind::velocity).function, 9);
  of_two.id = can::id_of(can::message_of(can::MessageKind::velocity).function, 2);
  test::repair(of_base);
  test::repair(of_two);
  shorter.size = 5;
  test::repair(shorter);
  extended.extended = true;
  for (const hal::CanFrame& f : {damaged, of_base, of_two, shorter, extended}) rig.hand.send(f);
  rig.drive(3);
  EXPECT_EQ(rig.report().asked_forward, 0);
  EXPECT_EQ(health.crc, was.crc + 1);
  EXPECT_EQ(health.malformed, was.malformed + 3);
  rig.hand.send(frame);
  rig.drive(2);
  EXPECT_EQ(rig.report().asked_forward, 3000);
  rig.drive(10);
  rig.hand.send(frame);
  rig.drive(2);
  EXPECT_EQ(rig.report().asked_forward, 0) << "a repeated counter";
  EXPECT_EQ(health.repeated, was.repeated + 1);
  EXPECT_EQ(health.duplicates, 0U);
  EXPECT_EQ(rig.base().health().malformed, base.malformed + 1)
      << "the extended one; the others do not concern the base";
  EXPECT_EQ(rig.base().health().unknown, base.unknown);
}

/// The frames of the front rangefinder are lost in these ticks.
bus::Fault front_range_lost(std::uint32_t from_tick, std::uint32_t to_tick) {
  bus::Fault f{bus::FaultKind::loss};
  f.from_tick = from_tick;
  f.to_tick = to_tick;
  f.direction = bus::Direction::out;
  f.match_id = can::id_of(can::message_of(can::MessageKind::range_front).function, 9);
  f.match_mask = 0x7FF;
  return f;
}

TEST(GuardNode, AFaultStandsUntilTheNextOrder) {
  GuardRig rig(open_ground(), {front_range_lost(200, 330)});
  rig.begin();
  rig.wish = kAhead;
  rig.drive(250);
  EXPECT_TRUE(stands(rig));
  EXPECT_EQ(rig.base().state(), NodeState::safe_stop);
  rig.drive(100);
  rig.wish = VelocityCommand{};
  rig.give(can::Order::resume);
  rig.drive(20);
  rig.wish = kAhead;
  rig.drive(400);
  EXPECT_EQ(rig.base().state(), NodeState::running);
  EXPECT_EQ(rig.guard().status().health.fault, whisker::Fault::none);
  EXPECT_GT(rig.speed(), 0.1);
}

TEST(GuardNode, AShortHoldIsNoFault) {
  GuardRig rig(open_ground(), {front_range_lost(200, 208)});
  rig.begin();
  rig.wish = kAhead;
  rig.drive(300);
  EXPECT_EQ(rig.base().state(), NodeState::running);
  EXPECT_EQ(rig.guard().status().health.fault, whisker::Fault::none);
  EXPECT_GT(rig.speed(), 0.25);
}

/// The wishes of the adversary, sent at its own pace, on a bus that loses, delays and damages frames.
struct Hostility {
  double path_m = 0;
  bool contact = false;
  std::uint32_t stops = 0;
};
Hostility hostile(std::uint64_t seed, std::uint32_t ticks) {
  worlds::Random place(seed);
  const Scenario scenario = worlds::beside_obstacle(place, worlds::kCrowdedClasses, false, Params{});
  worlds::Random random(~seed);
  bus::Schedule faults;
  for (const bus::FaultKind kind : {bus::FaultKind::loss, bus::FaultKind::duplicate, bus::FaultKind::reorder,
                                    bus::FaultKind::corrupt, bus::FaultKind::delay}) {
    bus::Fault f{kind};
    f.chance = random.chance(0.5) ? 0.0 : random.uniform(0, 0.03);
    faults.push_back(f);
  }
  GuardRig rig(scenario, faults, faults, seed);
  const auto hand = guard::make_operator(guard::Hand::hostile, scenario, random.bits());
  rig.begin(0);
  rig.drive(20);
  rig.wish.reset();
  const auto unit = [](double value, double units) {
    return static_cast<std::int16_t>(std::clamp(value * units, -32767.0, 32767.0));
  };
  double next_s = 0;
  Hostility result;
  for (std::uint32_t t = 0; t < ticks && !rig.plant().in_contact(); ++t) {
    const double now_s = t * 0.01;
    while (next_s <= now_s) {
      const guard::Twist twist = hand->ask({rig.plant().pose(), next_s});
      rig.hand.say(VelocityCommand{unit(twist.forward_mps, 1e4), unit(twist.turning_radps, 1e3)});
      next_s += hand->pause_s();
    }
    rig.drive(1);
    const bool latched = rig.base().state() == NodeState::safe_stop || rig.base().state() == NodeState::ready;
    const bool failed = rig.guard().status().health.fault != whisker::Fault::none;
    if ((latched || failed) && rig.base().order_state() != can::OrderState::waiting) {
      rig.give(can::Order::resume);
    }
    if (rig.report().armed == 0) rig.hand.say(VelocityCommand{});
  }
  result.path_m = rig.plant().path_length();
  result.contact = rig.plant().in_contact();
  result.stops = rig.base().health().stops;
  return result;
}

TEST(GuardNode, HostileVelocitiesTouchNothing) {
  const std::uint64_t drives = test::effort(10, 5000);
  double path_m = 0;
  std::uint32_t stops = 0;
  for (std::uint64_t seed = 1; seed <= drives; ++seed) {
    const Hostility h = hostile(seed, 2000);
    EXPECT_FALSE(h.contact) << "seed " << seed;
    path_m += h.path_m;
    stops += h.stops;
  }
  RecordProperty("path_m", std::to_string(path_m));
  RecordProperty("stops", std::to_string(stops));
  EXPECT_GT(path_m, 0.2 * static_cast<double>(drives)) << "a guard that stands touches nothing either";
}

}  // namespace
}  // namespace whisker
