#include "hal/mcu/stm32f405/ticker.hpp"

#include "hal/mcu/stm32f405/reg/bases.hpp"
#include "hal/mcu/stm32f405/reg/tim.hpp"

namespace whisker::stm32f405 {

void Ticker::start(const Clocks& clocks) noexcept {
  store(base::kTim2, tim::kPsc, clocks.timer2_hz / 1000000 - 1);
  store(base::kTim2, tim::kArr, UINT32_MAX);
  // The prescaler counts only from the next update on.
  store(base::kTim2, tim::kEgr, bits(tim::kUg, 1));
  set(base::kTim2, tim::kCen, 1);
  last_us_ = now_us();
}

uint32_t Ticker::now_us() const noexcept { return load(base::kTim2, tim::kCnt); }

uint32_t Ticker::now_ms() noexcept {
  const uint32_t now = now_us();
  rest_us_ += now - last_us_;
  last_us_ = now;
  ms_ += rest_us_ / 1000;
  rest_us_ %= 1000;
  return ms_;
}

bool Schedule::due(uint32_t now_ms) noexcept {
  const uint32_t late = now_ms - next_;
  if (late > INT32_MAX) return false;
  const uint32_t periods = late / period_;
  missed_ += periods;
  next_ += (periods + 1) * period_;
  return true;
}

}  // namespace whisker::stm32f405
