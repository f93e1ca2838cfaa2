#include "hal/boards/pico/i2c.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/pico/clock.hpp"
#include "hal/boards/pico/interrupts.hpp"
#include "hal/boards/pico/pins.hpp"
#include "hal/boards/pico/reg/i2c.hpp"
#include "hal/boards/pico/reg/resets.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kBusHz = 400000;
constexpr uint32_t kPeriod = (kCoreHz + kBusHz / 2) / kBusHz;  // in cycles of the core
constexpr uint32_t kLow = kPeriod * 3 / 5;                     // at least 1.3 us
constexpr uint32_t kFast = 2;
constexpr uint32_t kHoldNs = 300;
constexpr uint32_t kHold = kCoreHz / 1000000 * kHoldNs / 1000 + 1;
constexpr uint32_t kSpikeNs = 50;
constexpr uint32_t kSpike = kCoreHz / 1000000 * kSpikeNs / 1000 + 1;
constexpr int kFreeingClocks = 9;
constexpr uint32_t kHalfClockUs = 5;
constexpr uint32_t kResetPolls = 1000;

void pause() noexcept {
  // The loads take the time.
  for (Patience patience = Patience::for_us(kHalfClockUs, kCoreHz); patience.spend();)
    load(base::kSio, sio::kGpioIn);
}

}  // namespace

void I2c::start() noexcept {
  configure();
  enable(Interrupt::i2c0);
}

void I2c::configure() noexcept {
  store(base::kI2c0, i2c::kIcEnable, 0);
  store(base::kI2c0, i2c::kIcCon,
        mask(i2c::kMasterMode) | mask(i2c::kIcSlaveDisable) | mask(i2c::kIcRestartEn) |
            bits(i2c::kSpeed, kFast));
  store(base::kI2c0, i2c::kIcFsSclHcnt, kPeriod - kLow);
  store(base::kI2c0, i2c::kIcFsSclLcnt, kLow);
  store(base::kI2c0, i2c::kIcFsSpklen, kSpike);
  store(base::kI2c0, i2c::kIcSdaHold, kHold);
  store(base::kI2c0, i2c::kIcIntrMask, mask(i2c::kMTxAbrt) | mask(i2c::kMStopDet));
}

void I2c::begin(const Transfer& transfer) noexcept {
  refused_ = false;
  in_size_ = transfer.in_size;
  // The target can be set only while the controller is off.
  store(base::kI2c0, i2c::kIcEnable, 0);
  store(base::kI2c0, i2c::kIcTar, transfer.address);
  store(base::kI2c0, i2c::kIcEnable, 1);
  // A refusal must not see the rest of the commands as another transfer.
  const Uninterrupted uninterrupted;
  for (uint8_t i = 0; i < transfer.out_size; ++i) {
    const bool last = i + 1 == transfer.out_size && transfer.in_size == 0;
    store(base::kI2c0, i2c::kIcDataCmd, transfer.out[i] | bits(i2c::kStop, last ? 1 : 0));
  }
  for (uint8_t i = 0; i < transfer.in_size; ++i) {
    const bool last = i + 1 == transfer.in_size;
    store(base::kI2c0, i2c::kIcDataCmd,
          mask(i2c::kCmd) | bits(i2c::kRestart, i == 0 ? 1 : 0) | bits(i2c::kStop, last ? 1 : 0));
  }
}

I2c::End I2c::on_interrupt() noexcept {
  const uint32_t why = load(base::kI2c0, i2c::kIcIntrStat);
  if ((why & mask(i2c::kMTxAbrt)) != 0) {
    const bool lost = is_set(base::kI2c0, i2c::kArbLost);
    load(base::kI2c0, i2c::kIcClrTxAbrt);
    refused_ = true;
    if (lost) return End::lost;
  }
  if ((why & mask(i2c::kMStopDet)) == 0) return End::none;
  load(base::kI2c0, i2c::kIcClrStopDet);
  if (refused_ || load(base::kI2c0, i2c::kIcRxflr) != in_size_) return End::no_answer;
  for (uint8_t i = 0; i < in_size_; ++i) in_[i] = static_cast<uint8_t>(load(base::kI2c0, i2c::kIcDataCmd));
  return End::done;
}

void I2c::recover() noexcept {
  using namespace wiring;
  set_bits(base::kResets, resets::kReset, mask(resets::kI2c0));
  // Open drain: driven low, or left to the pull.
  constexpr Gpio kLines[] = {kI2cClock, kI2cData};
  for (const Gpio pin : kLines) {
    write(pin, false);
    drive(pin, false);
    connect(pin, Function::sio, Pull::up);
  }
  for (int i = 0; i < kFreeingClocks && !read(kI2cData); ++i) {
    drive(kI2cClock, true);
    pause();
    drive(kI2cClock, false);
    pause();
  }
  // A stop: the data line rises while the clock is high.
  drive(kI2cClock, true);
  drive(kI2cData, true);
  pause();
  drive(kI2cClock, false);
  pause();
  drive(kI2cData, false);
  pause();
  connect(kI2cData, Function::i2c, Pull::up);
  connect(kI2cClock, Function::i2c, Pull::up);
  clear_bits(base::kResets, resets::kReset, mask(resets::kI2c0));
  Patience(kResetPolls).until(base::kResets, resets::kI2c0, false);
  configure();
}

}  // namespace whisker::hal::pico
