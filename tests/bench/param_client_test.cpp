#include "host/lab/bench/param_client.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "firmware/can/codec.hpp"
#include "firmware/can/controller_node.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/params/words.hpp"
#include "host/harness/bus/memory_bus.hpp"
#include "host/lab/bench/param_values.hpp"
#include "host/lab/bench/survey.hpp"

namespace whisker::bench {
namespace {

constexpr std::uint8_t kTrack = 2, kMaxSpeed = 3;
constexpr std::uint32_t kWiderThanBody = 190000, kBeyondRange = 9000000;

std::string name_of(std::uint8_t index) { return "p" + std::to_string(index); }

/// A controller that is polled each millisecond that the client waits.
class Bench : public ::testing::Test, public hil::Clock {
 protected:
  std::uint64_t now_us() override { return now_us_; }
  void wait(std::uint64_t most_us) override {
    now_us_ += most_us + held_up_us_;
    if (polls_left_ == 0) return;
    --polls_left_;
    controller_.poll(static_cast<std::uint32_t>(now_us_ / 1000));
  }
  void connect() { client_.connect(); }
  Change change(std::uint8_t index, std::uint32_t after) {
    return {index, raw_param(Params{}, index), after};
  }

  std::uint64_t now_us_ = 1000000;
  std::uint64_t held_up_us_ = 0;
  int polls_left_ = 1000000;
  bus::MemoryBus bus_;
  bus::MemoryPort& port_ = bus_.attach();
  can::RulesServerWith<1> rules_{fuzzy::kResponseTable};
  can::ControllerNode controller_{bus_.attach(), {1, 1, 0}, &rules_};
  BaseClient client_{port_, *this, {1, 2, 0}, {500, nullptr}};
};

TEST_F(Bench, ReadsEveryParameterAndNoOther) {
  connect();
  for (int i = 0; i < kParams; ++i) {
    const auto index = static_cast<std::uint8_t>(i);
    if (is_derived(i)) {
      EXPECT_EQ(client_.read(index), std::nullopt) << i;
    } else {
      EXPECT_EQ(client_.read(index), raw_param(Params{}, i)) << i;
    }
  }
  EXPECT_EQ(client_.read(kParams), std::nullopt);
}

TEST_F(Bench, WritesAndCommits) {
  connect();
  const Written written = write_all(client_, {change(kMaxSpeed, 250000)}, name_of);
  EXPECT_TRUE(written.committed);
  EXPECT_EQ(controller_.params().wheels.max_speed.raw(), 250000);
  EXPECT_EQ(client_.read(kMaxSpeed), 250000U);
}

TEST_F(Bench, ARefusedValueLeavesNothingStaged) {
  connect();
  const Written written =
      write_all(client_, {change(kTrack, 150000), change(kMaxSpeed, kBeyondRange)}, name_of);
  EXPECT_FALSE(written.committed);
  EXPECT_EQ(written.refused, kMaxSpeed);
  EXPECT_EQ(written.status, can::ParamStatus::out_of_range);
  EXPECT_EQ(client_.read(kTrack), raw_param(Params{}, kTrack));
}

TEST_F(Bench, ValuesThatDoNotFitTogetherLeaveNothingStaged) {
  connect();
  const Written written =
      write_all(client_, {change(kMaxSpeed, 250000), change(kTrack, kWiderThanBody)}, name_of);
  EXPECT_FALSE(written.committed);
  EXPECT_EQ(written.status, can::ParamStatus::inconsistent);
  EXPECT_EQ(static_cast<ParamFault>(written.relation), ParamFault::track_wider_than_body);
  EXPECT_EQ(client_.read(kTrack), raw_param(Params{}, kTrack));
  EXPECT_EQ(client_.read(kMaxSpeed), raw_param(Params{}, kMaxSpeed));
  EXPECT_EQ(client_.commit().status, can::ParamStatus::ok);
}

TEST_F(Bench, NobodyAnswers) {
  polls_left_ = 0;
  EXPECT_THROW(connect(), NoAnswer);
}

TEST_F(Bench, SaysWhatWasStagedWhenTheControllerFallsSilent) {
  connect();
  polls_left_ = 1;  // enough for the first write
  try {
    write_all(client_, {change(kTrack, 150000), change(kMaxSpeed, 250000), change(0, 91000)}, name_of);
    FAIL() << "no exception";
  } catch (const NoAnswer& e) {
    EXPECT_NE(std::string(e.what()).find("staged, not in effect: p2; not confirmed: p3, p0"),
              std::string::npos)
        << e.what();
  }
}

TEST_F(Bench, CancelsAndCanBeInterrupted) {
  connect();
  EXPECT_NO_THROW(client_.cancel());
  BaseClient other(port_, *this, {1, 3, 0}, {500, [] { return true; }});
  EXPECT_THROW(other.connect(), Interrupted);
}

TEST_F(Bench, SendsAResponseTableAndRestoresTheBuiltInOne) {
  const auto& built_in = fuzzy::kResponseTable;
  fuzzy::Bilinear::Table table = built_in;
  fuzzy::node_of(table, 99).turn = 1;
  connect();
  EXPECT_EQ(client_.rules(), fuzzy::digest(built_in));
  EXPECT_EQ(client_.send_rules(&table).status, can::RulesStatus::activated);
  EXPECT_EQ(client_.rules(), fuzzy::digest(table));
  EXPECT_EQ(client_.send_rules(nullptr).status, can::RulesStatus::activated);
  EXPECT_EQ(client_.rules(), fuzzy::digest(built_in));
  polls_left_ = 200;
  try {
    client_.send_rules(&table);
    FAIL() << "no exception";
  } catch (const NoAnswer& e) {
    EXPECT_STREQ(e.what(), "the controller sends no RulesReply for 500 ms");
  }
  EXPECT_EQ(&rules_.active(), &built_in);
}

TEST_F(Bench, ABusyComputerDoesNotHideTheResponseTable) {
  connect();
  for (const std::uint64_t ms : {60U, 290U}) {
    held_up_us_ = ms * 1000;
    EXPECT_EQ(client_.rules(), fuzzy::digest(fuzzy::kResponseTable)) << ms;
  }
}

TEST_F(Bench, SilenceIsNoLackOfAResponseTable) {
  connect();
  polls_left_ = 0;
  EXPECT_THROW(static_cast<void>(client_.rules()), NoAnswer);
}

TEST_F(Bench, NoticesAnotherBase) {
  connect();
  can::BaseNode other(bus_.attach(), {1, 9, 0}, 1);
  other.poll(static_cast<std::uint32_t>(now_us_ / 1000));
  EXPECT_THROW(client_.read(0), NoAnswer);
}

/// Every value at and beside the ends of its range, in the words of a robot file.
TEST(ParamValues, ReadsWhatItWrites) {
  const std::vector<ParamEntry> list = param_list(Params{});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const ParamEntry& e = list[i];
    for (const std::int64_t raw : {e.low, e.low + 1, e.raw, e.high - 1, e.high}) {
      if (raw < e.low || raw > e.high) continue;
      const std::string text =
          e.word != nullptr ? words_of(i)[static_cast<std::size_t>(raw)] : e.text_of(raw);
      const Assignment read = parse_assignment(std::string(e.key) + "=" + text);
      EXPECT_EQ(read.place, i) << e.key;
      EXPECT_EQ(read.raw, raw) << e.key << " = " << text;
    }
    if (e.word != nullptr) continue;
    for (const std::int64_t raw : {e.low - (e.high - e.low), e.high + (e.high - e.low)}) {
      EXPECT_THROW(parse_assignment(std::string(e.key) + "=" + e.text_of(raw)), std::invalid_argument)
          << e.key;
    }
  }
}

TEST(ParamValues, NamesTheNearestAllowedValue) {
  const std::size_t speed = place_of("wheel_speed_max_mps");
  EXPECT_EQ(
      outside_text(speed, "9", 9000000),
      "wheel_speed_max_mps = 9: too large; it may be 0.02 to 3.2 m/s; the nearest allowed value is 3.2 m/s");
  EXPECT_EQ(
      outside_text(speed, "0", 0),
      "wheel_speed_max_mps = 0: too small; it may be 0.02 to 3.2 m/s; the nearest allowed value is 0.02 m/s");
}

TEST(ParamValues, RefusesWhatIsNoValue) {
  for (const char* text :
       {"", "=", "gyro", "gyro=", "gyro=2", "gyro=TRUE", "body_radius_m=", "body_radius_m=0.1m",
        "body_radius_m=inf", "body_radius_m=1e999", "range_rate_hz=50.5", "nothing=1"}) {
    EXPECT_THROW(parse_assignment(text), std::invalid_argument) << text;
  }
}

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
