#include <gtest/gtest.h>

#include "hal/boards/stm32f405/mpu6050.hpp"
#include "hal/boards/stm32f405/pins.hpp"
#include "tests/boards/chip_fixture.hpp"
#include "tests/boards/models/mpu6050_model.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using Phase = Mpu6050::Phase;

GyroParams with(std::int32_t rate_hz, std::int32_t range_radps_e6) {
  GyroParams p;
  p.fitted = Fitted::yes;
  p.rate_hz = rate_hz;
  p.range = AngularRate::from_raw(range_radps_e6);
  return p;
}

class GyroTest : public ::testing::Test, public ModelChip {
 protected:
  GyroTest() {
    i2c.attach(sensor);
    set_up_pins();
    bus.start(kInternalClocks, troubles);
    gyro.start(0);
  }
  /// Runs the loop for some milliseconds, four polls each.
  void pass(int ms, Mpu6050& driver) {
    for (int i = 0; i < ms; ++i, ++now) {
      const int rate = rate_at(now);
      const int before = sensor.samples;
      sensor.pass(rate);
      if (sensor.samples > before) sum += rate;
      for (int k = 0; polls && k < 4; ++k) driver.poll(now);
    }
  }
  void pass(int ms) { pass(ms, gyro); }
  void start() {
    pass(400);
    ASSERT_EQ(gyro.phase(), Phase::sampling);
    ASSERT_EQ(troubles.total(), 0U);
  }
  hal::GyroReading reading() {
    hal::GyroReading out{};
    EXPECT_TRUE(gyro.read(out));
    return out;
  }
  bool answers() {
    hal::GyroReading out{};
    return gyro.read(out);
  }
  /// Milliseconds until the driver answers again, at most 2000.
  int silence() {
    int ms = 0;
    for (; !answers() && ms < 2000; ++ms) pass(1);
    return ms;
  }

  model::Mpu6050Model sensor;
  std::uint32_t now = 0;
  bool polls = true;
  int sum = 0;  // of all samples
  std::function<int(std::uint32_t)> rate_at = [](std::uint32_t ms) {
    return static_cast<int>(ms % 977) * 31 - 15000;
  };
  I2c bus;
  Mpu6050 gyro{GyroParams{}, Facing::up, bus, troubles};
};

TEST_F(GyroTest, DoesNotAnswerBeforeItSamples) {
  while (gyro.phase() != Phase::sampling && now < 1000) {
    EXPECT_FALSE(answers());
    pass(1);
  }
  EXPECT_LE(now, Mpu6050::kHeldMs + mpu6050::kResetMs + mpu6050::kSettleMs + 5);
  EXPECT_EQ(sensor.resets, 1);
  EXPECT_EQ(sensor.reg[mpu6050::kPower], mpu6050::kClockOfZ);
  EXPECT_EQ(sensor.reg[mpu6050::kSampleRateDivider], 9) << "100 Hz";
  EXPECT_EQ(sensor.reg[mpu6050::kGyroConfig], 1 << 3) << "500 deg/s";
  EXPECT_EQ(troubles.total(), 0U);
}

TEST_F(GyroTest, AddsUpEverySample) {
  start();
  pass(3000);
  const hal::GyroReading all = reading();
  EXPECT_GE(sensor.samples, 310);
  EXPECT_NEAR(all.samples, sensor.samples, 1);
  pass(static_cast<int>(Mpu6050::kPollMs));
  rate_at = [](std::uint32_t) { return 0; };
  pass(20);
  EXPECT_EQ(reading().samples, sensor.samples);
  EXPECT_EQ(reading().sum, static_cast<std::uint32_t>(sum));
  EXPECT_EQ(reading().saturated, 0);
  EXPECT_EQ(troubles.total(), 0U);
}

TEST_F(GyroTest, ALoopThatPausesLosesNothing) {
  start();
  polls = false;
  pass(4900);
  polls = true;
  rate_at = [](std::uint32_t) { return 0; };
  pass(200);
  EXPECT_EQ(reading().samples, sensor.samples);
  EXPECT_EQ(reading().sum, static_cast<std::uint32_t>(sum));
  EXPECT_EQ(troubles.total(), 0U);
}

TEST_F(GyroTest, ATooLongPauseIsALossThatTheCoreNotices) {
  start();
  polls = false;
  pass(5500);
  polls = true;
  EXPECT_TRUE(answers());
  pass(1);
  EXPECT_EQ(troubles.of(Trouble::gyro_samples_lost), 1U);
  const int ms = silence();
  EXPECT_GT(ms, 200) << "the core counts it as lost after 100 ms";
  EXPECT_LT(ms, 300);
}

TEST_F(GyroTest, AReadThatBreaksOffIsALoss) {
  start();
  sensor.on_fifo_read = [this] { i2c.fault = model::I2cModel::Fault::clock_held; };
  pass(12);
  EXPECT_FALSE(answers());
  EXPECT_EQ(troubles.of(Trouble::gyro_samples_lost), 1U);
  EXPECT_GE(troubles.of(Trouble::i2c_timeout), 1U);
  i2c.fault = model::I2cModel::Fault::none;
  sensor.on_fifo_read = nullptr;
  EXPECT_GT(silence(), 200);
  EXPECT_TRUE(answers());
}

TEST_F(GyroTest, OnItsHeadItTurnsTheOtherWay) {
  Mpu6050 upside_down{GyroParams{}, Facing::down, bus, troubles};
  upside_down.start(now);
  rate_at = [](std::uint32_t) { return 1000; };
  pass(500, upside_down);
  hal::GyroReading out{};
  ASSERT_TRUE(upside_down.read(out));
  EXPECT_GT(out.samples, 10);
  EXPECT_EQ(out.sum, static_cast<std::uint32_t>(-1000 * out.samples));
}

TEST_F(GyroTest, CountsSamplesAtTheLimit) {
  start();
  const hal::GyroReading before = reading();
  rate_at = [](std::uint32_t) { return -32768; };
  pass(100);
  rate_at = [](std::uint32_t) { return 32767; };
  pass(50);
  rate_at = [](std::uint32_t) { return 32766; };
  pass(50);
  const hal::GyroReading after = reading();
  EXPECT_NEAR(after.saturated - before.saturated, 15, 1);
  EXPECT_NEAR(after.samples - before.samples, 20, 1);
  rate_at = [](std::uint32_t) { return 0; };
  pass(20);
  EXPECT_EQ(reading().saturated, after.saturated);
}

TEST_F(GyroTest, OneThatIsNotThereIsTriedAgainByName) {
  sensor.dead = true;
  pass(1050);
  EXPECT_FALSE(answers());
  EXPECT_EQ(troubles.of(Trouble::gyro_not_started), 10U);
  EXPECT_EQ(troubles.of(Trouble::i2c_nack), 10U);
  sensor.dead = false;
  pass(400);
  EXPECT_TRUE(answers());
}

TEST_F(GyroTest, AnotherChipIsNotStarted) {
  sensor.identity = 0x70;
  pass(500);
  EXPECT_FALSE(answers());
  EXPECT_EQ(sensor.resets, 0) << "it is left alone";
  EXPECT_GE(troubles.of(Trouble::gyro_not_started), 4U);
  EXPECT_EQ(troubles.of(Trouble::i2c_nack), 0U);
}

TEST_F(GyroTest, OneThatDoesNotTakeItsRangeIsNotStarted) {
  for (const int reg : {mpu6050::kGyroConfig, mpu6050::kConfig, mpu6050::kSampleRateDivider}) {
    const std::uint16_t before = troubles.of(Trouble::gyro_not_started);
    sensor.deaf_register = reg;
    Mpu6050 own{GyroParams{}, Facing::up, bus, troubles};
    own.start(now);
    pass(1000, own);
    hal::GyroReading out{};
    EXPECT_FALSE(own.read(out)) << reg;
    EXPECT_GT(troubles.of(Trouble::gyro_not_started), before) << reg;
  }
}

TEST_F(GyroTest, OneThatDiesIsSilentAndComesBack) {
  start();
  const hal::GyroReading before = reading();
  sensor.dead = true;
  pass(static_cast<int>(Mpu6050::kSilentMs) + 10);
  EXPECT_EQ(troubles.of(Trouble::gyro_silent), 1U);
  EXPECT_FALSE(answers());
  sensor.dead = false;
  EXPECT_GT(silence(), 200);
  EXPECT_GE(static_cast<std::uint16_t>(reading().samples - before.samples), 0);
  const hal::GyroReading after = reading();
  pass(100);
  EXPECT_NEAR(static_cast<std::uint16_t>(reading().samples - after.samples), 10, 1);
}

TEST_F(GyroTest, OneThatLosesItsPowerIsSetUpAgain) {
  start();
  sensor.power_on();
  pass(400);
  EXPECT_EQ(troubles.of(Trouble::gyro_silent), 1U);
  EXPECT_EQ(sensor.resets, 2);
  EXPECT_TRUE(answers());
  EXPECT_EQ(sensor.reg[mpu6050::kGyroConfig], 1 << 3);
}

TEST_F(GyroTest, ABusThatIsDeadCostsEachPollABoundedTime) {
  start();
  i2c.fault = model::I2cModel::Fault::clock_held;
  double longest = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const double began = chip.now_us();
    gyro.poll(now + i);
    longest = std::max(longest, chip.now_us() - began);
  }
  EXPECT_LT(longest, 2.0 * I2c::kTransferUs);
  EXPECT_EQ(troubles.of(Trouble::gyro_silent), 1U);
  EXPECT_GE(troubles.of(Trouble::gyro_not_started), 5U);
  EXPECT_FALSE(answers());
}

TEST(Mpu6050Setup, HasTheRatesAndRangesOfTheChip) {
  using mpu6050::setup_of;
  EXPECT_EQ(setup_of(with(1000, 4363323)).divider, 0);
  EXPECT_EQ(setup_of(with(20, 4363323)).divider, 49);
  EXPECT_EQ(setup_of(with(100, 4363323)).full_scale, 0);
  EXPECT_EQ(setup_of(with(100, 17453293)).full_scale, 2 << 3);
  EXPECT_EQ(setup_of(with(100, 34906585)).full_scale, 3 << 3);
  for (const GyroParams& ok : {GyroParams{}, with(1000, 4363323), with(20, 34906585)})
    EXPECT_TRUE(setup_of(ok).possible);
  for (const GyroParams& bad :
       {with(300, 8726646), with(0, 8726646), with(100, 8000000), with(100, 40000000)})
    EXPECT_FALSE(setup_of(bad).possible);
}

TEST_F(GyroTest, AnImpossibleRangeIsNamedAndTouchesNothing) {
  Mpu6050 own{with(100, 8000000), Facing::up, bus, troubles};
  own.start(now);
  pass(300, own);
  EXPECT_GE(troubles.of(Trouble::gyro_not_started), 2U);
  EXPECT_EQ(sensor.resets, 0);
}

}  // namespace
}  // namespace whisker::hal::stm32f405
