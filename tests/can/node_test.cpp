// Each node alone, millisecond by millisecond; the test plays the other node.
#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

#include "firmware/can/base_node.hpp"
#include "firmware/can/controller_node.hpp"
#include "host/harness/bus/scripted_node.hpp"

namespace whisker::can {
namespace {

constexpr Identity kIdentity{1, 500, 0x000100};
constexpr std::uint16_t kPeerBoot = 600;
constexpr int kRamp = 100;

Heartbeat heartbeat(NodeState state, std::uint16_t errors = 0, std::uint16_t boot = kPeerBoot) {
  Heartbeat beat;
  beat.boot = boot;
  beat.state = state;
  beat.errors = errors;
  return beat;
}

/// The last message of its kind that the node sent.
template <class M>
M last_of(const bus::ScriptedNode& peer) {
  M message;
  EXPECT_TRUE(peer.last(message));
  return message;
}

/// A base that executes the commands of a controller that the test plays.
class BaseAlone : public testing::Test {
 protected:
  bus::MemoryBus wire_;
  BaseNode base_{wire_.attach(), kIdentity, kRamp};
  bus::ScriptedNode peer_{wire_, 1};
  std::uint32_t now_ = 1000;
  std::uint32_t tick_ = 0;
  bool beats_ = true;
  bool answers_ = true;
  NodeState peer_state_ = NodeState::running;
  std::int16_t speed_ = 2000;
  hal::WheelSpeeds speeds_{};

  BaseAlone() {
    peer_.poll(now_);
    base_.poll(now_);
  }

  /// One millisecond; every tenth one is a tick.
  void pass() {
    ++now_;
    peer_.poll(now_);
    if (beats_ && now_ % 100 == 0) peer_.say(heartbeat(peer_state_));
    base_.poll(now_);
    if (now_ % 10 != 0) return;
    speeds_ = base_.control();
    base_.send_set({++tick_, 10, {}, {}, true}, SyncMode::real_time);
    if (answers_)
      peer_.say(WheelCommand{DriveMode::drive, {speed_, speed_}, static_cast<std::uint16_t>(tick_)});
  }
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) pass();
  }
  void shake_hands() {
    peer_.greet(kPeerBoot);
    pass(2);
    ASSERT_EQ(base_.state(), NodeState::ready);
  }
  void start() {
    shake_hands();
    base_.give(Order::start, {{}, {{}, 100_mm}}, SyncMode::real_time);
    pass();
    pass();
    const auto order = last_of<MissionOrder>(peer_);
    peer_.say(MissionReply{MissionStatus::accepted, order.mission});
    pass();
    ASSERT_EQ(base_.order_state(), OrderState::accepted);
    pass(30);
    ASSERT_EQ(base_.state(), NodeState::running);
    ASSERT_EQ(speeds_.left, speed_);
  }
  /// Milliseconds until the condition holds, at most 2000.
  template <class F>
  int until(const F& holds) {
    for (int ms = 0; ms < 2000; ++ms) {
      if (holds()) return ms;
      pass();
    }
    return 2000;
  }
  int until_stopped() {
    return until([&] { return base_.state() != NodeState::running; });
  }
  /// The wheel speeds follow the ramp down, never rise, and stay at zero.
  void expect_braking() {
    int before = speeds_.left;
    const int ticks = (before + kRamp - 1) / kRamp;
    for (int i = 0; i < ticks + 2; ++i) {
      pass(10);
      EXPECT_LE(speeds_.left, before);
      EXPECT_GE(speeds_.left, before - kRamp);
      before = speeds_.left;
    }
    EXPECT_EQ(speeds_.left, 0);
    EXPECT_EQ(speeds_.right, 0);
  }
};

TEST_F(BaseAlone, NothingMovesBeforeTheHandshake) {
  pass(500);
  EXPECT_EQ(base_.state(), NodeState::waiting);
  EXPECT_EQ(speeds_.left, 0);
  EXPECT_GT(base_.health().unmatched, 10U);
}

TEST_F(BaseAlone, NothingMovesBeforeAnOrder) {
  shake_hands();
  pass(300);
  EXPECT_EQ(base_.state(), NodeState::ready);
  EXPECT_EQ(speeds_.left, 0);
}

TEST_F(BaseAlone, AnotherProtocolOrTableNeverMatches) {
  Heartbeat beat;
  beat.protocol = kProtocol + 1;
  beat.boot = kPeerBoot;
  beats_ = false;
  peer_.say(beat);
  peer_.say(Info{InfoPart::table_hash, kPeerBoot, kTableHash});
  pass(5);
  EXPECT_EQ(base_.state(), NodeState::waiting);
  EXPECT_NE(base_.errors() & Error::wrong_version, 0);
  beat.protocol = kProtocol;
  peer_.say(beat);
  peer_.say(Info{InfoPart::table_hash, kPeerBoot, kTableHash ^ 1});
  pass(5);
  EXPECT_EQ(base_.state(), NodeState::waiting);
  EXPECT_NE(base_.errors() & Error::wrong_version, 0);
  peer_.say(Info{InfoPart::table_hash, kPeerBoot, kTableHash});
  pass(5);
  EXPECT_EQ(base_.state(), NodeState::ready);
}

TEST_F(BaseAlone, LearnsTheRulesOfThisLifeOfItsPeer) {
  shake_hands();
  pass(5);
  EXPECT_EQ(base_.peer_rules(), 0U);
  peer_.say(Info{InfoPart::rules_hash, kPeerBoot - 1, 0xDEAD});
  pass(5);
  EXPECT_EQ(base_.peer_rules(), 0U);
  peer_.say(Info{InfoPart::rules_hash, kPeerBoot, 0xB02921C5});
  pass(5);
  EXPECT_EQ(base_.peer_rules(), 0xB02921C5U);
  EXPECT_EQ(base_.state(), NodeState::ready);
  beats_ = false;
  peer_.say(heartbeat({}, 0, kPeerBoot + 1));
  pass(5);
  EXPECT_EQ(base_.peer_rules(), 0U);
}

TEST_F(BaseAlone, InfoOfAnEarlierLifeDoesNotCount) {
  beats_ = false;
  peer_.say(Info{InfoPart::table_hash, kPeerBoot - 1, kTableHash});
  peer_.say(heartbeat({}));
  peer_.say(Info{InfoPart::table_hash, kPeerBoot - 1, kTableHash});
  pass(5);
  EXPECT_EQ(base_.state(), NodeState::waiting);
}

TEST_F(BaseAlone, ALateCommandStopsWithin50MillisecondsAndLatches) {
  start();
  until([&] { return now_ % 10 == 1; });  // the last answer has arrived
  answers_ = false;
  const int ms = until_stopped();
  EXPECT_EQ(ms, 50);
  EXPECT_EQ(base_.state(), NodeState::safe_stop);
  EXPECT_EQ(base_.errors(), Error::command_late);
  EXPECT_EQ(base_.health().stops, 1U);
  expect_braking();
  answers_ = true;
  pass(500);
  EXPECT_EQ(base_.state(), NodeState::safe_stop) << "commands alone do not end it";
  EXPECT_EQ(speeds_.left, 0);
}

TEST_F(BaseAlone, AStaleCommandIsNoCommand) {
  start();
  until([&] { return now_ % 10 == 1; });
  answers_ = false;
  const int ms = until([&] {
    // Always in time, but always the answer to a set 60 ms old.
    if (now_ % 10 == 5) {
      peer_.say(WheelCommand{DriveMode::drive, {speed_, speed_}, static_cast<std::uint16_t>(tick_ - 6)});
    }
    return base_.state() != NodeState::running;
  });
  EXPECT_EQ(ms, 50);
  EXPECT_GE(base_.health().stale, 4U);
}

TEST_F(BaseAlone, ACommandToStopBrakesWithoutALatch) {
  start();
  answers_ = false;
  for (int i = 0; i < 300; ++i) {
    if (now_ % 10 == 0) peer_.say(WheelCommand{});
    pass();
  }
  EXPECT_EQ(base_.state(), NodeState::running);
  EXPECT_EQ(speeds_.left, 0);
  answers_ = true;
  pass(20);
  EXPECT_EQ(speeds_.left, speed_);
}

TEST_F(BaseAlone, ALostHeartbeatStopsAfter300Milliseconds) {
  start();
  until([&] { return now_ % 100 == 1; });
  beats_ = false;
  const int ms = until_stopped();
  EXPECT_EQ(ms, 300);
  EXPECT_NE(base_.errors() & Error::peer_lost, 0);
  expect_braking();
  beats_ = true;
  pass(300);
  EXPECT_EQ(base_.state(), NodeState::safe_stop);
}

TEST_F(BaseAlone, ThePeersSafeStopStops) {
  start();
  peer_state_ = NodeState::safe_stop;
  EXPECT_LE(until_stopped(), 101);
  EXPECT_NE(base_.errors() & Error::peer_stopped, 0);
}

TEST_F(BaseAlone, ANewBootNumberStopsAndAsksForANewHandshake) {
  start();
  beats_ = false;
  peer_.say(heartbeat({}, 0, kPeerBoot + 1));
  pass();
  EXPECT_EQ(base_.state(), NodeState::safe_stop);
  EXPECT_NE(base_.errors() & Error::peer_restarted, 0);
  EXPECT_FALSE(base_.matched());
  EXPECT_EQ(base_.peer_restarts(), 1U);
  pass(5);
  EXPECT_GE(peer_.heard<InfoRequest>(), 1);
  peer_.say(Info{InfoPart::table_hash, kPeerBoot + 1, kTableHash});
  pass(5);
  EXPECT_TRUE(base_.matched());
}

TEST_F(BaseAlone, AnOrderEndsASafeStop) {
  start();
  answers_ = false;
  until_stopped();
  base_.give(Order::resume, {{}, {{}, 100_mm}}, SyncMode::real_time);
  peer_.forget();
  const int ms = until([&] { return peer_.heard<MissionOrder>() > 0; });
  EXPECT_GE(ms, 190) << "not before the wheels stand";
  pass(200);
  EXPECT_GE(peer_.heard<MissionOrder>(), 3 * 7) << "repeated until it is answered";
  const auto order = last_of<MissionOrder>(peer_);
  EXPECT_EQ(order.order, Order::resume);
  answers_ = true;
  peer_.say(MissionReply{MissionStatus::accepted, order.mission});
  pass(20);
  EXPECT_EQ(base_.state(), NodeState::running);
  EXPECT_EQ(base_.errors(), 0);
}

TEST_F(BaseAlone, AnyDataFrameOnAnEStopIdentifierStops) {
  for (const std::uint32_t id : {0x010U, 0x011U, 0x019U}) {
    for (std::uint8_t size = 0; size <= 8; ++size) {
      bus::MemoryBus wire;
      BaseNode base{wire.attach(), kIdentity, kRamp};
      bus::ScriptedNode peer{wire, 1};
      hal::CanFrame frame{id, false, false, size, {1, 2, 3, 4, 5, 6, 7, 8}};
      base.poll(1);
      peer.send(frame);
      peer.poll(2);
      base.poll(2);
      EXPECT_EQ(base.state(), NodeState::e_stopped) << id << " " << int{size};
      EXPECT_EQ(base.health().e_stops, 1U);
    }
  }
}

TEST_F(BaseAlone, OtherRobotsEStopsRemoteAndExtendedFramesDoNot) {
  const hal::CanFrame frames[] = {
      {0x012, false, false, 2, {}}, {0x01A, false, false, 2, {}}, {0x011, false, true, 2, {}},
      {0x011, true, false, 2, {}},  {0x018, false, false, 2, {}},
  };
  for (const hal::CanFrame& frame : frames) peer_.send(frame);
  pass(3);
  EXPECT_EQ(base_.state(), NodeState::waiting);
  EXPECT_EQ(base_.health().e_stops, 0U);
  EXPECT_EQ(base_.health().malformed, 2U);
  EXPECT_EQ(base_.health().foreign, 3U);
}

TEST_F(BaseAlone, AnEStopLatchesUntilAValidClearAtRest) {
  start();
  peer_.send({0x011, false, false, 0, {}});
  pass();
  EXPECT_EQ(base_.state(), NodeState::e_stopped);
  peer_.say(EStop{kClearCommand});
  pass();
  EXPECT_EQ(base_.state(), NodeState::e_stopped) << "the wheels still turn";
  expect_braking();
  hal::CanFrame wrong = peer_.frame(EStop{kClearCommand});
  wrong.data[0] ^= 1;
  peer_.send(wrong);
  wrong = peer_.frame(EStop{3});
  peer_.send(wrong);
  pass(300);
  EXPECT_EQ(base_.state(), NodeState::e_stopped);
  EXPECT_EQ(base_.errors() & Error::e_stop, Error::e_stop);
  peer_.say(EStop{kClearCommand});
  pass(2);
  EXPECT_EQ(base_.state(), NodeState::ready);
  pass(100);
  EXPECT_EQ(speeds_.left, 0) << "a clear does not start anything";
}

TEST_F(BaseAlone, BadFramesAreCountedAndNeverObeyed) {
  start();
  const std::int16_t before = speed_;
  answers_ = false;
  const BusHealth was = base_.health();
  const auto command = [&] {
    return WheelCommand{DriveMode::drive, {9999, 9999}, static_cast<std::uint16_t>(tick_)};
  };
  hal::CanFrame frame = peer_.frame(command());
  frame.data[3] ^= 0x10;
  peer_.send(frame);
  frame = peer_.frame(command());
  frame.size = 7;
  peer_.send(frame);
  frame.size = 8;
  frame.remote = true;
  peer_.send(frame);
  frame.remote = false;
  frame.extended = true;
  peer_.send(frame);
  // A value out of range, with a valid CRC.
  peer_.send(sealed(UINT64_C(5) << 12, 0x101, 8, static_cast<std::uint8_t>((counter_of(frame) + 1) % 15)));
  // A message of the base from the controller's node.
  peer_.send(encode(Sync{}, 1, 0));
  pass(2);
  const BusHealth& h = base_.health();
  EXPECT_EQ(h.crc, was.crc + 1);
  EXPECT_EQ(h.malformed, was.malformed + 4);
  EXPECT_EQ(h.out_of_range, was.out_of_range + 1);
  EXPECT_EQ(base_.command().speeds.left, before);
}

TEST_F(BaseAlone, AReplyToTheOperatorAnswersNothing) {
  shake_hands();
  base_.give(Order::start, {{}, {{}, 100_mm}}, SyncMode::real_time);
  base_.request({ParamAction::read, 4, 0});
  pass(2);
  const auto order = last_of<MissionOrder>(peer_);
  peer_.say(MissionReply{MissionStatus::accepted, order.mission, 1});
  peer_.say(ParamReply{ParamStatus::ok, 4, 1, 1});
  pass(2);
  ParamReply reply;
  EXPECT_EQ(base_.order_state(), OrderState::waiting);
  EXPECT_FALSE(base_.replied(reply));
  peer_.say(MissionReply{MissionStatus::accepted, order.mission, 0});
  peer_.say(ParamReply{ParamStatus::ok, 4, 2, 0});
  pass(2);
  EXPECT_EQ(base_.order_state(), OrderState::accepted);
  ASSERT_TRUE(base_.replied(reply));
  EXPECT_EQ(reply.value, 2U);
}

TEST_F(BaseAlone, EveryMessageOfAControllerIsUnderstoodByItsNameAndNoOther) {
  start();
  answers_ = beats_ = false;
  ParamReply none;
  for (int k = 0; k < kKinds; ++k) {
    const auto kind = static_cast<MessageKind>(k);
    // Heartbeat and Info belong to the handshake; another boot number in them would end it.
    if (kind == MessageKind::e_stop || kind == MessageKind::heartbeat || kind == MessageKind::info) continue;
    const Message& m = message_of(kind);
    const BusHealth was = base_.health();
    peer_.send(sealed(0, id_of(m.function, 1), m.size, 7));
    pass(2);
    EXPECT_EQ(base_.health().accepted, was.accepted + (m.from_controller ? 1 : 0)) << m.name;
    EXPECT_EQ(base_.health().foreign, was.foreign + (m.from_operator ? 1 : 0)) << m.name;
    EXPECT_EQ(base_.health().malformed, was.malformed + (m.from_controller || m.from_operator ? 0 : 1))
        << m.name;
    EXPECT_EQ(base_.replied(none), k >= static_cast<int>(MessageKind::param_reply)) << m.name;
  }
}

TEST_F(BaseAlone, AMessageThatNobodyKnowsIsCountedAndNeverTakenForAnother) {
  start();
  answers_ = false;
  pass(2);
  const BusHealth was = base_.health();
  std::uint32_t unknown = 0;
  for (std::uint8_t function = 1; function < 0x80; ++function) {
    MessageKind kind = MessageKind::e_stop;
    if (kind_of(id_of(function, 1), kind)) continue;
    peer_.send(sealed(0, id_of(function, 1), 8, 0));
    if (++unknown % 8 == 0) pass();
  }
  ASSERT_GT(unknown, 90U);
  peer_.send(sealed(0, id_of(0x7F, 2), 8, 0));  // of another robot
  pass(2);
  EXPECT_EQ(base_.health().unknown, was.unknown + unknown);
  EXPECT_EQ(base_.health().foreign, was.foreign + 1);
  EXPECT_EQ(base_.health().accepted, was.accepted);
  ParamReply reply;
  EXPECT_FALSE(base_.replied(reply));
}

TEST_F(BaseAlone, RepeatedAndStrayCountersAreCountedAndNeverObeyed) {
  start();
  answers_ = false;
  pass(2);
  const BusHealth was = base_.health();
  const auto tick16 = static_cast<std::uint16_t>(tick_);
  const hal::CanFrame good = peer_.frame(WheelCommand{DriveMode::drive, {1, 1}, tick16});
  peer_.send(good);
  pass();
  EXPECT_EQ(base_.command().speeds.left, 1);
  const std::uint8_t counter = counter_of(good);
  const auto with = [&](int ahead, std::int16_t speed) {
    return encode(WheelCommand{DriveMode::drive, {speed, speed}, tick16}, 1,
                  static_cast<std::uint8_t>((counter + ahead) % kAliveModulus));
  };
  peer_.send(with(0, 2));
  pass();
  EXPECT_EQ(base_.health().repeated, was.repeated + 1);
  EXPECT_EQ(base_.command().speeds.left, 1);
  peer_.send(with(kMostLost + 2, 3));
  pass();
  EXPECT_EQ(base_.health().out_of_sequence, was.out_of_sequence + 1);
  EXPECT_EQ(base_.command().speeds.left, 1);
  peer_.send(with(kMostLost + 3, 4));
  pass();
  EXPECT_EQ(base_.command().speeds.left, 4) << "the next one is judged by the stray";
  peer_.send(with(kMostLost + 3 + 5, 5));
  pass();
  EXPECT_EQ(base_.health().lost, was.lost + 4);
  EXPECT_EQ(base_.command().speeds.left, 5);
}

TEST_F(BaseAlone, AStuckCounterEndsInASafeStop) {
  start();
  until([&] { return now_ % 10 == 1; });
  answers_ = false;
  const hal::CanFrame stuck = peer_.frame(WheelCommand{DriveMode::drive, {speed_, speed_}, 0});
  const int ms = until([&] {
    if (now_ % 10 == 5) {
      peer_.send(encode(WheelCommand{DriveMode::drive, {speed_, speed_}, static_cast<std::uint16_t>(tick_)},
                        1, counter_of(stuck)));
    }
    return base_.state() != NodeState::running;
  });
  EXPECT_LE(ms, 56);
  EXPECT_GE(base_.health().repeated, 4U);
}

TEST_F(BaseAlone, SomebodyElseWithItsNumberStopsForGood) {
  start();
  bus::ScriptedNode twin{wire_, 9};
  twin.poll(now_);
  twin.say(Heartbeat{});
  pass();
  EXPECT_EQ(base_.health().duplicates, 1U);
  EXPECT_NE(base_.errors() & Error::duplicate_node, 0);
  expect_braking();
  base_.give(Order::start, {{}, {{}, 100_mm}}, SyncMode::real_time);
  pass(200);
  EXPECT_EQ(base_.state(), NodeState::safe_stop);
}

// `whisker bench watch --nodes` asks a node without a partner in the partner's place.
TEST_F(BaseAlone, AQuestionInItsNameIsNoTwin) {
  start();
  bus::ScriptedNode survey{wire_, 9};
  survey.poll(now_);
  survey.say(InfoRequest{});
  pass();
  EXPECT_EQ(base_.health().duplicates, 0U);
  EXPECT_EQ(base_.health().foreign, 1U);
  EXPECT_EQ(base_.state(), NodeState::running);
}

TEST_F(BaseAlone, AnOrderToAControllerWithATwinIsRefusedAtOnce) {
  for (const std::uint16_t error : {Error::duplicate_node, Error::bus_off_latched}) {
    if (base_.state() == NodeState::waiting) start();
    beats_ = false;
    peer_.say(heartbeat(NodeState::safe_stop, error));
    pass();
    EXPECT_EQ(base_.permanent_errors(), error);
    expect_braking();
    peer_.forget();
    base_.give(Order::resume, {{}, {{}, 100_mm}}, SyncMode::real_time);
    pass(200);
    EXPECT_EQ(base_.order_state(), OrderState::refused);
    EXPECT_EQ(peer_.heard<MissionOrder>(), 0);
    peer_.say(heartbeat(NodeState::ready));
    pass(2);
    EXPECT_EQ(base_.permanent_errors(), 0);
  }
}

TEST_F(BaseAlone, HeartbeatsCarryStateAndErrorsAtOnce) {
  start();
  answers_ = false;
  until_stopped();
  pass(2);
  const auto beat = last_of<Heartbeat>(peer_);
  EXPECT_EQ(beat.state, NodeState::safe_stop);
  EXPECT_EQ(beat.errors, Error::command_late);
  EXPECT_EQ(beat.boot, kIdentity.boot);
  const auto fault = last_of<FaultReport>(peer_);
  EXPECT_EQ(fault.severity, Severity::latched);
  EXPECT_EQ(fault.errors, Error::command_late);
  EXPECT_EQ(fault.stops, 1U);
  peer_.forget();
  pass(3000);
  EXPECT_NEAR(peer_.heard<Heartbeat>(), 30, 1);
  EXPECT_NEAR(peer_.heard<FaultReport>(), 3, 1);
  EXPECT_NEAR(peer_.heard<Diagnostics>(), 6, 1);
}

TEST_F(BaseAlone, DiagnosticsTellTheCounters) {
  shake_hands();
  hal::CanFrame bad = peer_.frame(WheelCommand{});
  bad.data[0] ^= 1;
  peer_.send(bad);
  peer_.forget();
  pass(2100);
  bool reported = false;
  for (const hal::CanFrame& f : peer_.frames()) {
    Diagnostics d;
    if (f.id >> 4 == message_of(MessageKind::diagnostics).function && decode(f, d) && d.part == 0) {
      reported = d.value[0] == 1;
    }
  }
  EXPECT_TRUE(reported);
}

/// A controller that gets its sets from a base that the test plays.
class ControllerAlone : public testing::Test {
 protected:
  bus::MemoryBus wire_;
  ControllerNode node_{wire_.attach(), kIdentity};
  bus::ScriptedNode peer_{wire_, 9};
  std::uint32_t now_ = 1000;
  std::uint32_t tick_ = 100;
  std::uint8_t mission_ = 7;
  SyncMode sync_mode_ = SyncMode::real_time;
  bool beats_ = true;
  bool sends_[5] = {true, true, true, true, true};  // ranges, wheels, sync
  int steps_ = 0;

  ControllerAlone() {
    peer_.poll(now_);
    node_.poll(now_);
  }

  void send_set(std::uint32_t tick) {
    const auto tick16 = static_cast<std::uint16_t>(tick);
    const hal::RangeReading reading{500, hal::RangeStatus::ok, 10, 1};
    if (sends_[0]) peer_.say(Range<MessageKind::range_left>{reading, tick16});
    if (sends_[1]) peer_.say(Range<MessageKind::range_front>{reading, tick16});
    if (sends_[2]) peer_.say(Range<MessageKind::range_right>{reading, tick16});
    if (sends_[3]) peer_.say(WheelState{1, static_cast<std::uint8_t>(tick % 8), {tick, tick}});
    if (sends_[4]) peer_.say(Sync{sync_mode_, tick, 10, mission_});
  }
  void pass() {
    ++now_;
    if (beats_ && now_ % 100 == 0) peer_.say(heartbeat(NodeState::running));
    if (now_ % 10 == 0) send_set(++tick_);
    peer_.poll(now_);
    node_.poll(now_);
    Order order = Order::cancel;
    Mission mission;
    node_.take_order(order, mission);
    InputSet set;
    if (node_.take_set(set)) {
      ++steps_;
      EXPECT_EQ(set.tick, tick_);
      node_.answer({1000, 1000}, {});
    }
    peer_.poll(now_);
  }
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) pass();
  }
  MissionStatus order(Order what, const Mission& mission = {{}, {{1_m, 0_m}, 100_mm}}) {
    const MissionValues values = values_of(mission);
    for (int i = 0; i < kMissionValues; ++i) {
      peer_.say(MissionValue{static_cast<MissionPart>(i + 1), mission_, values.of[i]});
    }
    peer_.say(MissionOrder{MissionPart::order, mission_, what, digest_of(values)});
    pass(2);
    return replied();
  }
  /// As a mission of its own.
  MissionStatus next(Order what, const Mission& mission = {{}, {{1_m, 0_m}, 100_mm}}) {
    ++mission_;
    return order(what, mission);
  }
  MissionStatus replied() {
    const auto reply = last_of<MissionReply>(peer_);
    EXPECT_EQ(reply.mission, mission_);
    return reply.status;
  }
  void start() {
    greet();
    ASSERT_EQ(node_.state(), NodeState::ready);
    ASSERT_EQ(order(Order::start), MissionStatus::accepted);
    pass(50);
    ASSERT_EQ(node_.state(), NodeState::running);
    ASSERT_GE(steps_, 4);
    while (now_ % 10 != 1) pass();
  }
  void greet() {
    peer_.greet(kPeerBoot);
    pass(2);
  }
  /// Milliseconds until it no longer runs, from `ms` on; at most 500.
  int until_stopped(int ms = 0) {
    for (; node_.state() == NodeState::running && ms < 500; ++ms) pass();
    return ms;
  }
  void send_all(bool sends) { std::fill(std::begin(sends_), std::end(sends_), sends); }
  DriveMode last_mode() {
    const auto command = last_of<WheelCommand>(peer_);
    return command.mode;
  }
};

TEST_F(ControllerAlone, StepsOnceOnEachCompleteSetAndNamesIt) {
  start();
  const int before = steps_;
  pass(100);
  EXPECT_EQ(steps_, before + 10);
  const auto command = last_of<WheelCommand>(peer_);
  EXPECT_EQ(command.mode, DriveMode::drive);
  EXPECT_EQ(command.tick, static_cast<std::uint16_t>(tick_));
  EXPECT_EQ(command.speeds.left, 1000);
  const auto status = last_of<NavStatus>(peer_);
  EXPECT_EQ(status.tick, command.tick);
}

TEST_F(ControllerAlone, StandsStillWithoutAMission) {
  peer_.greet(kPeerBoot);
  pass(200);
  EXPECT_EQ(steps_, 0);
  EXPECT_EQ(node_.state(), NodeState::ready);
  EXPECT_EQ(last_mode(), DriveMode::stop);
}

TEST_F(ControllerAlone, ASetWithoutOneFrameIsSkipped) {
  for (int missing = 0; missing < 5; ++missing) {
    if (missing == 0) start();
    const int before = steps_;
    const std::uint32_t skipped = node_.health().skipped;
    sends_[missing] = false;
    pass(10);
    sends_[missing] = true;
    pass(10);
    EXPECT_EQ(steps_, before + 1) << missing;
    EXPECT_EQ(node_.health().skipped, skipped + 1) << missing;
    EXPECT_EQ(node_.state(), NodeState::running) << missing;
  }
}

TEST_F(ControllerAlone, ASetWithoutTheGyroOrTheFixThatItAnnouncesIsSkipped) {
  start();
  const int before = steps_;
  const auto next = [&](bool gyro, bool fix, bool whole) {
    ++tick_;
    sends_[4] = false;
    send_set(tick_);
    sends_[4] = true;
    if (gyro && whole) peer_.say(GyroState{1, static_cast<std::uint8_t>(tick_ % 8), {}});
    for (int i = 0; fix && i < kFixValues; ++i) {
      if (whole || i != 3) peer_.say(FixValue{static_cast<FixPart>(i), static_cast<std::uint16_t>(tick_), 1});
    }
    Sync sync{sync_mode_, tick_, 10, mission_};
    sync.gyro = gyro ? 1 : 0;
    sync.fix = fix ? 1 : 0;
    peer_.say(sync);
    pass();
  };
  next(true, false, false);
  next(false, true, false);
  EXPECT_EQ(steps_, before);
  next(true, true, true);
  EXPECT_EQ(steps_, before + 1);
  EXPECT_EQ(node_.state(), NodeState::running);
}

TEST_F(ControllerAlone, RepeatsTheAnswerToAFixWithThatOfItsTick) {
  sync_mode_ = SyncMode::lockstep;
  start();
  peer_.forget();
  node_.answer_fix({FixStatus::refused, 0, 3, 2});
  node_.answer({1000, 1000}, {});
  send_set(tick_);
  node_.poll(now_);
  peer_.poll(now_);
  EXPECT_EQ(peer_.heard<FixReply>(), 2);
  const auto reply = last_of<FixReply>(peer_);
  EXPECT_EQ(reply.status, FixStatus::refused);
  EXPECT_EQ(reply.tick, static_cast<std::uint16_t>(tick_));
  EXPECT_EQ(reply.jumps, 3);
  EXPECT_EQ(reply.refused, 2);
  peer_.forget();
  pass(10);
  EXPECT_GE(peer_.heard<WheelCommand>(), 1);
  EXPECT_EQ(peer_.heard<FixReply>(), 0) << "it belongs to the tick before";
}

TEST_F(ControllerAlone, AMissingRangeBrakesAfter30MillisecondsAndLatchesAfter100) {
  for (int beam = 0; beam < 3; ++beam) {
    if (beam == 0) start();
    while (now_ % 10 != 0) pass();
    sends_[beam] = false;
    int ms = 0;
    for (; last_mode() == DriveMode::drive && ms < 500; ++ms) pass();
    EXPECT_GT(ms, 30);
    EXPECT_LE(ms, 32);
    EXPECT_EQ(node_.state(), NodeState::running);
    EXPECT_TRUE(node_.braked());
    EXPECT_EQ(until_stopped(ms), 101);
    EXPECT_NE(node_.errors() & Error::range_late, 0);
    sends_[beam] = true;
    pass(500);
    EXPECT_EQ(node_.state(), NodeState::safe_stop);
    EXPECT_EQ(next(Order::resume), MissionStatus::accepted);
    EXPECT_EQ(node_.state(), NodeState::running);
    pass(50);
  }
}

TEST_F(ControllerAlone, ARangeThatComesBackInTimeGoesOn) {
  start();
  sends_[1] = false;
  pass(60);
  EXPECT_EQ(last_mode(), DriveMode::stop);
  sends_[1] = true;
  pass(20);
  EXPECT_EQ(last_mode(), DriveMode::drive);
  EXPECT_EQ(node_.state(), NodeState::running);
  EXPECT_EQ(node_.health().stops, 0U);
}

TEST_F(ControllerAlone, MissingCountsStopAfter50Milliseconds) {
  start();
  while (now_ % 10 != 0) pass();
  sends_[3] = false;
  EXPECT_EQ(until_stopped(), 51);
  EXPECT_NE(node_.errors() & Error::odometry_late, 0);
  pass(20);
  EXPECT_EQ(last_mode(), DriveMode::stop);
}

TEST_F(ControllerAlone, ASilentBaseStopsIt) {
  start();
  send_all(false);
  EXPECT_LE(until_stopped(), 52);
  beats_ = false;
  pass(400);
  EXPECT_FALSE(node_.matched());
}

TEST_F(ControllerAlone, SetsOfAnotherMissionDoNotCount) {
  start();
  const int before = steps_;
  mission_ ^= 1;
  pass(30);
  EXPECT_EQ(steps_, before);
  EXPECT_GE(node_.health().stale, 3U);
}

TEST_F(ControllerAlone, OlderSetsAreNeverSteppedOn) {
  start();
  const int before = steps_;
  tick_ -= 20;
  pass(45);
  EXPECT_EQ(steps_, before);
  pass(60);
  EXPECT_EQ(node_.state(), NodeState::safe_stop) << "it has had no set for 100 ms";
}

TEST_F(ControllerAlone, PublishesItsTrustEvery50TicksAtEveryChangeAndAtTheEnd) {
  start();
  peer_.forget();
  RangeTrustReport trust;
  for (int i = 0; i < 100; ++i) {
    pass(10);
    node_.publish_trust(trust, false);
  }
  peer_.poll(now_);
  EXPECT_NEAR(peer_.heard<RangeTrustReport>(), 2, 1);
  peer_.forget();
  trust.level = RangeLevel::doubtful;
  while (tick_ % 50 != 7) pass(10);
  node_.publish_trust(trust, false);
  node_.publish_trust(trust, false);
  node_.publish_trust(trust, true);
  node_.poll(now_);
  peer_.poll(now_);
  EXPECT_EQ(peer_.heard<RangeTrustReport>(), 2);
  const auto last = last_of<RangeTrustReport>(peer_);
  EXPECT_EQ(last.level, RangeLevel::doubtful);
}

TEST_F(ControllerAlone, PublishesItsSigmaEvery50TicksAndAtTheEnd) {
  start();
  peer_.forget();
  for (int i = 0; i < 100; ++i) {
    pass(10);
    node_.publish_sigma({}, false);
  }
  peer_.poll(now_);
  EXPECT_NEAR(peer_.heard<PoseSigmaReport>(), 2, 1);
  peer_.forget();
  while (tick_ % 50 != 7) pass(10);
  node_.publish_sigma({2, 10, 20, 30}, false);
  node_.publish_sigma({2, 10, 20, 30}, true);
  node_.poll(now_);
  peer_.poll(now_);
  EXPECT_EQ(peer_.heard<PoseSigmaReport>(), 1);
  const auto last = last_of<PoseSigmaReport>(peer_);
  EXPECT_EQ(last.across, 20);
}

TEST_F(ControllerAlone, InLockstepTheSameSetGetsTheSameAnswer) {
  sync_mode_ = SyncMode::lockstep;
  start();
  const int before = steps_;
  peer_.forget();
  send_set(tick_);
  for (int i = 0; i < 3; ++i) {
    node_.poll(now_);
    InputSet set;
    EXPECT_FALSE(node_.take_set(set));
  }
  peer_.poll(now_);
  EXPECT_EQ(steps_, before);
  EXPECT_EQ(peer_.heard<WheelCommand>(), 1);
  EXPECT_EQ(peer_.heard<NavStatus>(), 1);
  const auto command = last_of<WheelCommand>(peer_);
  EXPECT_EQ(command.tick, static_cast<std::uint16_t>(tick_));
}

TEST_F(ControllerAlone, InLockstepItWaitsForEver) {
  sync_mode_ = SyncMode::lockstep;
  start();
  send_all(false);
  beats_ = false;
  pass(5000);
  EXPECT_EQ(node_.health().stops, 0U);
  EXPECT_EQ(node_.state(), NodeState::waiting);
  send_all(true);
  beats_ = true;
  tick_ = tick_ - 500;  // the ticks did not advance
  peer_.greet(kPeerBoot, NodeState::running);
  const int before = steps_;
  pass(20);
  EXPECT_EQ(node_.state(), NodeState::running);
  EXPECT_GT(steps_, before);
}

TEST_F(ControllerAlone, ABaseThatIsLostBeforeTheFirstStepStopsNothing) {
  send_all(false);
  greet();
  EXPECT_EQ(order(Order::start), MissionStatus::accepted);
  beats_ = false;
  pass(1000);
  EXPECT_EQ(node_.state(), NodeState::waiting);
  EXPECT_EQ(node_.health().stops, 0U);
  beats_ = true;
  send_all(true);
  pass(120);
  EXPECT_EQ(node_.state(), NodeState::running);
  EXPECT_GT(steps_, 0);
  beats_ = false;
  pass(302);
  EXPECT_EQ(node_.state(), NodeState::safe_stop) << "it has stepped";
  EXPECT_NE(node_.errors() & Error::peer_lost, 0);
}

TEST_F(ControllerAlone, AnOrderNeedsAllItsParts) {
  greet();
  peer_.say(MissionOrder{MissionPart::order, mission_, Order::start, 0});
  pass(2);
  EXPECT_EQ(replied(), MissionStatus::incomplete);
  EXPECT_EQ(node_.state(), NodeState::ready);
  EXPECT_EQ(order(Order::resume), MissionStatus::unknown);
  EXPECT_EQ(next(Order::start), MissionStatus::accepted);
}

TEST_F(ControllerAlone, OrdersToCalibrateNeedOneThatCalibrates) {
  greet();
  for (const Order what : {Order::spin, Order::straight, Order::tape, Order::measured}) {
    EXPECT_EQ(next(what), MissionStatus::unsupported);
    EXPECT_EQ(node_.state(), NodeState::ready);
  }
  node_.accept_calibrations();
  const auto so_far = [&](Order what, Length length) {
    return next(what, {{{2_m, 1_m}, {}}, {{2_m, 1_m - length}, 100_mm}});
  };
  for (const Order what : {Order::straight, Order::tape, Order::measured}) {
    EXPECT_EQ(so_far(what, 0_mm), MissionStatus::out_of_range);
    EXPECT_EQ(so_far(what, 499_mm), MissionStatus::out_of_range);
    EXPECT_EQ(node_.state(), NodeState::ready);
    EXPECT_EQ(so_far(what, 500_mm), MissionStatus::accepted);
    EXPECT_EQ(node_.state(), what == Order::measured ? NodeState::ready : NodeState::running);
    next(Order::cancel);
  }
}

TEST_F(ControllerAlone, EveryOrderInEveryStateIsAnsweredByName) {
  node_.accept_calibrations();
  constexpr Order kEvery[] = {Order::start, Order::cancel,   Order::resume,  Order::spin,
                              Order::tape,  Order::straight, Order::measured};
  const auto try_all = [&](NodeState state, MissionStatus resume, MissionStatus others) {
    for (const Order what : kEvery) {
      ASSERT_EQ(node_.state(), state) << kOrderWords[static_cast<int>(what)];
      next(what);
      const MissionStatus expected = what == Order::resume ? resume
                                     : !drives(what)       ? MissionStatus::accepted
                                                           : others;
      EXPECT_EQ(replied(), expected) << kOrderWords[static_cast<int>(what)];
      if (state == NodeState::e_stopped || node_.state() == state) continue;
      const bool runs = state == NodeState::running;
      EXPECT_EQ(next(runs ? Order::spin : Order::cancel), MissionStatus::accepted);
    }
  };
  greet();
  try_all(NodeState::ready, MissionStatus::unknown, MissionStatus::accepted);
  next(Order::spin);
  try_all(NodeState::running, MissionStatus::accepted, MissionStatus::accepted);
  peer_.send({0x010, false, false, 1, {0}});
  pass(2);
  try_all(NodeState::e_stopped, MissionStatus::unknown, MissionStatus::refused);
}

TEST_F(ControllerAlone, AnEStopRefusesOrdersUntilItIsCleared) {
  start();
  peer_.send({0x010, false, false, 1, {0}});
  pass(2);
  EXPECT_EQ(node_.state(), NodeState::e_stopped);
  pass(20);
  EXPECT_EQ(last_mode(), DriveMode::stop);
  EXPECT_EQ(next(Order::start), MissionStatus::refused);
  peer_.say(EStop{kClearCommand});
  pass(2);
  EXPECT_EQ(node_.state(), NodeState::ready);
  EXPECT_EQ(order(Order::start), MissionStatus::accepted);
}

TEST_F(ControllerAlone, RefusesAStartOrAGoalThatIsTooFarOutByName) {
  greet();
  const Length beyond = kPlaceLimit + micrometres(1);
  const planning::Goal goal{{1_m, 0_m}, 100_mm};
  const Mission missions[] = {{{{beyond, 0_m}, {}}, goal},
                              {{{0_m, -beyond}, {}}, goal},
                              {{}, {{-beyond, 0_m}, 100_mm}},
                              {{}, {{0_m, Length::from_raw(INT32_MAX)}, 100_mm}}};
  for (const Mission& mission : missions) {
    EXPECT_EQ(next(Order::start, mission), MissionStatus::out_of_range);
    EXPECT_EQ(node_.state(), NodeState::ready);
  }
  EXPECT_EQ(next(Order::start, {{{kPlaceLimit, -kPlaceLimit}, {}}, {{-kPlaceLimit, kPlaceLimit}, 100_mm}}),
            MissionStatus::accepted);
}

TEST_F(ControllerAlone, ANewBaseForgetsTheMission) {
  start();
  beats_ = false;
  peer_.greet(kPeerBoot + 1);
  pass(5);
  EXPECT_EQ(node_.state(), NodeState::safe_stop);
  const int before = steps_;
  pass(30);
  EXPECT_EQ(steps_, before);
  EXPECT_EQ(order(Order::start), MissionStatus::accepted);
}

TEST_F(ControllerAlone, ParametersAreReadCheckedAndCommitted) {
  greet();
  const auto ask = [&](const ParamRequest& request) {
    peer_.say(request);
    pass(2);
    const auto reply = last_of<ParamReply>(peer_);
    EXPECT_EQ(reply.index, request.index);
    return reply;
  };
  // 0: body radius, um.
  EXPECT_EQ(ask({ParamAction::read, 0, 0}).value, 90000U);
  EXPECT_EQ(ask({ParamAction::write, 0, 19999}).status, ParamStatus::out_of_range);
  EXPECT_EQ(ask({ParamAction::read, 0, 0}).value, 90000U);
  EXPECT_EQ(ask({ParamAction::write, 0, 95000}).status, ParamStatus::ok);
  EXPECT_EQ(node_.params().body.radius, 90_mm) << "not before a commit";
  EXPECT_EQ(ask({ParamAction::commit, 255, 0}).status, ParamStatus::ok);
  EXPECT_EQ(node_.params().body.radius, 95_mm);
  EXPECT_EQ(ask({ParamAction::read, 200, 0}).status, ParamStatus::no_such);
  EXPECT_EQ(ask({ParamAction::write, 200, 0}).status, ParamStatus::no_such);
  // 2: the track; wider than the body.
  EXPECT_EQ(ask({ParamAction::write, 2, 2000000}).status, ParamStatus::ok);
  const ParamReply reply = ask({ParamAction::commit, 255, 0});
  EXPECT_EQ(reply.status, ParamStatus::inconsistent);
  EXPECT_EQ(reply.value, static_cast<std::uint32_t>(ParamFault::track_wider_than_body));
  EXPECT_EQ(node_.params().body.track, 140_mm);
  EXPECT_EQ(ask({ParamAction::write, 2, 140000}).status, ParamStatus::ok);
  // 38: the longest gap, ms.
  const auto gap_of = [&](std::uint32_t ms) {
    EXPECT_EQ(ask({ParamAction::write, 38, ms}).status, ParamStatus::ok);
    return ask({ParamAction::commit, 255, 0});
  };
  EXPECT_EQ(gap_of(58).value, static_cast<std::uint32_t>(ParamFault::gap_below_period))
      << "the base holds a command for longer";
  EXPECT_EQ(gap_of(59).status, ParamStatus::ok);
  order(Order::start);
  EXPECT_EQ(ask({ParamAction::write, 0, 90000}).status, ParamStatus::busy);
  EXPECT_EQ(ask({ParamAction::commit, 255, 0}).status, ParamStatus::busy);
  EXPECT_EQ(ask({ParamAction::read, 0, 0}).value, 95000U);
}

}  // namespace
}  // namespace whisker::can
