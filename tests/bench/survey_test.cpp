#include "host/bench/survey.hpp"

#include <gtest/gtest.h>

#include "firmware/can/codec.hpp"

namespace whisker::bench {
namespace {

hal::CanFrame beat(std::uint8_t node, std::uint16_t boot) {
  can::Heartbeat h;
  h.boot = boot;
  return can::encode(h, node, 0);
}

TEST(Survey, KnowsEveryNodeByItsHeartbeat) {
  Survey survey;
  for (std::uint8_t node = 0; node < 16; ++node) survey.on_frame(beat(node, 1), 5);
  ASSERT_EQ(survey.nodes().size(), 14U);  // without 0 and 8, which are nobody's
  for (int robot = 1; robot <= can::kRobots; ++robot) {
    for (const can::Party party : {can::Party::controller, can::Party::base}) {
      const SeenNode* const node = survey.find(robot, party);
      ASSERT_NE(node, nullptr);
      EXPECT_EQ(node->node(), can::node_of(static_cast<std::uint8_t>(robot), party));
    }
  }
}

TEST(Survey, ANodeIsAliveForTheTimeOfThreeHeartbeats) {
  Survey survey;
  survey.on_frame(beat(1, 1), 1000);
  EXPECT_TRUE(survey.alive(1, can::Party::controller, 301000));
  EXPECT_FALSE(survey.alive(1, can::Party::controller, 301001));
  EXPECT_FALSE(survey.alive(1, can::Party::base, 1000));
  EXPECT_TRUE(survey.alive(1, can::Party::controller, 999)) << "heard after the look for frames had begun";
}

TEST(Survey, APartnerThatANodeHearsIsMissing) {
  for (const can::NodeState state : {can::NodeState::ready, can::NodeState::running}) {
    Survey survey;
    EXPECT_FALSE(survey.misses_one(1));
    can::Heartbeat h;
    h.state = state;
    survey.on_frame(can::encode(h, 1, 0), 0);
    EXPECT_TRUE(survey.misses_one(1));
    EXPECT_FALSE(survey.misses_one(2));
    survey.on_frame(beat(9, 1), 0);
    EXPECT_FALSE(survey.misses_one(1));
  }
}

TEST(Survey, APartnerThatANodeLostIsMissingIfItDrove) {
  for (const bool drove : {false, true}) {
    Survey survey;
    can::Heartbeat h;
    h.state = drove ? can::NodeState::running : can::NodeState::ready;
    survey.on_frame(can::encode(h, 1, 0), 0);
    h.state = can::NodeState::waiting;
    survey.on_frame(can::encode(h, 1, 1), 0);
    EXPECT_EQ(survey.misses_one(1), drove);
    h.boot = 7;
    survey.on_frame(can::encode(h, 1, 2), 0);
    EXPECT_FALSE(survey.misses_one(1));
  }
}

TEST(Survey, InfoCountsForItsStartOnly) {
  Survey survey;
  const auto info = [&](std::uint16_t boot) {
    return can::encode(can::Info{can::InfoPart::table_hash, boot, 0xABCD}, 1, 0);
  };
  survey.on_frame(info(1), 0);
  EXPECT_EQ(survey.find(1, can::Party::controller), nullptr);
  survey.on_frame(beat(1, 1), 0);
  survey.on_frame(info(2), 0);
  EXPECT_EQ(survey.find(1, can::Party::controller)->table_hash, std::nullopt);
  survey.on_frame(info(1), 0);
  EXPECT_EQ(survey.find(1, can::Party::controller)->table_hash, 0xABCDU);
  survey.on_frame(beat(1, 2), 0);
  EXPECT_EQ(survey.find(1, can::Party::controller)->table_hash, std::nullopt);
}

TEST(Survey, IgnoresEveryDamagedFrame) {
  for (int byte = 0; byte < 8; ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      hal::CanFrame frame = beat(1, 1);
      frame.data[byte] = static_cast<std::uint8_t>(frame.data[byte] ^ 1U << bit);
      Survey survey;
      survey.on_frame(frame, 0);
      EXPECT_TRUE(survey.nodes().empty()) << byte << " " << bit;
    }
  }
}

}  // namespace
}  // namespace whisker::bench
