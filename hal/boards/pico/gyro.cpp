#include "hal/boards/pico/gyro.hpp"

namespace whisker::hal::pico {
namespace {

using namespace mcu::mpu6050;

constexpr int32_t kLimit = 32767;
constexpr uint8_t kSampleBytes = 2;

}  // namespace

void Gyro::adopt(const GyroParams& gyro, mcu::Facing facing) noexcept {
  setup_ = setup_of(gyro);
  facing_ = facing;
  step_ = gyro.fitted == Fitted::yes && setup_.possible ? Step::held : Step::off;
  published_.publish({});
}

void Gyro::enter(Step step, uint32_t now_ms) noexcept {
  step_ = step;
  since_ms_ = now_ms;
}

void Gyro::start_again(mcu::Events& why, uint32_t now_ms) noexcept {
  why.happened();
  published_.publish({});
  enter(Step::held, now_ms);
}

bool Gyro::next(uint32_t now_ms, I2c::Transfer& transfer) noexcept {
  const uint32_t passed = now_ms - since_ms_;
  const auto write = [&](uint8_t reg, uint8_t value) {
    transfer = {kAddress, {reg, value}, 2, 0};
    return true;
  };
  const auto read = [&](uint8_t reg, uint8_t size) {
    transfer = {kAddress, {reg}, 1, size};
    return true;
  };
  switch (step_) {
    case Step::off: return false;
    case Step::held:
      if (passed < kHeldMs) return false;
      enter(Step::identify, now_ms);
      [[fallthrough]];
    case Step::identify: return read(kWhoAmI, 1);
    case Step::reset: return write(kPower, kReset);
    case Step::resetting:
      if (passed < kResetMs) return false;
      enter(Step::clock, now_ms);
      [[fallthrough]];
    case Step::clock: return write(kPower, kClockOfZ);
    case Step::divider: return write(kSampleRateDivider, setup_.divider);
    case Step::filter: return write(kConfig, kFilter);
    case Step::scale: return write(kGyroConfig, setup_.full_scale);
    case Step::settling:
      if (passed < kSettleMs) return false;
      enter(Step::verify, now_ms);
      [[fallthrough]];
    case Step::verify: return read(kSampleRateDivider, 3);
    case Step::fifo_off: return write(kUserControl, kFifoOff);
    case Step::fifo_source: return write(kFifoEnable, kRateToFifo);
    case Step::fifo_on: return write(kUserControl, kFifoOn);
    case Step::count: return passed >= kPollMs && read(kFifoCount, 2);
    case Step::fetch: return read(kFifo, size_);
  }
  return false;
}

bool Gyro::succeed(uint32_t now_ms, const I2c& bus) noexcept {
  const uint8_t* in = bus.in();
  switch (step_) {
    case Step::off:
    case Step::held:
    case Step::resetting:
    case Step::settling: return false;
    case Step::identify:
      if (in[0] == kIdentity) break;
      start_again(not_started_, now_ms);
      return false;
    case Step::verify:
      if (in[0] == setup_.divider && in[1] == kFilter && in[2] == setup_.full_scale) break;
      start_again(not_started_, now_ms);
      return false;
    case Step::count: return see_count(now_ms, bus);
    case Step::fetch: take(now_ms, bus); return false;
    case Step::fifo_on: sampled_ms_ = now_ms; break;
    case Step::reset:
    case Step::clock:
    case Step::divider:
    case Step::filter:
    case Step::scale:
    case Step::fifo_off:
    case Step::fifo_source: break;
  }
  enter(static_cast<Step>(static_cast<uint8_t>(step_) + 1), now_ms);
  return step_ != Step::count;
}

/// A full FIFO has lost its oldest samples.
bool Gyro::see_count(uint32_t now_ms, const I2c& bus) noexcept {
  const uint16_t waiting = static_cast<uint16_t>(bus.in()[0] << 8 | bus.in()[1]);
  since_ms_ = now_ms;
  if (waiting >= kFifoBytes) {
    start_again(lost_, now_ms);
  } else if (waiting >= kSampleBytes) {
    const uint16_t most = waiting < I2c::kLongest ? waiting : uint16_t{I2c::kLongest};
    size_ = static_cast<uint8_t>(most - most % kSampleBytes);
    step_ = Step::fetch;
    return true;
  } else if (now_ms - sampled_ms_ > kSilentMs) {
    start_again(silent_, now_ms);
  }
  return false;
}

void Gyro::take(uint32_t now_ms, const I2c& bus) noexcept {
  for (uint8_t i = 0; i < size_; i = static_cast<uint8_t>(i + kSampleBytes)) {
    add(static_cast<int16_t>(static_cast<uint16_t>(bus.in()[i] << 8 | bus.in()[i + 1])));
  }
  sampled_ms_ = now_ms;
  step_ = Step::count;
  published_.publish({sums_, true});
}

void Gyro::add(int32_t rate) noexcept {
  if (rate >= kLimit || rate <= -kLimit) {
    sums_.saturated = static_cast<uint16_t>(sums_.saturated + 1);
    rate = rate > 0 ? kLimit : -kLimit;
  }
  sums_.sum += static_cast<uint32_t>(rate * static_cast<int32_t>(facing_));
  sums_.samples = static_cast<uint16_t>(sums_.samples + 1);
}

/// A fetch that breaks off has taken an unknown number of bytes.
void Gyro::fail(uint32_t now_ms) noexcept {
  if (step_ == Step::fetch) return start_again(lost_, now_ms);
  if (step_ != Step::count) return start_again(not_started_, now_ms);
  since_ms_ = now_ms;
  if (now_ms - sampled_ms_ > kSilentMs) start_again(silent_, now_ms);
}

bool Gyro::read(hal::GyroReading& out) noexcept {
  Sums last;
  if (!published_.read(last) || !last.samples) return false;
  out = last.reading;
  return true;
}

void Gyro::collect(Troubles& troubles) noexcept {
  troubles.count(Trouble::gyro_not_started, not_started_.collect());
  troubles.count(Trouble::gyro_silent, silent_.collect());
  troubles.count(Trouble::gyro_samples_lost, lost_.collect());
}

}  // namespace whisker::hal::pico
