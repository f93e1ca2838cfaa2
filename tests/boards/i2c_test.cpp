#include "hal/boards/stm32f405/i2c.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <vector>

#include "hal/boards/stm32f405/pins.hpp"
#include "tests/boards/chip_fixture.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Records written bytes and returns increasing ones.
class Recorder : public model::I2cDevice {
 public:
  bool answers(std::uint8_t address) override { return address == 0x42; }
  void begin(bool reading) override { reads_begun += reading ? 1 : 0; }
  bool write(std::uint8_t byte) override {
    written.push_back(byte);
    return static_cast<int>(written.size()) != refuses;
  }
  std::uint8_t read() override { return static_cast<std::uint8_t>(100 + reads++); }
  void stop() override { ++stops; }

  Bytes written;
  int refuses = 0;  // number of the byte to refuse
  int reads = 0;
  int reads_begun = 0;
  int stops = 0;
};

class I2cTest : public ::testing::Test, public ModelChip {
 protected:
  void SetUp() override {
    set_up_pins();
    i2c.attach(device);
    bus.start(kInternalClocks, troubles);
  }
  bool transfer(const Bytes& out, Bytes& in, std::uint8_t address = 0x42) {
    return bus.transfer(address, out.data(), static_cast<std::uint8_t>(out.size()), in.data(),
                        static_cast<std::uint8_t>(in.size()));
  }
  void expect_usable() {
    device.written.clear();
    device.refuses = 0;
    Bytes none;
    EXPECT_TRUE(transfer({1, 2, 3}, none));
    EXPECT_EQ(device.written, (Bytes{1, 2, 3}));
  }
  Recorder device;
  I2c bus;
};

TEST_F(I2cTest, RunsAt400kHzFromEitherClock) {
  EXPECT_TRUE(i2c.set_up_for_400khz(16));
  bus.start(kFullClocks, troubles);
  EXPECT_TRUE(i2c.set_up_for_400khz(42));
}

TEST_F(I2cTest, WritesEveryLengthAndEndsWithAStop) {
  for (std::uint8_t size = 0; size <= I2c::kLongest; ++size) {
    Bytes out(size);
    std::iota(out.begin(), out.end(), std::uint8_t{7});
    Bytes none;
    device.written.clear();
    const int stops = device.stops;
    EXPECT_TRUE(transfer(out, none));
    EXPECT_EQ(device.written, out);
    bus.write(0x7F, 0, 0);
    EXPECT_EQ(device.stops, stops + 1) << int{size};
  }
}

TEST_F(I2cTest, ReadsEveryLengthAndNotOneByteMore) {
  for (std::uint8_t size = 1; size <= I2c::kLongest; ++size) {
    Bytes in(size);
    device.reads = 0;
    device.written.clear();
    ASSERT_TRUE(transfer({9}, in));
    Bytes expected(size);
    std::iota(expected.begin(), expected.end(), std::uint8_t{100});
    EXPECT_EQ(in, expected);
    EXPECT_EQ(device.reads, size);
    EXPECT_EQ(device.written, Bytes{9});
  }
  EXPECT_EQ(i2c.unwanted_bytes, 0);
  EXPECT_EQ(troubles.total(), 0U);
}

TEST_F(I2cTest, ReadsWithoutWritingFirst) {
  Bytes in(2);
  ASSERT_TRUE(transfer({}, in));
  EXPECT_EQ(in, (Bytes{100, 101}));
}

TEST_F(I2cTest, NobodyAtTheAddressIsANack) {
  Bytes none;
  EXPECT_FALSE(transfer({1}, none, 0x43));
  Bytes in(3);
  EXPECT_FALSE(transfer({}, in, 0x43));
  EXPECT_EQ(troubles.of(Trouble::i2c_nack), 2U);
  EXPECT_EQ(troubles.total(), 2U);
  expect_usable();
}

TEST_F(I2cTest, ARefusedByteIsANackWhereverItComes) {
  for (int refused = 1; refused <= 3; ++refused) {
    device.written.clear();
    device.refuses = refused;
    Bytes none;
    EXPECT_FALSE(transfer({1, 2, 3}, none));
    EXPECT_EQ(troubles.of(Trouble::i2c_nack), refused);
    expect_usable();
  }
}

struct FaultCase {
  model::I2cModel::Fault fault;
  Trouble trouble;
};

class I2cFaultTest : public I2cTest, public ::testing::WithParamInterface<FaultCase> {};

TEST_P(I2cFaultTest, EndsInItsNameWithinABoundAndTheBusIsFreeAfterwards) {
  for (const std::size_t reads : {0U, 1U, 2U, 3U, 12U}) {
    i2c.fault = GetParam().fault;
    const auto before = troubles.of(GetParam().trouble);
    const auto total = troubles.total();
    const double began = chip.now_us();
    Bytes in(reads);
    EXPECT_FALSE(transfer({1, 2}, in));
    EXPECT_LT(chip.now_us() - began, 2.0 * I2c::kTransferUs);
    EXPECT_EQ(troubles.of(GetParam().trouble), before + 1);
    EXPECT_EQ(troubles.total(), total + 1);
    i2c.fault = model::I2cModel::Fault::none;
    expect_usable();
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, I2cFaultTest,
    ::testing::Values(FaultCase{model::I2cModel::Fault::deaf, Trouble::i2c_timeout},
                      FaultCase{model::I2cModel::Fault::clock_held, Trouble::i2c_timeout},
                      FaultCase{model::I2cModel::Fault::arbitration, Trouble::i2c_arbitration_lost},
                      FaultCase{model::I2cModel::Fault::bus_error, Trouble::i2c_bus_error}));

/// The device holds the data line until so many clocks came.
class StuckBusTest : public I2cTest {
 protected:
  void hold_for(int clocks) {
    clocks_left = clocks;
    i2c.line_held = true;
    gpio_b.held_low = [this](std::uint8_t pin) { return pin == wiring::kI2cData.number && clocks_left > 0; };
    gpio_b.on_rise = [this](std::uint8_t pin) {
      if (pin == wiring::kI2cClock.number && clocks_left > 0) i2c.line_held = --clocks_left > 0;
    };
  }
  int clocks_left = 0;
};

TEST_F(StuckBusTest, IsFreedByUpToNineClocks) {
  for (int clocks = 1; clocks <= 9; ++clocks) {
    hold_for(clocks);
    expect_usable();
    EXPECT_EQ(troubles.of(Trouble::i2c_bus_stuck), clocks);
  }
  EXPECT_EQ(gpio_b.mode(wiring::kI2cData.number), model::GpioModel::kFunction);
  EXPECT_TRUE(gpio_b.open_drain(wiring::kI2cData.number));
  EXPECT_TRUE(gpio_b.open_drain(wiring::kI2cClock.number));
}

TEST_F(StuckBusTest, ABusHeldForEverFailsEachTimeWithinABound) {
  hold_for(1000000);
  for (unsigned i = 1; i <= 3; ++i) {
    const double began = chip.now_us();
    Bytes none;
    EXPECT_FALSE(transfer({1}, none));
    EXPECT_LT(chip.now_us() - began, 2.0 * I2c::kTransferUs);
    EXPECT_EQ(troubles.of(Trouble::i2c_bus_stuck), i);
  }
  hold_for(0);
  i2c.line_held = false;
  expect_usable();
}

}  // namespace
}  // namespace whisker::hal::stm32f405
