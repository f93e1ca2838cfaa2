#include "hal/boards/pico/sensor_bus.hpp"

#include "hal/boards/pico/interrupts.hpp"

namespace whisker::hal::pico {

void SensorBus::start(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  rangers_.start(now_ms);
  bus_.start();
}

void SensorBus::adopt(const GyroParams& gyro, bool ranged) noexcept {
  gyro_.adopt(gyro);
  const uint8_t first = ranged ? 0 : kGyro;
  if (first != first_) rangers_.start(now_ms_);
  first_ = first;
}

void SensorBus::collect(Troubles& troubles) noexcept {
  troubles.count(Trouble::i2c_no_answer, no_answer_.collect());
  troubles.count(Trouble::i2c_timeout, timeouts_.collect());
  rangers_.collect(troubles);
  gyro_.collect(troubles);
}

void SensorBus::on_millisecond() noexcept {
  ++now_ms_;
  rangers_.on_millisecond();
  if (busy_) {
    if (now_ms_ - begun_ms_ < kTransferMs) return;
    timeouts_.happened();
    bus_.recover();
    fail();
  }
  serve(first_);
}

/// From this turn on, until a transfer begins or all have had theirs.
void SensorBus::serve(uint8_t turn) noexcept {
  for (; turn <= kGyro; ++turn) {
    I2c::Transfer transfer;
    if (turn == kGyro ? !gyro_.next(now_ms_, transfer) : !rangers_.next(turn, transfer)) continue;
    turn_ = turn;
    begun_ms_ = now_ms_;
    busy_ = true;
    bus_.begin(transfer);
    return;
  }
}

bool SensorBus::succeed() noexcept {
  return turn_ == kGyro ? gyro_.succeed(now_ms_, bus_) : rangers_.succeed(turn_, bus_);
}

void SensorBus::fail() noexcept {
  busy_ = false;
  if (turn_ == kGyro) {
    gyro_.fail(now_ms_);
  } else {
    rangers_.fail(turn_);
  }
}

void SensorBus::on_interrupt() noexcept {
  const I2c::End end = bus_.on_interrupt();
  if (end == I2c::End::none || !busy_) return;
  busy_ = false;
  bool goes_on = false;
  if (end == I2c::End::done) {
    goes_on = succeed();
  } else {
    no_answer_.happened();
    if (end == I2c::End::lost) bus_.recover();
    fail();
  }
  serve(goes_on ? turn_ : static_cast<uint8_t>(turn_ + 1));
}

}  // namespace whisker::hal::pico
