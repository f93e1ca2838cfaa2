#include "host/bench/param_client.hpp"

#include <gtest/gtest.h>

#include "firmware/can/controller_node.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/params/words.hpp"
#include "host/bus/memory_bus.hpp"

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
    EXPECT_EQ(client_.read(index), raw_param(Params{}, i)) << i;
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

}  // namespace
}  // namespace whisker::bench
