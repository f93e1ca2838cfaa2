#include "hal/boards/stm32f405/clock.hpp"
#include "hal/boards/common/schedule.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "hal/boards/common/patience.hpp"
#include "hal/boards/stm32f405/ticker.hpp"
#include "hal/boards/stm32f405/watchdog.hpp"
#include "tests/boards/chip_fixture.hpp"

namespace whisker::hal::stm32f405 {
namespace {

class ClockTest : public ::testing::Test, public ModelChip {
 protected:
  void expect_agrees(const Clocks& clocks) {
    const double core = rcc.core_mhz(rcc, flash);
    EXPECT_DOUBLE_EQ(clocks.core_hz, core * 1e6);
    const double apb1 = rcc.bus_mhz(core, rcc::kPpre1);
    const double apb2 = rcc.bus_mhz(core, rcc::kPpre2);
    EXPECT_LE(apb1, 42);
    EXPECT_LE(apb2, 84);
    EXPECT_DOUBLE_EQ(clocks.apb1_hz, apb1 * 1e6);
    EXPECT_DOUBLE_EQ(clocks.apb2_hz, apb2 * 1e6);
    // A timer runs at its bus's frequency, or at twice that if the bus is divided.
    EXPECT_DOUBLE_EQ(clocks.timer2_hz, (apb1 == core ? apb1 : 2 * apb1) * 1e6);
    EXPECT_DOUBLE_EQ(clocks.timer1_hz, (apb2 == core ? apb2 : 2 * apb2) * 1e6);
  }
};

TEST_F(ClockTest, GetsTo168MHzFromTheCrystal) {
  const Clocks clocks = start_clocks(troubles);
  EXPECT_EQ(clocks.core_hz, 168000000U);
  EXPECT_EQ(rcc.get(rcc::kPllsrc), 1U);
  EXPECT_EQ(troubles.total(), 0U);
  expect_agrees(clocks);
}

TEST_F(ClockTest, WithoutACrystalTheInternalOscillatorFeedsThePll) {
  rcc.dead_crystal = true;
  const Clocks clocks = start_clocks(troubles);
  EXPECT_EQ(clocks.core_hz, 168000000U);
  EXPECT_EQ(rcc.get(rcc::kPllsrc), 0U);
  EXPECT_EQ(rcc.get(rcc::kHseon), 0U);
  EXPECT_EQ(troubles.of(Trouble::crystal_not_ready), 1U);
  EXPECT_EQ(troubles.total(), 1U);
  expect_agrees(clocks);
}

TEST_F(ClockTest, WithoutALockItStaysAt16MHz) {
  rcc.pll_without_lock = true;
  const Clocks clocks = start_clocks(troubles);
  EXPECT_EQ(clocks.core_hz, 16000000U);
  EXPECT_EQ(troubles.of(Trouble::pll_not_locked), 1U);
  expect_agrees(clocks);
}

TEST_F(ClockTest, WithoutASwitchItStaysAt16MHz) {
  rcc.switch_stuck = true;
  const Clocks clocks = start_clocks(troubles);
  EXPECT_EQ(clocks.core_hz, 16000000U);
  EXPECT_EQ(troubles.of(Trouble::clock_not_switched), 1U);
  expect_agrees(clocks);
}

TEST_F(ClockTest, AnAbsentClockUnitEndsInNamesWithinABound) {
  rcc.dead_crystal = rcc.pll_without_lock = rcc.switch_stuck = true;
  start_clocks(troubles);
  EXPECT_EQ(troubles.total(), 2U);
  EXPECT_LT(chip.now_us(), 10000);
}

TEST_F(ClockTest, AWaitLastsAtLeastAsLongAsAskedFor) {
  for (const std::uint32_t us : {1U, 50U, 1000U}) {
    const double before = chip.now_us();
    EXPECT_FALSE(Patience::for_us(us, 16000000).until(base::kFlash, flash::kPrften, true));
    EXPECT_GE(chip.now_us() - before, us);
    EXPECT_LE(chip.now_us() - before, us + 2);
  }
}

TEST_F(ClockTest, TheTickerCountsMicrosecondsAndMilliseconds) {
  Ticker ticker;
  ticker.start(kInternalClocks);
  const double began = chip.now_us();
  const std::uint32_t ms = ticker.now_ms();
  for (int i = 0; i < 50000; ++i) ticker.now_us();
  EXPECT_NEAR(ticker.now_us(), chip.now_us() - began, 3);
  EXPECT_NEAR(ticker.now_ms() - ms, (chip.now_us() - began) / 1000, 1);
}

TEST_F(ClockTest, MillisecondsGoOnOverTheCountersWrap) {
  Ticker ticker;
  ticker.start(kInternalClocks);
  tim2.word(tim::kCnt.offset) = UINT32_MAX - 100500;
  const std::uint32_t before = ticker.now_ms();
  tim2.word(tim::kCnt.offset) = 200000;
  EXPECT_NEAR(ticker.now_ms() - before, 300, 1);
}

TEST(ScheduleTest, FiresOnceAPeriodOnItsGridAndCountsWhatItMissed) {
  const std::uint32_t start = UINT32_MAX - 55;
  mcu::Schedule schedule;
  schedule.begin(start);
  int fired = 0;
  for (std::uint32_t t = 0; t <= 1000; ++t) fired += schedule.due(start + t, 10) ? 1 : 0;
  EXPECT_EQ(fired, 100);
  EXPECT_EQ(schedule.missed(), 0U);
  EXPECT_TRUE(schedule.due(start + 1035, 10));
  EXPECT_EQ(schedule.missed(), 2U);
  EXPECT_FALSE(schedule.due(start + 1039, 10));
  EXPECT_TRUE(schedule.due(start + 1040, 10));
}

TEST_F(ClockTest, TheWatchdogTakesItsTimeOut) {
  Watchdog watchdog;
  EXPECT_TRUE(watchdog.start(200, kInternalClocks, troubles));
  EXPECT_TRUE(iwdg.running);
  EXPECT_NEAR(iwdg.timeout_ms(), 200, 2);
  const int feedings = iwdg.feedings;
  watchdog.feed();
  EXPECT_EQ(iwdg.feedings, feedings + 1);
  EXPECT_EQ(troubles.total(), 0U);
}

TEST_F(ClockTest, AWatchdogThatDoesNotAnswerIsCounted) {
  iwdg.never_ready = true;
  Watchdog watchdog;
  EXPECT_FALSE(watchdog.start(200, kInternalClocks, troubles));
  EXPECT_TRUE(iwdg.running);
  EXPECT_EQ(troubles.of(Trouble::watchdog_not_ready), 1U);
  EXPECT_LT(chip.now_us(), 40000);
}

TEST(TroublesTest, EveryOneHasANameOfItsOwn) {
  std::set<std::string> names;
  for (std::uint8_t i = 0; i < kTroubles; ++i) names.insert(name(static_cast<Trouble>(i)));
  EXPECT_EQ(names.size(), kTroubles);
  EXPECT_EQ(names.count("unknown"), 0U);
  EXPECT_STREQ(name(static_cast<Trouble>(kTroubles)), "unknown");
}

TEST(TroublesTest, CountersStopAtTheirMaximum) {
  Troubles troubles;
  troubles.count(Trouble::i2c_nack, 65000);
  troubles.count(Trouble::i2c_nack, 535);
  EXPECT_EQ(troubles.of(Trouble::i2c_nack), 65535U);
  troubles.count(Trouble::i2c_nack, 2);
  EXPECT_EQ(troubles.of(Trouble::i2c_nack), 65535U);
}

}  // namespace
}  // namespace whisker::hal::stm32f405
