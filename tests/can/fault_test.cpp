// Every fault of the bus, with both nodes and a simulated body: start of braking, standstill, counters and
// recovery.
#include <gtest/gtest.h>

#include "tests/can/rig.hpp"

namespace whisker {
namespace {

using bus::Direction;
using bus::Fault;
using bus::FaultKind;
using can::Error;
using can::MessageKind;
using can::NodeState;
using test::Rig;

constexpr std::uint32_t kFrom = Rig::kFault;
constexpr std::uint32_t kExact = 0x7FF;
constexpr std::uint32_t kLong = 60;  // ticks: longer than every time-out

std::uint32_t from_controller(MessageKind kind) { return can::id_of(can::message_of(kind).function, 1); }
std::uint32_t from_base(MessageKind kind) { return can::id_of(can::message_of(kind).function, 9); }

/// A fault for some ticks, on frames with one identifier; 0: on all frames or on the port.
Fault fault(FaultKind kind, std::uint32_t ticks, std::uint32_t id = 0) {
  Fault f{};
  f.kind = kind;
  f.from_tick = kFrom;
  f.to_tick = kFrom + ticks;
  f.direction = bus::of_port(kind) ? Direction::both : Direction::out;
  f.match_id = id;
  f.match_mask = id != 0 ? kExact : 0;
  f.chance = 1;
  f.length = 1;
  f.ticks = 1;
  return f;
}

constexpr std::uint32_t kUntilItCruises = 700;

/// Ticks from the first one with the fault to the first that does not follow the controller; UINT32_MAX:
/// none.
std::uint32_t latency(const Rig& rig) {
  const auto& seen = rig.seen();
  for (std::uint32_t t = kFrom; t < seen.size(); ++t) {
    const bool brakes = seen[t].speeds.left == seen[t - 1].speeds.left - 100;
    if (brakes || (seen[t].speeds.left == 0 && seen[t].speeds.right == 0)) return t - kFrom;
  }
  return UINT32_MAX;
}

struct Expected {
  std::uint32_t most_latency;    ///< ticks
  std::uint16_t base_error = 0;  ///< bits that must be reported
  std::uint16_t controller_error = 0;
};

/// The wheels brake in time, stop within the braking time, and a new order makes the robot run again.
void expect_stop_and_resume(Rig& rig, const Expected& expected, std::uint32_t fault_ticks) {
  rig.cruise();
  ASSERT_EQ(rig.now().base, NodeState::running);
  ASSERT_EQ(rig.now().speeds.left, 3000);
  rig.drive(fault_ticks);
  const std::uint32_t ticks = latency(rig);
  ASSERT_LE(ticks, expected.most_latency);
  EXPECT_GE(ticks + 1, expected.most_latency < 3 ? 0U : 2U) << "no fault is seen before its time-out";
  // From 0.3 m/s at 1 m/s^2.
  const std::uint32_t rest = kFrom + ticks + 30;
  ASSERT_GT(rig.seen().size(), rest);
  for (std::uint32_t t = rest; t < rig.seen().size(); ++t) {
    ASSERT_EQ(rig.seen()[t].speeds.left, 0) << t;
    ASSERT_EQ(rig.seen()[t].speeds.right, 0) << t;
  }
  std::uint16_t base = 0, controller = 0;
  for (const test::Seen& s : rig.seen()) {
    base |= s.base_errors;
    controller |= s.controller_errors;
  }
  EXPECT_EQ(base & expected.base_error, expected.base_error) << base;
  EXPECT_EQ(controller & expected.controller_error, expected.controller_error) << controller;
  rig.drive(60);
  EXPECT_EQ(rig.now().base, NodeState::safe_stop) << "latched until a new order";
  EXPECT_EQ(rig.now().speeds.left, 0);
  rig.give(can::Order::resume);
  rig.drive(kUntilItCruises);
  EXPECT_EQ(rig.now().base, NodeState::running);
  EXPECT_EQ(rig.now().controller, NodeState::running);
  EXPECT_GT(rig.now().speeds.left, 2000);
  EXPECT_EQ(rig.status().health.fault, whisker::Fault::none);
  EXPECT_NEAR(rig.status().pose.at.x.raw() * 1e-6, rig.plant().pose().at.x, 0.01)
      << "it knows how far it braked";
}

/// The robot continues its mission.
void expect_no_latch(Rig& rig, std::uint32_t fault_ticks) {
  rig.cruise();
  rig.drive(fault_ticks + 150);
  EXPECT_EQ(rig.base().health().stops, 0U);
  EXPECT_EQ(rig.controller().health().stops, 0U);
  EXPECT_EQ(rig.now().base, NodeState::running);
  EXPECT_EQ(rig.now().speeds.left, 3000);
  EXPECT_EQ(rig.status().health.fault, whisker::Fault::none);
}

TEST(Faults, LosingOneCommandChangesNothing) {
  Rig rig(test::open_ground(), {}, {fault(FaultKind::loss, 1, from_controller(MessageKind::wheel_command))});
  expect_no_latch(rig, 1);
  EXPECT_EQ(rig.base().health().lost, 1U);
  EXPECT_EQ(latency(rig), UINT32_MAX);
}

TEST(Faults, FortyMillisecondsWithoutAnythingAreOutlived) {
  Rig rig(test::open_ground(), {fault(FaultKind::loss, 4)}, {fault(FaultKind::loss, 4)});
  expect_no_latch(rig, 4);
  EXPECT_GE(rig.controller().health().skipped, 4U);
}

TEST(Faults, LosingAllCommandsStops) {
  Rig rig(test::open_ground(), {},
          {fault(FaultKind::loss, kLong, from_controller(MessageKind::wheel_command))});
  expect_stop_and_resume(rig, {6, Error::command_late, Error::peer_stopped}, kLong);
}

TEST(Faults, LosingOneBeamBrakesAndGoesOn) {
  for (const MessageKind kind :
       {MessageKind::range_left, MessageKind::range_front, MessageKind::range_right}) {
    Rig rig(test::open_ground(), {fault(FaultKind::loss, 7, from_base(kind))}, {});
    expect_no_latch(rig, 7);
    EXPECT_LE(latency(rig), 4U);
  }
}

TEST(Faults, LosingOneBeamForLongStops) {
  Rig rig(test::open_ground(), {fault(FaultKind::loss, kLong, from_base(MessageKind::range_front))}, {});
  expect_stop_and_resume(rig, {4, Error::peer_stopped, Error::range_late}, kLong);
}

TEST(Faults, LosingTheCountsStops) {
  Rig rig(test::open_ground(), {fault(FaultKind::loss, kLong, from_base(MessageKind::wheel_state))}, {});
  expect_stop_and_resume(rig, {6, 0, Error::odometry_late}, kLong);
}

TEST(Faults, LosingTheSyncStops) {
  Rig rig(test::open_ground(), {fault(FaultKind::loss, kLong, from_base(MessageKind::sync))}, {});
  expect_stop_and_resume(rig, {6, Error::command_late, 0}, kLong);
}

TEST(Faults, LosingTheHeartbeatsOfEitherStops) {
  Rig rig(test::open_ground(), {}, {fault(FaultKind::loss, 100, from_controller(MessageKind::heartbeat))});
  expect_stop_and_resume(rig, {31, Error::peer_lost, 0}, 100);
  Rig other(test::open_ground(), {fault(FaultKind::loss, 100, from_base(MessageKind::heartbeat))}, {});
  expect_stop_and_resume(other, {31, 0, Error::peer_lost}, 100);
}

TEST(Faults, DelayedCommandsAreTooOld) {
  Fault f = fault(FaultKind::delay, kLong, from_controller(MessageKind::wheel_command));
  f.ticks = 7;
  Rig rig(test::open_ground(), {}, {f});
  expect_stop_and_resume(rig, {6, Error::command_late, 0}, kLong);
}

TEST(Faults, DelayedSetsMakeOldCommands) {
  Fault f = fault(FaultKind::delay, kLong);
  f.ticks = 7;
  Rig rig(test::open_ground(), {f}, {});
  expect_stop_and_resume(rig, {6, 0, Error::odometry_late}, kLong);
}

TEST(Faults, DuplicatesAreCountedAndChangeNothing) {
  Rig rig(test::open_ground(), {fault(FaultKind::duplicate, kLong)}, {fault(FaultKind::duplicate, kLong)});
  expect_no_latch(rig, kLong);
  EXPECT_GE(rig.base().health().repeated, 2 * kLong);
  EXPECT_GE(rig.controller().health().repeated, 5 * kLong);
  EXPECT_EQ(latency(rig), UINT32_MAX);
}

TEST(Faults, FramesInAnotherOrderWithinASetChangeNothing) {
  Rig rig(test::open_ground(), {fault(FaultKind::reorder, kLong)}, {});
  expect_no_latch(rig, kLong);
}

TEST(Faults, CorruptCommandsStop) {
  Rig rig(test::open_ground(), {},
          {fault(FaultKind::corrupt, kLong, from_controller(MessageKind::wheel_command))});
  expect_stop_and_resume(rig, {6, Error::command_late, 0}, kLong);
  EXPECT_GE(rig.base().health().crc, 20U);
}

TEST(Faults, CorruptCountsStop) {
  Rig rig(test::open_ground(), {fault(FaultKind::corrupt, kLong, from_base(MessageKind::wheel_state))}, {});
  expect_stop_and_resume(rig, {6, 0, Error::odometry_late}, kLong);
  EXPECT_GE(rig.controller().health().crc, 20U);
}

TEST(Faults, CommandsOfAnotherShapeStop) {
  for (const FaultKind kind : {FaultKind::wrong_size, FaultKind::make_remote, FaultKind::make_extended}) {
    Rig rig(test::open_ground(), {}, {fault(kind, kLong, from_controller(MessageKind::wheel_command))});
    expect_stop_and_resume(rig, {6, Error::command_late, 0}, kLong);
    EXPECT_GE(rig.base().health().malformed, 6U);
  }
}

TEST(Faults, AStuckSenderStops) {
  Rig rig(test::open_ground(), {},
          {fault(FaultKind::freeze, kLong, from_controller(MessageKind::wheel_command))});
  expect_stop_and_resume(rig, {7, Error::command_late, 0}, kLong);
  EXPECT_GE(rig.base().health().repeated, 5U);
}

TEST(Faults, AStuckSensorFrameStops) {
  Rig rig(test::open_ground(), {fault(FaultKind::freeze, kLong, from_base(MessageKind::range_left))}, {});
  expect_stop_and_resume(rig, {5, 0, Error::range_late}, kLong);
  EXPECT_GE(rig.controller().health().repeated, 5U);
}

TEST(Faults, AMasqueradeIsNoCommand) {
  Fault f = fault(FaultKind::masquerade, kLong, from_controller(MessageKind::nav_status));
  f.id = from_controller(MessageKind::wheel_command);
  Rig rig(test::open_ground(), {}, {f});
  expect_no_latch(rig, kLong);
  EXPECT_GE(rig.base().health().crc, kLong - 1);
}

TEST(Faults, ABabblingNodeStops) {
  Fault f = fault(FaultKind::babble, kLong);
  f.length = 40;
  Rig rig(test::open_ground(), {}, {f});
  expect_stop_and_resume(rig, {6, Error::command_late, 0}, kLong);
}

TEST(Faults, BusOffOfTheControllerStops) {
  Rig rig(test::open_ground(), {}, {fault(FaultKind::bus_off, 2)});
  expect_stop_and_resume(rig, {6, Error::command_late, Error::bus_off}, kLong);
  EXPECT_EQ(rig.controller_port().counts().bus_offs, 1U);
}

TEST(Faults, BusOffOfTheBaseStopsAtOnce) {
  Rig rig(test::open_ground(), {fault(FaultKind::bus_off, 2)}, {});
  expect_stop_and_resume(rig, {1, Error::bus_off, 0}, kLong);
}

TEST(Faults, BusOffAgainAndAgainLatchesForGood) {
  Rig rig(test::open_ground(), {fault(FaultKind::bus_off, 200)}, {});
  rig.cruise();
  rig.drive(300);
  EXPECT_EQ(rig.base_port().counts().bus_offs, 5U);
  EXPECT_NE(rig.base().errors() & Error::bus_off_latched, 0);
  rig.give(can::Order::resume);
  rig.drive(100);
  EXPECT_EQ(rig.now().base, NodeState::off_bus);
  EXPECT_EQ(rig.now().speeds.left, 0);
}

TEST(Faults, AnErrorPassiveNodeGoesOn) {
  Rig rig(test::open_ground(), {fault(FaultKind::passive, kLong)}, {fault(FaultKind::passive, kLong)});
  expect_no_latch(rig, kLong);
}

TEST(Faults, AnInterfaceThatGoesDownStops) {
  Rig rig(test::open_ground(), {}, {fault(FaultKind::down, kLong)});
  expect_stop_and_resume(rig, {6, Error::command_late, Error::bus_off}, kLong);
  Rig other(test::open_ground(), {fault(FaultKind::down, kLong)}, {});
  expect_stop_and_resume(other, {1, Error::bus_off, 0}, kLong);
}

TEST(Faults, ADriverWithoutRoomStops) {
  Rig rig(test::open_ground(), {}, {fault(FaultKind::full, kLong)});
  expect_stop_and_resume(rig, {6, Error::command_late, 0}, kLong);
  EXPECT_GT(rig.controller_port().counts().expired, 5U);
}

TEST(Faults, AnOverrunReceiverStops) {
  Fault f = fault(FaultKind::overrun, kLong);
  f.length = 2;
  f.direction = Direction::in;
  Rig rig(test::open_ground(), {}, {f});
  expect_stop_and_resume(rig, {6, 0, Error::odometry_late}, kLong);
  EXPECT_GT(rig.controller_port().counts().overrun, 5U);
}

TEST(Faults, AnEStopStopsAtOnceAndLatches) {
  Rig rig(test::open_ground(), {}, {});
  rig.cruise();
  rig.third.send({0x010, false, false, 0, {}});
  rig.drive(40);
  EXPECT_LE(latency(rig), 1U);
  EXPECT_EQ(rig.now().base, NodeState::e_stopped);
  EXPECT_EQ(rig.now().controller, NodeState::e_stopped);
  EXPECT_EQ(rig.now().speeds.left, 0);
  rig.give(can::Order::resume);
  rig.drive(100);
  EXPECT_EQ(rig.now().base, NodeState::e_stopped);
  EXPECT_EQ(rig.base().order_state(), can::OrderState::refused);
  rig.third.send(can::encode(can::EStop{can::kClearCommand}, 0, 0));
  rig.drive(20);
  EXPECT_EQ(rig.now().base, NodeState::ready);
  EXPECT_EQ(rig.now().controller, NodeState::ready);
  rig.give(can::Order::resume);
  rig.drive(kUntilItCruises);
  EXPECT_EQ(rig.now().base, NodeState::running);
  EXPECT_GT(rig.now().speeds.left, 2000);
}

TEST(Faults, ATwinOfTheControllerStopsForGood) {
  Rig rig(test::open_ground(), {}, {});
  rig.cruise();
  can::Heartbeat beat;
  beat.boot = 99;
  rig.third.send(can::encode(beat, 1, 3));
  rig.drive(60);
  EXPECT_LE(latency(rig), 6U);
  EXPECT_EQ(rig.now().speeds.left, 0);
  EXPECT_NE(rig.controller().errors() & Error::duplicate_node, 0);
  rig.give(can::Order::start);
  rig.drive(200);
  EXPECT_EQ(rig.now().speeds.left, 0);
}

TEST(Faults, TwoRobotsOnOneBusDoNotMindEachOther) {
  Rig rig(test::open_ground(), {}, {});
  rig.third.greet(5);
  rig.cruise();
  const std::uint32_t foreign = rig.base().health().foreign;
  for (int i = 0; i < 50; ++i) {
    rig.third.say(can::WheelCommand{can::DriveMode::drive, {-3000, -3000}, 0});
    rig.third.send({0x013, false, false, 0, {}});  // the other robot's E-stop
    rig.drive(1);
  }
  EXPECT_EQ(rig.now().base, NodeState::running);
  EXPECT_EQ(rig.now().speeds.left, 3000);
  EXPECT_GE(rig.base().health().foreign, foreign + 100);
}

}  // namespace
}  // namespace whisker
