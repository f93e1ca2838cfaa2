#include "hal/boards/stm32f405/watchdog.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/iwdg.hpp"

namespace whisker::hal::stm32f405 {
namespace {

enum Key : uint32_t { kReload = 0xAAAA, kUnlock = 0x5555, kStart = 0xCCCC };
constexpr uint32_t kDivideBy32 = 3;    // of 32 kHz: one count per millisecond
constexpr uint32_t kUpdateUs = 10000;  // six cycles of the divided oscillator take 6 ms

}  // namespace

bool Watchdog::start(uint16_t timeout_ms, const Clocks& clocks, Troubles& troubles) noexcept {
  // The watchdog accepts values only while its oscillator runs; starting the watchdog starts the oscillator.
  store(base::kIwdg, iwdg::kKr, kStart);
  store(base::kIwdg, iwdg::kKr, kUnlock);
  Patience patience = Patience::for_us(kUpdateUs, clocks.core_hz);
  bool ready = patience.until(base::kIwdg, iwdg::kPvu, false);
  store(base::kIwdg, iwdg::kPr, kDivideBy32);
  ready = patience.until(base::kIwdg, iwdg::kRvu, false) && ready;
  store(base::kIwdg, iwdg::kRlr, timeout_ms);
  ready = patience.until(base::kIwdg, iwdg::kPvu, false) && ready;
  ready = patience.until(base::kIwdg, iwdg::kRvu, false) && ready;
  feed();
  if (!ready) troubles.count(Trouble::watchdog_not_ready);
  return ready;
}

void Watchdog::feed() noexcept { store(base::kIwdg, iwdg::kKr, kReload); }

}  // namespace whisker::hal::stm32f405
