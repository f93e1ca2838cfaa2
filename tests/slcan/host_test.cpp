#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/ports/slcan/slcan.hpp"
#include "tests/bus/frames.hpp"
#include "tests/slcan/pipe.hpp"

namespace whisker::hal::slcan {
namespace {

using bus::frame;
using bus::kLife_ms;
using bus::taken;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class SlcanHost : public ::testing::Test {
 protected:
  /// The output of the port during these milliseconds.
  std::string pass(std::uint32_t ms) {
    for (std::uint32_t i = 0; i < ms; ++i) port.poll(++now);
    return pipe.sent();
  }
  void open() {
    pass(Slcan::kSettleMs + 1);
    pipe.come("\r");
    pass(1);
    pipe.come("\r");
    pass(1);
    ASSERT_EQ(port.state(), CanState::active);
  }
  std::uint32_t now = UINT32_MAX - 50;
  Pipe pipe;
  Slcan port{pipe, Role::host};
};

TEST_F(SlcanHost, OpensTheAdapterStepByStep) {
  EXPECT_EQ(pass(1), "\r\r\rC\rZ0\r");
  EXPECT_EQ(port.state(), CanState::starting);
  pipe.come("\a\a\r\at1230\r");
  EXPECT_EQ(pass(Slcan::kSettleMs), "S6\r");
  EXPECT_EQ(pass(5), "");
  pipe.come("\r");
  EXPECT_EQ(pass(1), "O\r");
  EXPECT_EQ(port.state(), CanState::starting);
  pipe.come("\r");
  pass(1);
  EXPECT_EQ(port.state(), CanState::active);
  EXPECT_THAT(taken(port), IsEmpty()) << "from before it was open";
}

TEST_F(SlcanHost, TakesSilenceForYes) {
  pass(Slcan::kSettleMs + 2 * Slcan::kAnswerMs - 1);
  EXPECT_EQ(port.state(), CanState::starting);
  pass(2);
  EXPECT_EQ(port.state(), CanState::active);
}

TEST_F(SlcanHost, TakesAFrameForYes) {
  pass(Slcan::kSettleMs + 1);
  pipe.come("\r");
  pass(1);
  pipe.come("t1230\r");
  pass(1);
  EXPECT_EQ(port.state(), CanState::active);
  EXPECT_THAT(taken(port), ElementsAre(frame(0x123, 0)));
}

TEST_F(SlcanHost, IsOffWhenTheAdapterRefusesUntilItIsRestarted) {
  pass(Slcan::kSettleMs + 1);
  pipe.come("\a");
  EXPECT_EQ(pass(500), "");
  EXPECT_EQ(port.state(), CanState::off);
  EXPECT_EQ(port.counts().not_started, 1U);
  EXPECT_EQ(port.line_counts().refusals, 1U);
  port.restart();
  EXPECT_EQ(pass(1), "\r\r\rC\rZ0\r");
  EXPECT_EQ(port.state(), CanState::starting);
}

TEST_F(SlcanHost, NeitherAnswersNorMindsAnswers) {
  open();
  pipe.come("t1231AA\rz\rZ\r\r\ae1a\rV0101x\r");
  EXPECT_EQ(pass(1), "");
  EXPECT_EQ(taken(port).size(), 1U);
  EXPECT_EQ(port.line_counts().refusals, 1U);
  EXPECT_EQ(port.line_counts().bad_lines, 1U);
  EXPECT_EQ(port.state(), CanState::active);
}

TEST_F(SlcanHost, IgnoresTheTimeStampsOfAnAdapter) {
  open();
  pipe.come("t1232AABB1F2C\rT1FFFFFFF80011223344556677ea60\rr12301f2c\rt123000\rt12301F2G\rt12301F2C0\r");
  pass(1);
  EXPECT_THAT(taken(port),
              ElementsAre(CanFrame{0x123, false, false, 2, {0xAA, 0xBB}},
                          CanFrame{0x1FFFFFFF, true, false, 8, {0, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77}},
                          bus::remote(0x123, 0)));
  EXPECT_EQ(port.line_counts().bad_lines, 3U);
}

TEST_F(SlcanHost, KnowsTheStateThatAnAdapterReports) {
  open();
  pipe.come("sp128000\r");
  pass(1);
  EXPECT_EQ(port.state(), CanState::passive);
  EXPECT_TRUE(port.send(frame(1), kLife_ms));
  pipe.come("sw096000\r");
  pass(1);
  EXPECT_EQ(port.state(), CanState::active);
  ASSERT_TRUE(port.send(frame(1), kLife_ms));
  pipe.space = 0;
  pipe.come("sb255000\r");
  pass(1);
  EXPECT_EQ(port.state(), CanState::bus_off);
  EXPECT_EQ(port.counts().bus_offs, 1U);
  EXPECT_FALSE(port.send(frame(1), kLife_ms));
  pipe.come("sa000000\rsq000000\r");
  pass(300);
  EXPECT_EQ(port.state(), CanState::bus_off);
  port.restart();
  pipe.space = SIZE_MAX;
  pass(300);
  EXPECT_EQ(port.state(), CanState::active);
}

TEST_F(SlcanHost, OpensAnewAfterALoss) {
  open();
  pipe.up = false;
  pass(1);
  EXPECT_EQ(port.state(), CanState::starting);
  pipe.up = true;
  EXPECT_EQ(pass(1), "\r\r\rC\rZ0\r");
}

TEST_F(SlcanHost, TalksToOurAdapterBothWays) {
  Pipe far;
  Slcan node(far, Role::adapter);
  const auto run = [&](int ms) {
    for (int i = 0; i < ms; ++i) {
      port.poll(++now);
      node.poll(now);
      exchange(pipe, far);
    }
  };
  run(Slcan::kSettleMs + 10);
  ASSERT_EQ(port.state(), CanState::active);
  ASSERT_EQ(node.state(), CanState::active);
  std::uint32_t to_node = 0, to_host = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    ASSERT_TRUE(port.send(frame(i & 0x7FF, 8), kLife_ms));
    ASSERT_TRUE(node.send(frame(0x10000 + i, 5), kLife_ms));
    run(1);
    for (const CanFrame& f : taken(node)) EXPECT_EQ(f, frame(to_node++ & 0x7FF, 8));
    for (const CanFrame& f : taken(port)) EXPECT_EQ(f, frame(0x10000 + to_host++, 5));
  }
  run(3);
  EXPECT_EQ(to_node + taken(node).size(), 1000U);
  EXPECT_EQ(to_host + taken(port).size(), 1000U);
  EXPECT_EQ(node.line_counts().bad_lines + port.line_counts().bad_lines, 0U);
}

}  // namespace
}  // namespace whisker::hal::slcan
