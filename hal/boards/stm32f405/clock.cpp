#include "hal/boards/stm32f405/clock.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/flash.hpp"
#include "hal/boards/stm32f405/reg/rcc.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr uint32_t kInternalHz = 16000000;
constexpr uint32_t kPllInputHz = 1000000;  // 1..2 MHz
constexpr uint32_t kPllFactor = 336;       // the PLL's oscillator: 100..432 MHz
constexpr uint32_t kPllDivideBy2 = 0;      // register code
constexpr uint32_t kPllQ = 7;              // 48 MHz for USB and SDIO
constexpr uint32_t kDivideBy2 = 4;         // register codes of the bus dividers
constexpr uint32_t kDivideBy4 = 5;
constexpr uint32_t kWaitStates = 5;  // of the flash, at 168 MHz and 3.3 V
constexpr uint32_t kFromPll = 2;
static_assert(kPllInputHz * kPllFactor / 2 == kFullClocks.core_hz);
static_assert(kFullClocks.core_hz / 2 == kFullClocks.apb2_hz &&
              kFullClocks.core_hz / 4 == kFullClocks.apb1_hz);

constexpr uint32_t kCrystalUs = 5000;  // a crystal takes 2 ms
constexpr uint32_t kPllUs = 1000;      // the PLL takes 0.3 ms
constexpr uint32_t kSwitchUs = 100;

bool wait(Field field, uint32_t us) noexcept {
  return Patience::for_us(us, kInternalHz).until(base::kRcc, field, true);
}

}  // namespace

Clocks start_clocks(Troubles& troubles) noexcept {
  set(base::kRcc, rcc::kHseon, 1);
  const bool crystal = wait(rcc::kHserdy, kCrystalUs);
  if (!crystal) {
    set(base::kRcc, rcc::kHseon, 0);
    troubles.count(Trouble::crystal_not_ready);
  }
  const uint32_t source_hz = crystal ? kCrystalHz : kInternalHz;
  store(base::kRcc, rcc::kPllcfgr,
        bits(rcc::kPllm, source_hz / kPllInputHz) | bits(rcc::kPlln, kPllFactor) |
            bits(rcc::kPllp, kPllDivideBy2) | bits(rcc::kPllq, kPllQ) | bits(rcc::kPllsrc, crystal ? 1 : 0));
  set(base::kRcc, rcc::kPllon, 1);
  if (!wait(rcc::kPllrdy, kPllUs)) {
    set(base::kRcc, rcc::kPllon, 0);
    troubles.count(Trouble::pll_not_locked);
    return kInternalClocks;
  }
  // The flash and the buses must be slow enough before the core clock rises.
  set(base::kFlash, flash::kLatency, kWaitStates);
  set(base::kFlash, flash::kPrften, 1);
  set(base::kFlash, flash::kIcen, 1);
  set(base::kFlash, flash::kDcen, 1);
  set(base::kRcc, rcc::kPpre1, kDivideBy4);
  set(base::kRcc, rcc::kPpre2, kDivideBy2);
  set(base::kRcc, rcc::kSw, kFromPll);
  Patience patience = Patience::for_us(kSwitchUs, kInternalHz);
  while (get(base::kRcc, rcc::kSws) != kFromPll) {
    if (patience.spend()) continue;
    set(base::kRcc, rcc::kSw, 0);
    set(base::kRcc, rcc::kPpre1, 0);
    set(base::kRcc, rcc::kPpre2, 0);
    troubles.count(Trouble::clock_not_switched);
    return kInternalClocks;
  }
  return kFullClocks;
}

}  // namespace whisker::hal::stm32f405
