// A controller takes a response table from a base that the test plays.
#include <memory>

#include <gtest/gtest.h>

#include "firmware/can/controller_node.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "host/harness/bus/scripted_node.hpp"

namespace whisker::can {
namespace {

using fuzzy::kResponseTable;
using fuzzy::kTableNodes;

constexpr std::uint16_t kBoot = 600;

fuzzy::Bilinear::Table flat() {
  fuzzy::Bilinear::Table table{};
  for (std::uint16_t i = 0; i < kTableNodes; ++i) fuzzy::node_of(table, i) = {0, 4915};
  return table;
}

class RulesAtANode : public testing::Test {
 protected:
  const fuzzy::Bilinear::Table table_ = flat();
  const std::uint32_t hash_ = fuzzy::digest(table_);
  bus::MemoryBus wire_;
  RulesServerWith<2> rules_{kResponseTable};
  std::unique_ptr<ControllerNode> node_;
  bus::ScriptedNode peer_{wire_, 9};
  std::uint32_t now_ = 1000;
  std::uint32_t tick_ = 100, counts_ = 5000;
  std::uint8_t mission_ = 7;
  std::uint16_t boot_ = kBoot;

  void connect(RulesServer* rules) {
    node_ = std::make_unique<ControllerNode>(wire_.attach(), Identity{1, 500, 0, 0xABC}, rules);
    peer_.poll(now_);
    pass(1);
    peer_.greet(boot_);
    pass(2);
    ASSERT_EQ(node_->state(), NodeState::ready);
  }
  void pass(int ms) {
    for (; ms > 0; --ms) {
      ++now_;
      if (now_ % 100 == 0) {
        Heartbeat beat;
        beat.boot = boot_;
        beat.state = NodeState::running;
        peer_.say(beat);
      }
      peer_.poll(now_);
      node_->poll(now_);
      Order order = Order::cancel;
      Mission mission;
      node_->take_order(order, mission);
      InputSet set;
      if (node_->take_set(set)) node_->answer({}, {});
      peer_.poll(now_);
    }
  }
  /// A tick; the wheels turn by so many counts.
  void tick(std::uint32_t turned) {
    counts_ += turned;
    const auto tick16 = static_cast<std::uint16_t>(++tick_);
    const hal::RangeReading reading{500, hal::RangeStatus::ok, 10, 1};
    peer_.say(Range<MessageKind::range_left>{reading, tick16});
    peer_.say(Range<MessageKind::range_front>{reading, tick16});
    peer_.say(Range<MessageKind::range_right>{reading, tick16});
    peer_.say(WheelState{1, static_cast<std::uint8_t>(tick_ % 8), {counts_, counts_}});
    peer_.say(Sync{SyncMode::real_time, tick_, 10, mission_});
    pass(10);
  }
  MissionStatus order(Order what) {
    const MissionValues values = values_of({{}, {{1_m, 0_m}, 100_mm}});
    for (int i = 0; i < kMissionValues; ++i) {
      peer_.say(MissionValue{static_cast<MissionPart>(i + 1), mission_, values.of[i]});
    }
    peer_.say(MissionOrder{MissionPart::order, mission_, what, digest_of(values)});
    pass(2);
    MissionReply reply;
    EXPECT_TRUE(peer_.last(reply));
    return reply.status;
  }
  void send_parts() {
    for (std::uint16_t i = 0; i < kTableNodes; ++i) {
      peer_.say(RulesPart{1, i, fuzzy::node_of(table_, i)});
      if (i % 8 == 7) pass(1);
    }
    pass(1);
  }
  RulesStatus activate() { return ask({1, RulesAction::activate, hash_}); }
  RulesStatus ask(const RulesOrder& order) {
    peer_.forget();
    peer_.say(order);
    pass(2);
    RulesReply reply;
    EXPECT_EQ(peer_.heard<RulesReply>(), 1);
    EXPECT_TRUE(peer_.last(reply));
    EXPECT_EQ(reply.upload, order.upload);
    return reply.status;
  }
  /// The last hash that the controller has named.
  std::uint32_t named() {
    std::uint32_t hash = 0;
    for (const hal::CanFrame& frame : peer_.frames()) {
      Info info;
      if (frame.id >> 4 == message_of(MessageKind::info).function && decode(frame, info) &&
          info.part == InfoPart::rules_hash) {
        hash = info.value;
      }
    }
    return hash;
  }
};

TEST_F(RulesAtANode, TheGreetingNamesTheActiveTable) {
  connect(&rules_);
  EXPECT_EQ(named(), fuzzy::digest(kResponseTable));
  send_parts();
  EXPECT_EQ(peer_.heard<RulesReply>(), (kTableNodes + 7) / 8);
  ASSERT_EQ(activate(), RulesStatus::activated);
  EXPECT_EQ(named(), hash_);
  ASSERT_EQ(ask({2, RulesAction::restore, 0}), RulesStatus::activated);
  EXPECT_EQ(named(), fuzzy::digest(kResponseTable));
}

TEST_F(RulesAtANode, WithoutRoomItSaysSo) {
  connect(nullptr);
  EXPECT_EQ(named(), 0xABCU) << "that of its Identity";
  EXPECT_EQ(activate(), RulesStatus::unsupported);
  EXPECT_EQ(ask({1, RulesAction::restore, 0}), RulesStatus::unsupported);
  peer_.say(RulesPart{1, 7, {}});
  pass(2);
  RulesReply reply;
  ASSERT_TRUE(peer_.last(reply));
  EXPECT_EQ(reply.status, RulesStatus::unsupported);
  EXPECT_EQ(named(), 0U) << "nothing new";
}

TEST_F(RulesAtANode, WhileAMissionRunsNothingIsTakenOrActivated) {
  connect(&rules_);
  send_parts();
  ASSERT_EQ(order(Order::start), MissionStatus::accepted);
  tick(0);
  EXPECT_EQ(activate(), RulesStatus::running);
  EXPECT_EQ(ask({1, RulesAction::restore, 0}), RulesStatus::running);
  peer_.say(RulesPart{2, 0, {}});
  peer_.say(RulesPart{2, 7, {}});
  pass(2);
  RulesReply reply;
  ASSERT_TRUE(peer_.last(reply));
  EXPECT_EQ(reply.status, RulesStatus::running);
  EXPECT_EQ(&rules_.active(), &kResponseTable);
  ++mission_;
  ASSERT_EQ(order(Order::cancel), MissionStatus::accepted);
  EXPECT_EQ(activate(), RulesStatus::activated) << "what has come before is still there";
}

TEST_F(RulesAtANode, WhileTheWheelsTurnNothingIsActivated) {
  connect(&rules_);
  tick(0);
  send_parts();
  tick(1);
  EXPECT_EQ(activate(), RulesStatus::moving);
  pass(80);
  EXPECT_EQ(activate(), RulesStatus::moving);
  EXPECT_EQ(&rules_.active(), &kResponseTable);
  pass(20);
  EXPECT_EQ(activate(), RulesStatus::activated);
}

TEST_F(RulesAtANode, WheelsThatStandDoNotHinder) {
  connect(&rules_);
  for (int i = 0; i < 5; ++i) tick(0);
  send_parts();
  tick(0);
  EXPECT_EQ(activate(), RulesStatus::activated);
}

// The robot of that mission drives with the table before.
TEST_F(RulesAtANode, AnotherTableEndsTheMissionThatCouldBeResumed) {
  connect(&rules_);
  ASSERT_EQ(order(Order::start), MissionStatus::accepted);
  tick(0);
  pass(400);
  ASSERT_EQ(node_->state(), NodeState::safe_stop);
  send_parts();
  ASSERT_EQ(activate(), RulesStatus::activated);
  ++mission_;
  EXPECT_EQ(order(Order::resume), MissionStatus::unknown);
  ++mission_;
  EXPECT_EQ(order(Order::start), MissionStatus::accepted);
}

TEST_F(RulesAtANode, PartsOfABaseThatRestartsAreVoid) {
  connect(&rules_);
  send_parts();
  boot_ = kBoot + 1;
  peer_.greet(boot_);
  pass(2);
  EXPECT_EQ(activate(), RulesStatus::incomplete);
  EXPECT_EQ(&rules_.active(), &kResponseTable);
}

}  // namespace
}  // namespace whisker::can
