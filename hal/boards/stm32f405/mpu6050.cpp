#include "hal/boards/stm32f405/mpu6050.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using namespace mpu6050;

constexpr int32_t kLimit = 32767;
constexpr uint8_t kSampleBytes = 2;

}  // namespace

void Mpu6050::enter(Phase phase, uint32_t now_ms) noexcept {
  phase_ = phase;
  since_ms_ = sampled_ms_ = looked_ms_ = now_ms;
}

void Mpu6050::fail(Trouble trouble, uint32_t now_ms) noexcept {
  troubles_.count(trouble);
  enter(Phase::held, now_ms);
}

bool Mpu6050::identify() noexcept {
  uint8_t identity = 0;
  return setup_.possible && bus_.read(kAddress, kWhoAmI, &identity, 1) && identity == kIdentity;
}

/// After a reset, all other registers are 0.
bool Mpu6050::configure() noexcept {
  return bus_.write(kAddress, kPower, kClockOfZ) &&
         bus_.write(kAddress, kSampleRateDivider, setup_.divider) && bus_.write(kAddress, kConfig, kFilter) &&
         bus_.write(kAddress, kGyroConfig, setup_.full_scale);
}

bool Mpu6050::configured() noexcept {
  uint8_t is[3] = {};
  return bus_.read(kAddress, kSampleRateDivider, is, sizeof is) && is[0] == setup_.divider &&
         is[1] == kFilter && is[2] == setup_.full_scale;
}

void Mpu6050::poll(uint32_t now_ms) noexcept {
  switch (phase_) {
    case Phase::held:
      if (now_ms - since_ms_ < kHeldMs) return;
      if (!identify() || !bus_.write(kAddress, kPower, kReset))
        return fail(Trouble::gyro_not_started, now_ms);
      return enter(Phase::resetting, now_ms);
    case Phase::resetting:
      if (now_ms - since_ms_ < kResetMs) return;
      if (!configure()) return fail(Trouble::gyro_not_started, now_ms);
      return enter(Phase::settling, now_ms);
    case Phase::settling:
      if (now_ms - since_ms_ < kSettleMs) return;
      if (!configured() || !bus_.write(kAddress, kUserControl, kFifoOff) ||
          !bus_.write(kAddress, kFifoEnable, kRateToFifo) || !bus_.write(kAddress, kUserControl, kFifoOn)) {
        return fail(Trouble::gyro_not_started, now_ms);
      }
      return enter(Phase::sampling, now_ms);
    case Phase::sampling:
      if (now_ms - looked_ms_ >= kPollMs) sample(now_ms);
      return;
  }
}

void Mpu6050::sample(uint32_t now_ms) noexcept {
  uint8_t bytes[I2c::kLongest];
  uint16_t waiting = 0;
  if (bus_.read(kAddress, kFifoCount, bytes, 2)) waiting = static_cast<uint16_t>(bytes[0] << 8 | bytes[1]);
  looked_ms_ = now_ms;
  // A full FIFO has lost its oldest samples.
  if (waiting >= kFifoBytes) return fail(Trouble::gyro_samples_lost, now_ms);
  if (waiting < kSampleBytes) {
    if (now_ms - sampled_ms_ > kSilentMs) fail(Trouble::gyro_silent, now_ms);
    return;
  }
  const uint16_t most = waiting < sizeof bytes ? waiting : static_cast<uint16_t>(sizeof bytes);
  const auto size = static_cast<uint8_t>(most - most % kSampleBytes);
  // A read that breaks off has taken an unknown number of bytes.
  if (!bus_.read(kAddress, kFifo, bytes, size)) return fail(Trouble::gyro_samples_lost, now_ms);
  for (uint8_t i = 0; i < size; i = static_cast<uint8_t>(i + kSampleBytes)) {
    add(static_cast<int16_t>(static_cast<uint16_t>(bytes[i] << 8 | bytes[i + 1])));
  }
  sampled_ms_ = now_ms;
}

void Mpu6050::add(int32_t rate) noexcept {
  if (rate >= kLimit || rate <= -kLimit) {
    sums_.saturated = static_cast<uint16_t>(sums_.saturated + 1);
    rate = rate > 0 ? kLimit : -kLimit;
  }
  sums_.sum += static_cast<uint32_t>(rate * static_cast<int32_t>(facing_));
  sums_.samples = static_cast<uint16_t>(sums_.samples + 1);
}

bool Mpu6050::read(hal::GyroReading& out) noexcept {
  if (phase_ != Phase::sampling) return false;
  out = sums_;
  return true;
}

}  // namespace whisker::hal::stm32f405
