#include <gtest/gtest.h>

#include <cmath>

#include "hal/boards/common/governed_wheels.hpp"
#include "hal/boards/stm32f405/encoders.hpp"
#include "hal/boards/stm32f405/motors.hpp"
#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/usart.hpp"
#include "tests/boards/chip_fixture.hpp"

namespace whisker::hal::stm32f405 {
namespace {

class FakeClock final : public hal::Clock {
 public:
  uint32_t now_ms() noexcept override { return ms; }
  uint32_t ms = 0;
};

class DriveTest : public ::testing::Test, public ModelChip {
 protected:
  DriveTest() {
    set_up_pins();
    motors.start(kFullClocks);
    encoders.start();
  }
  bool high(int direction) { return gpio_b.output(wiring::kDirections[direction].number); }
  static double share(int duty) { return std::abs(duty) / 32767.0; }
  mcu::MotorParams params{};
  FakeClock clock;
  Motors motors;
  Encoders encoders;
  mcu::GovernedWheels<Motors, Encoders> wheels{params, params, motors, encoders, clock};
};

TEST_F(DriveTest, PulsesAre20kHz) { EXPECT_DOUBLE_EQ(168e6 / tim1.period_clocks(), Motors::kPwmHz); }

TEST_F(DriveTest, DutyAndDirectionAreThoseAskedFor) {
  for (const int left : {-32767, -20000, -1, 0, 1, 16384, 32767}) {
    for (const int right : {-32767, 0, 300, 32767}) {
      motors.drive(static_cast<int16_t>(left), static_cast<int16_t>(right));
      EXPECT_NEAR(tim1.duty(1), share(left), 2e-4);
      EXPECT_NEAR(tim1.duty(2), share(right), 2e-4);
      EXPECT_EQ(high(0), left > 0);
      EXPECT_EQ(high(1), left < 0);
      EXPECT_EQ(high(2), right > 0);
      EXPECT_EQ(high(3), right < 0);
    }
  }
  motors.drive(INT16_MIN, INT16_MAX);
  EXPECT_EQ(tim1.duty(1), 1);
  EXPECT_EQ(tim1.duty(2), 1);
}

TEST_F(DriveTest, CutOffTheyAreWithoutPulseAndDirectionWhateverTheyDid) {
  for (const int duty : {-20000, 0, 32767}) {
    motors.drive(static_cast<int16_t>(duty), static_cast<int16_t>(-duty));
    Motors::cut_off();
    EXPECT_EQ(tim1.duty(1), 0);
    EXPECT_EQ(tim1.duty(2), 0);
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(high(i));
  }
}

TEST_F(DriveTest, WheelsAreAtRestFromTheStart) {
  EXPECT_EQ(tim1.duty(1), 0);
  EXPECT_EQ(tim1.duty(2), 0);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(gpio_b.mode(wiring::kDirections[i].number), model::GpioModel::kOutput);
    EXPECT_FALSE(high(i));
  }
}

TEST_F(DriveTest, CountsFollowTheWheelsBothWaysAndOverEveryWrap) {
  std::int64_t left = 0;
  std::int64_t right = 0;
  hal::EncoderCounts counts{};
  for (int i = 0; i < 3000; ++i) {
    const int l = i < 1500 ? -20011 : 19001;
    const int r = i % 2 == 0 ? 32767 : -17;
    tim3.turn(l);
    tim4.turn(r);
    left += l;
    right += r;
    ASSERT_TRUE(wheels.read(counts));
    ASSERT_EQ(counts.left, static_cast<std::uint64_t>(left) % hal::kEncoderModulus);
    ASSERT_EQ(counts.right, static_cast<std::uint64_t>(right) % hal::kEncoderModulus);
  }
}

/// The wheels follow the PWM duty through a lag; the left motor is 20 % too weak.
TEST_F(DriveTest, AWeakMotorIsHeldAtItsSpeed) {
  double speed[2] = {};
  double way[2] = {};
  int counted[2] = {};
  for (int tick = 0; tick < 400; ++tick) {
    clock.ms += 10;
    ASSERT_TRUE(wheels.command({2000, -1500}));
    for (int ms = 0; ms < 10; ++ms) {
      for (int w = 0; w < 2; ++w) {
        const double sign = high(2 * w) ? 1 : high(2 * w + 1) ? -1 : 0;
        const double target = sign * tim1.duty(w + 1) * 0.4 * (w == 0 ? 0.8 : 1.0);
        speed[w] += (target - speed[w]) * (0.001 / 0.05);
        way[w] += speed[w] * 0.001;
        const int counts = static_cast<int>(std::floor(way[w] * 5000));
        (w == 0 ? tim3 : tim4).turn(counts - counted[w]);
        counted[w] = counts;
      }
    }
  }
  EXPECT_NEAR(speed[0], 0.200, 0.002);
  EXPECT_NEAR(speed[1], -0.150, 0.002);
  EXPECT_NEAR(way[0], 0.2 * 4, 0.03);
  EXPECT_NEAR(way[1], -0.15 * 4, 0.03);
  ASSERT_TRUE(wheels.command({0, 0}));
  EXPECT_EQ(tim1.duty(1), 0);
  EXPECT_EQ(tim1.duty(2), 0);
}

class UsartTest : public ::testing::Test, public ModelChip {
 protected:
  UsartTest() { console.start(115200, kInternalClocks); }
  void come(std::uint8_t byte, bool noisy = false) {
    if (usart.receive(byte, noisy)) console.on_interrupt();
  }
  Usart console;
};

TEST_F(UsartTest, TheBaudRateIsNearFromEitherClock) {
  EXPECT_NEAR(usart.baud(16e6), 115200, 115200 * 0.01);
  console.start(115200, kFullClocks);
  EXPECT_NEAR(usart.baud(42e6), 115200, 115200 * 0.01);
}

TEST_F(UsartTest, TakesAByteWhenThereIsRoomAndNeverWaits) {
  EXPECT_TRUE(console.offer('h'));
  const double began = chip.now_us();
  EXPECT_FALSE(console.offer('i'));
  EXPECT_LE(chip.now_us() - began, 1);
  for (int i = 0; i < model::UsartModel::kByte; ++i) load(base::kFlash);
  EXPECT_TRUE(console.offer('o'));
  EXPECT_EQ(usart.sent, "ho");
}

TEST_F(UsartTest, BytesWaitInTheRing) {
  for (int i = 0; i < Usart::kReceiveDepth; ++i) come(static_cast<std::uint8_t>(i));
  std::uint8_t byte = 0;
  for (int i = 0; i < Usart::kReceiveDepth; ++i) {
    ASSERT_TRUE(console.receive(byte, troubles));
    EXPECT_EQ(byte, i);
  }
  EXPECT_FALSE(console.receive(byte, troubles));
  EXPECT_EQ(troubles.total(), 0U);
}

TEST_F(UsartTest, LostAndDamagedBytesAreCounted) {
  std::uint8_t byte = 0;
  usart.receive('a');
  come('b');  // overruns the first byte, which stays
  ASSERT_TRUE(console.receive(byte, troubles));
  EXPECT_EQ(byte, 'a');
  EXPECT_EQ(troubles.of(Trouble::usart_receive_lost), 1U);
  come('c', true);
  EXPECT_FALSE(console.receive(byte, troubles));
  EXPECT_EQ(troubles.of(Trouble::usart_receive_lost), 2U);
  for (int i = 0; i < Usart::kReceiveDepth + 3; ++i) come('d');
  ASSERT_TRUE(console.receive(byte, troubles));
  EXPECT_EQ(troubles.of(Trouble::usart_receive_lost), 5U);
}

TEST(PinsTest, EveryPinHasItsOwnPlaceAndFunction) {
  ModelChip chip;
  power_peripherals();
  set_up_pins();
  EXPECT_EQ(chip.rcc.word(0x30) & 7U, 7U);
  using model::GpioModel;
  const auto port = [&chip](Pin pin) -> GpioModel& {
    return pin.port == base::kGpioA ? chip.gpio_a : pin.port == base::kGpioB ? chip.gpio_b : chip.gpio_c;
  };
  const auto expect_function = [&](Pin pin, std::uint32_t function) {
    EXPECT_EQ(port(pin).mode(pin.number), GpioModel::kFunction);
    EXPECT_EQ(port(pin).function(pin.number), function);
  };
  using namespace wiring;
  expect_function(kPwmLeft, 1);
  expect_function(kPwmRight, 1);
  for (const Pin pin : kEncoders) expect_function(pin, 2);
  expect_function(kI2cClock, 4);
  expect_function(kI2cData, 4);
  expect_function(kConsoleOut, 7);
  expect_function(kConsoleIn, 7);
  expect_function(kCanIn, 9);
  expect_function(kCanOut, 9);
  EXPECT_TRUE(port(kI2cData).open_drain(kI2cData.number) && port(kI2cClock).open_drain(kI2cClock.number));
  EXPECT_TRUE(port(kConsoleIn).pulled_up(kConsoleIn.number));
  for (const Pin pin : kInfrared) EXPECT_EQ(port(pin).mode(pin.number), GpioModel::kAnalogue);
  for (const Pin pin : kRangerAwake) {
    EXPECT_EQ(port(pin).mode(pin.number), GpioModel::kOutput);
    EXPECT_FALSE(port(pin).output(pin.number));
  }
}

}  // namespace
}  // namespace whisker::hal::stm32f405
