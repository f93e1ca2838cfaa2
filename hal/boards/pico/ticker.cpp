#include "hal/boards/pico/ticker.hpp"

#include "hal/boards/pico/interrupts.hpp"
#include "hal/boards/pico/reg/timer.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kFirstAlarm = 1;
/// An alarm that lies nearer than this may be past before it is set, and would come 71 minutes late.
constexpr uint32_t kLeastUs = 20;

}  // namespace

void Ticker::start() noexcept {
  last_us_ = now_us();
  alarm_us_ = last_us_ + kPeriodUs;
  store(base::kTimer, timer::kInte, kFirstAlarm);
  store(base::kTimer, timer::kAlarm0, alarm_us_);
  enable(Interrupt::timer0);
}

uint32_t Ticker::now_us() noexcept { return load(base::kTimer, timer::kTimerawl); }

uint32_t Ticker::now_ms() noexcept {
  const uint32_t now = now_us();
  rest_us_ += now - last_us_;
  last_us_ = now;
  ms_ += rest_us_ / kPeriodUs;
  rest_us_ %= kPeriodUs;
  return ms_;
}

void Ticker::on_interrupt() noexcept {
  store(base::kTimer, timer::kIntr, kFirstAlarm);
  alarm_us_ += kPeriodUs;
  const uint32_t now = now_us();
  if (static_cast<int32_t>(alarm_us_ - now) < static_cast<int32_t>(kLeastUs)) alarm_us_ = now + kPeriodUs;
  store(base::kTimer, timer::kAlarm0, alarm_us_);
  alarms_ = static_cast<uint8_t>(alarms_ + 1);
}

void Ticker::sleep() noexcept {
  // Between the look and the sleep, no alarm may pass unseen: a pending interrupt ends the sleep all the
  // same.
  const Uninterrupted uninterrupted;
  if (alarms_ == seen_) wait_for_interrupt();
  seen_ = alarms_;
}

}  // namespace whisker::hal::pico
