#include "hal/boards/stm32f405/ticker.hpp"

#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/tim.hpp"

namespace whisker::hal::stm32f405 {

void Ticker::start(const Clocks& clocks) noexcept {
  store(base::kTim2, tim::kPsc, clocks.timer2_hz / 1000000 - 1);
  store(base::kTim2, tim::kArr, UINT32_MAX);
  // The prescaler takes effect at the next update.
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

}  // namespace whisker::hal::stm32f405
