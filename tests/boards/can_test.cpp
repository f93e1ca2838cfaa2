#include <gtest/gtest.h>

#include "hal/boards/stm32f405/bx_can.hpp"
#include "tests/boards/chip_fixture.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using hal::CanFrame;
using hal::CanPort;
using hal::CanState;
using Bus = model::CanModel::Bus;

constexpr std::uint8_t kLife = 20;

CanFrame frame(std::uint32_t id, std::uint8_t size = 8) {
  CanFrame f{id, id > 0x7FF, false, size, {}};
  for (std::uint8_t i = 0; i < 8; ++i) f.data[i] = static_cast<std::uint8_t>(0x10 * i + (id & 0xF));
  return f;
}

void expect_same(const CanFrame& a, const CanFrame& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.extended, b.extended);
  EXPECT_EQ(a.remote, b.remote);
  ASSERT_EQ(a.size, b.size);
  for (int i = 0; i < a.size; ++i) EXPECT_EQ(a.data[i], b.data[i]);
}

class CanTest : public ::testing::Test, public ModelChip {
 protected:
  CanTest() { port.start(500000, kInternalClocks); }
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) {
      port.poll(++now);
      for (int k = 0; k < 2000; ++k) load(base::kFlash);
    }
  }
  void join() {
    pass(5);
    ASSERT_EQ(port.state(), CanState::active);
  }
  void come(const CanFrame& f) {
    if (can.receive(f)) port.on_receive_interrupt();
  }
  std::uint32_t now = UINT32_MAX - 30;
  BxCan port;
};

TEST_F(CanTest, RunsAt500kbitFromEitherClockAndSamplesLate) {
  EXPECT_DOUBLE_EQ(can.bitrate(16e6), 500000);
  EXPECT_GE(can.sample_point(), 0.85);
  EXPECT_LE(can.sample_point(), 0.88);
  port.start(500000, kFullClocks);
  EXPECT_DOUBLE_EQ(can.bitrate(42e6), 500000);
  EXPECT_GE(can.sample_point(), 0.85);
  EXPECT_LE(can.sample_point(), 0.88);
}

TEST_F(CanTest, JoinsTheBusAndSendsWhatItIsGiven) {
  EXPECT_EQ(port.state(), CanState::starting);
  EXPECT_FALSE(port.send(frame(1), kLife));
  join();
  CanFrame remote = frame(0x123, 4);
  remote.remote = true;
  const CanFrame all[] = {frame(0x7FF), frame(0), frame(0x1FFFFFFF, 3), frame(0x800, 0), remote};
  for (const CanFrame& f : all) EXPECT_TRUE(port.send(f, kLife));
  pass(5);
  ASSERT_EQ(can.sent.size(), 5U);
  for (int i = 0; i < 5; ++i) expect_same(can.sent[static_cast<std::size_t>(i)], all[i]);
  EXPECT_EQ(port.counts().sent, 5U);
  EXPECT_EQ(port.counts().refused, 1U);
}

TEST_F(CanTest, KeepsTheOrderOfSendWhateverTheIdentifiers) {
  join();
  for (std::uint32_t i = 0; i < CanPort::kSendDepth; ++i) {
    ASSERT_TRUE(port.send(frame(i % 2 == 0 ? 0x700 - i : i), 100));
  }
  pass(20);
  ASSERT_EQ(can.sent.size(), CanPort::kSendDepth);
  for (std::uint32_t i = 0; i < CanPort::kSendDepth; ++i) {
    EXPECT_EQ(can.sent[i].id, i % 2 == 0 ? 0x700 - i : i);
  }
}

TEST_F(CanTest, RefusesWhatIsMalformedOrTooMuch) {
  join();
  CanFrame f = frame(1, 9);
  EXPECT_FALSE(port.send(f, kLife));
  f = frame(0x7FF);
  f.id = 0x800;
  EXPECT_FALSE(port.send(f, kLife));
  f = frame(0x800);
  f.id = 0x20000000;
  EXPECT_FALSE(port.send(f, kLife));
  EXPECT_FALSE(port.send(frame(1), 0));
  EXPECT_FALSE(port.send(frame(1), CanPort::kLongestLife + 1));
  EXPECT_EQ(port.counts().refused, 5U);
  for (int i = 0; i < CanPort::kSendDepth; ++i) EXPECT_TRUE(port.send(frame(1), kLife));
  EXPECT_FALSE(port.send(frame(1), kLife));
  EXPECT_EQ(port.counts().refused, 6U);
}

TEST_F(CanTest, ReceivesFramesOfEveryKind) {
  join();
  CanFrame remote = frame(0x42, 2);
  remote.remote = true;
  const CanFrame all[] = {frame(0x7FF), frame(0x1FFFFFFF), frame(0, 0), remote};
  for (const CanFrame& f : all) come(f);
  for (const CanFrame& f : all) {
    CanFrame got{};
    ASSERT_TRUE(port.receive(got));
    expect_same(got, f);
  }
  CanFrame none{};
  EXPECT_FALSE(port.receive(none));
  EXPECT_EQ(port.counts().received, 4U);
}

TEST_F(CanTest, TakesThreeFramesOfOneInterruptAndCountsTheFourth) {
  join();
  for (std::uint32_t i = 1; i <= 4; ++i) can.receive(frame(i));
  port.on_receive_interrupt();
  pass(1);
  EXPECT_EQ(port.counts().overrun, 1U);
  CanFrame got{};
  int frames = 0;
  while (port.receive(got)) ++frames;
  EXPECT_EQ(frames, 3);
  come(frame(9));
  EXPECT_TRUE(port.receive(got));
  EXPECT_EQ(got.id, 9U);
}

TEST_F(CanTest, AFullRingKeepsTheOldestAndCountsTheRest) {
  join();
  for (std::uint32_t i = 0; i < CanPort::kReceiveDepth + 5U; ++i) come(frame(i));
  pass(1);
  EXPECT_EQ(port.counts().overrun, 5U);
  CanFrame got{};
  for (std::uint32_t i = 0; i < CanPort::kReceiveDepth; ++i) {
    ASSERT_TRUE(port.receive(got));
    EXPECT_EQ(got.id, i);
  }
}

struct LossCase {
  Bus bus;
  std::uint32_t hal::CanCounts::*cause;
};
class CanLossTest : public CanTest, public ::testing::WithParamInterface<LossCase> {};

TEST_P(CanLossTest, WhatCannotLeaveIsDroppedInItsTimeAndItsCauseCounted) {
  join();
  can.bus = GetParam().bus;
  for (std::uint32_t i = 0; i < 8; ++i) ASSERT_TRUE(port.send(frame(i), kLife));
  pass(kLife + 5);
  EXPECT_EQ(port.counts().expired, 8U);
  EXPECT_EQ(port.counts().*GetParam().cause, 1U);  // the other frames were never attempted
  EXPECT_EQ(port.counts().outbid + port.counts().unheard, 1U);
  EXPECT_EQ(port.counts().sent, 0U);
  can.bus = Bus::fine;
  ASSERT_TRUE(port.send(frame(0x55), kLife));
  pass(3);
  ASSERT_EQ(can.sent.size(), 1U);
  EXPECT_EQ(can.sent[0].id, 0x55U);
}

INSTANTIATE_TEST_SUITE_P(All, CanLossTest,
                         ::testing::Values(LossCase{Bus::nobody_hears, &hal::CanCounts::unheard},
                                           LossCase{Bus::others_win, &hal::CanCounts::outbid}));

TEST_F(CanTest, BusOffIsSeenEmptiesTheQueueAndEndsByRestartOnly) {
  join();
  can.bus = Bus::nobody_hears;
  for (std::uint32_t i = 0; i < 8; ++i) ASSERT_TRUE(port.send(frame(i), 100));
  pass(3);
  can.go_bus_off();
  pass(1);
  EXPECT_EQ(port.state(), CanState::bus_off);
  EXPECT_EQ(port.counts().bus_offs, 1U);
  EXPECT_EQ(port.counts().expired, 8U);
  EXPECT_FALSE(port.send(frame(1), kLife));
  can.bus = Bus::fine;
  pass(200);
  EXPECT_EQ(port.state(), CanState::bus_off);
  EXPECT_EQ(port.counts().bus_offs, 1U);
  EXPECT_TRUE(can.sent.empty());
  port.restart();
  join();
  ASSERT_TRUE(port.send(frame(0x33), kLife));
  pass(3);
  ASSERT_EQ(can.sent.size(), 1U);
  EXPECT_EQ(can.sent[0].id, 0x33U);
}

TEST_F(CanTest, PassiveStillSends) {
  join();
  can.go_passive();
  pass(1);
  EXPECT_EQ(port.state(), CanState::passive);
  EXPECT_TRUE(port.send(frame(1), kLife));
  pass(3);
  EXPECT_EQ(can.sent.size(), 1U);
}

TEST_F(CanTest, ABusThatIsNeverIdleEndsInOff) {
  can.bus = Bus::held;
  pass(BxCan::kJoinMs + 10);
  EXPECT_EQ(port.state(), CanState::off);
  EXPECT_EQ(port.counts().not_started, 1U);
  can.bus = Bus::fine;
  port.restart();
  join();
}

TEST(CanAbsentTest, AControllerThatDoesNotAnswerIsOffAfterABoundedTime) {
  ModelChip chip;
  chip.can.dead = true;
  BxCan port;
  port.start(500000, kInternalClocks);
  EXPECT_EQ(port.state(), CanState::off);
  EXPECT_EQ(port.counts().not_started, 1U);
  EXPECT_LT(chip.chip.now_us(), 2.0 * BxCan::kHearUs);
  port.poll(1);
  EXPECT_FALSE(port.send(frame(1), kLife));
}

}  // namespace
}  // namespace whisker::hal::stm32f405
