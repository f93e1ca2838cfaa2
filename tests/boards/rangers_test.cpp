#include <gtest/gtest.h>

#include "hal/boards/common/analogue_rangers.hpp"
#include "hal/boards/stm32f405/adc.hpp"
#include "hal/boards/stm32f405/i2c_rangers.hpp"
#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/vl53l0x.hpp"
#include "tests/boards/chip_fixture.hpp"
#include "tests/boards/models/vl53l0x_model.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using hal::RangeStatus;

class RangersTest : public ::testing::Test, public ModelChip {
 protected:
  RangersTest() {
    for (model::Vl53l0xModel& s : sensor) i2c.attach(s);
    set_up_pins();
    bus.start(kInternalClocks, troubles);
    rangers.start(0);
  }
  /// Runs the loop for some milliseconds, four polls each; every sensor measures every 33 ms.
  void pass(int ms) {
    for (int i = 0; i < ms; ++i, ++now) {
      for (int k = 0; k < hal::kBeams; ++k) {
        sensor[k].reset_line(gpio_c.output(wiring::kRangerAwake[k].number));
        if (now % 33 == 0) sensor[k].measure(distance[k], status[k]);
      }
      for (int k = 0; k < 4; ++k) rangers.poll(now);
    }
  }
  hal::RangeReading reading(int beam) {
    hal::RangeReadings all{};
    EXPECT_TRUE(rangers.read(all));
    return all.beam[beam];
  }
  model::Vl53l0xModel sensor[hal::kBeams];
  std::uint16_t distance[hal::kBeams] = {300, 400, 500};
  std::uint8_t status[hal::kBeams] = {vl53l0x::kValid, vl53l0x::kValid, vl53l0x::kValid};
  std::uint32_t now = 0;
  I2c bus;
  I2cRangers rangers{kVl53l0x, bus, troubles};
};

TEST_F(RangersTest, AreStaleBeforeTheFirstMeasurement) {
  for (int i = 0; i < hal::kBeams; ++i) {
    EXPECT_EQ(reading(i).status, RangeStatus::stale);
    EXPECT_EQ(reading(i).age_ms, 255);
  }
}

TEST_F(RangersTest, WakeOneAfterTheOtherAtTheirOwnAddresses) {
  pass(200);
  for (int i = 0; i < hal::kBeams; ++i) {
    EXPECT_TRUE(rangers.measuring(i));
    EXPECT_EQ(sensor[i].address(), I2cRangers::kFirstAddress + i);
    EXPECT_EQ(reading(i).status, RangeStatus::ok);
    EXPECT_EQ(reading(i).mm, distance[i]);
  }
  EXPECT_EQ(troubles.total(), 0U);
}

TEST_F(RangersTest, SequenceGoesUpByOneWithEachMeasurement) {
  pass(200);
  const std::uint8_t before = reading(1).sequence;
  pass(33 * 20);
  EXPECT_EQ(reading(1).sequence, (before + 20) % 16);
  EXPECT_GE(reading(1).age_ms, vl53l0x::kRangingMs);
  EXPECT_LE(reading(1).age_ms, vl53l0x::kRangingMs + 34);
}

TEST_F(RangersTest, AgeIsSinceTheMeasurementBegan) {
  pass(200);
  // The last measurement ended at a multiple of 33 ms and was read within the next two polls.
  const std::uint32_t ended = now - 1 - (now - 1) % 33;
  EXPECT_GE(reading(0).age_ms, now - 1 - ended + 33 - 2);
  EXPECT_LE(reading(0).age_ms, now - 1 - ended + 33);
}

TEST_F(RangersTest, TellNothingInReachFromALostReading) {
  distance[0] = vl53l0x::kOutOfReachMm;
  status[1] = vl53l0x::kNoSignal;
  status[2] = 6;
  pass(250);
  EXPECT_EQ(reading(0).status, RangeStatus::clear);
  EXPECT_EQ(reading(1).status, RangeStatus::clear);
  EXPECT_EQ(reading(2).status, RangeStatus::invalid);
}

TEST_F(RangersTest, OnlyASensorThatWorksSaysThatNothingIsInReach) {
  for (std::uint8_t value = 0; value < 16; ++value) {
    distance[0] = vl53l0x::kOutOfReachMm;
    distance[1] = 0xFFFF;
    distance[2] = 2000;
    for (std::uint8_t& s : status) s = value;
    pass(250);
    const bool works = (value >= 4 && value <= 7) || value == 9 || value == vl53l0x::kValid;
    EXPECT_EQ(reading(0).status, works ? RangeStatus::clear : RangeStatus::invalid) << +value;
    EXPECT_EQ(reading(1).status, works ? RangeStatus::clear : RangeStatus::invalid) << +value;
    EXPECT_EQ(reading(2).status, value == vl53l0x::kValid      ? RangeStatus::ok
                                 : value == vl53l0x::kNoSignal ? RangeStatus::clear
                                                               : RangeStatus::invalid)
        << +value;
  }
}

TEST_F(RangersTest, ASensorThatIsNotThereLeavesTheOthersAlone) {
  sensor[1].dead = true;
  pass(1000);
  EXPECT_FALSE(rangers.measuring(1));
  EXPECT_EQ(reading(1).status, RangeStatus::stale);
  EXPECT_GE(troubles.of(Trouble::ranger_not_started), 5U);
  EXPECT_LE(troubles.of(Trouble::ranger_not_started), 10U);
  EXPECT_EQ(reading(0).mm, 300);
  EXPECT_EQ(reading(2).mm, 500);
}

TEST_F(RangersTest, AnotherKindIsNotStarted) {
  sensor[0].model = 0xEA;
  pass(300);
  EXPECT_FALSE(rangers.measuring(0));
  EXPECT_GE(troubles.of(Trouble::ranger_not_started), 1U);
  EXPECT_EQ(troubles.of(Trouble::i2c_nack), 0U);
}

TEST_F(RangersTest, ASensorThatDiesIsSilentAndComesBack) {
  pass(300);
  sensor[2].dead = true;
  pass(300);
  EXPECT_EQ(troubles.of(Trouble::ranger_silent), 1U);
  EXPECT_FALSE(rangers.measuring(2));
  EXPECT_EQ(reading(2).age_ms, 255);
  sensor[2].dead = false;
  pass(300);
  EXPECT_TRUE(rangers.measuring(2));
  EXPECT_EQ(reading(2).mm, 500);
  EXPECT_LE(reading(2).age_ms, vl53l0x::kRangingMs + 34);
}

TEST_F(RangersTest, ASensorThatStopsMeasuringIsReset) {
  pass(300);
  sensor[0].measuring = false;
  pass(400);
  EXPECT_EQ(troubles.of(Trouble::ranger_silent), 1U);
  EXPECT_TRUE(rangers.measuring(0));
}

TEST_F(RangersTest, ABusThatIsDeadCostsEachPollABoundedTime) {
  pass(300);
  i2c.fault = model::I2cModel::Fault::clock_held;
  double longest = 0;
  for (int i = 0; i < 1000; ++i) {
    const double began = chip.now_us();
    rangers.poll(now + static_cast<std::uint32_t>(i));
    longest = std::max(longest, chip.now_us() - began);
  }
  EXPECT_LT(longest, 2.0 * I2c::kTransferUs);
  EXPECT_GE(troubles.of(Trouble::ranger_silent), 3U);
}

class IrTest : public ::testing::Test, public ModelChip {
 protected:
  IrTest() {
    converter.start(kInternalClocks, troubles);
    rangers.start(0);
    adc.raw = [this](std::uint32_t channel) { return channel < 10 || channel > 12 ? 0 : raw[channel - 10]; };
  }
  static int raw_of(double mv) { return static_cast<int>(mv * 4095 / 3300); }
  hal::RangeReadings read_after(std::uint32_t ms) {
    rangers.poll(ms);
    hal::RangeReadings all{};
    EXPECT_TRUE(rangers.read(all));
    return all;
  }
  int raw[3] = {};
  Adc converter;
  mcu::AnalogueRangers<Adc> rangers{mcu::kGp2y0a21, mcu::kGp2y0a21PeriodMs, wiring::kInfraredChannel,
                                    converter};
};

TEST_F(IrTest, ReadsEachChannelsVoltageAsADistance) {
  raw[0] = raw_of(mcu::voltage_at(mcu::kGp2y0a21, 200));
  raw[1] = raw_of(mcu::voltage_at(mcu::kGp2y0a21, 800) - 20);
  raw[2] = raw_of(mcu::voltage_at(mcu::kGp2y0a21, 100) + 50);
  const hal::RangeReadings all = read_after(48);
  EXPECT_EQ(all.beam[0].status, RangeStatus::ok);
  EXPECT_NEAR(all.beam[0].mm, 200, 2);
  EXPECT_EQ(all.beam[1].status, RangeStatus::clear);
  EXPECT_EQ(all.beam[2].status, RangeStatus::too_near);
  EXPECT_EQ(troubles.total(), 0U);
}

TEST_F(IrTest, ANewReadingComesOnceAPeriod) {
  raw[0] = raw[1] = raw[2] = raw_of(1000);
  const std::uint8_t first = read_after(48).beam[0].sequence;
  EXPECT_EQ(read_after(95).beam[0].sequence, first);
  EXPECT_EQ(read_after(96).beam[0].sequence, (first + 1) % 16);
}

TEST_F(IrTest, NoConversionIsInvalidCountedAndOver) {
  raw[0] = raw_of(1000);
  adc.never_ends = true;
  const double began = chip.now_us();
  const hal::RangeReadings all = read_after(48);
  for (const hal::RangeReading& r : all.beam) EXPECT_EQ(r.status, RangeStatus::invalid);
  EXPECT_EQ(troubles.of(Trouble::adc_no_conversion), 3U);
  EXPECT_LT(chip.now_us() - began, 250);
  adc.never_ends = false;
  EXPECT_EQ(read_after(96).beam[0].status, RangeStatus::ok);
}

TEST_F(IrTest, AConversionThatComesLateIsNotTakenForTheNextChannels) {
  raw[0] = raw_of(2000);
  raw[1] = raw_of(500);
  adc.never_ends = true;
  int16_t mv = 0;
  EXPECT_FALSE(converter.convert(10, mv));
  adc.never_ends = false;
  for (int i = 0; i < 50; ++i) load(base::kFlash);
  ASSERT_TRUE(converter.convert(11, mv));
  EXPECT_NEAR(mv, 500, 2);
}

}  // namespace
}  // namespace whisker::hal::stm32f405
