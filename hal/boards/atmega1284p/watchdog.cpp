#include "hal/boards/atmega1284p/watchdog.hpp"

#include "hal/boards/atmega1284p/registers.hpp"

namespace whisker::hal::atmega1284p {

void Watchdog::start() noexcept {
  feed();
  // A reset by the watchdog leaves it running, and its flag must go before it can be set anew.
  store(reg::kMCUSR, 0);
  constexpr uint8_t kUnlock = bits::kWDCE | bits::kWDE;
  constexpr uint8_t kQuarterSecond = bits::kWDE | bits::kWDP2;
  store(reg::kWDTCSR, kUnlock);
  store(reg::kWDTCSR, kQuarterSecond);
}

}  // namespace whisker::hal::atmega1284p
