#include "hal/boards/pico/clock.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/pico/io.hpp"
#include "hal/boards/pico/reg/bases.hpp"
#include "hal/boards/pico/reg/clocks.hpp"
#include "hal/boards/pico/reg/pll.hpp"
#include "hal/boards/pico/reg/watchdog.hpp"
#include "hal/boards/pico/reg/xosc.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kRingHz = 12000000;  // the ring oscillator is no faster: data sheet, 2.17.2
constexpr uint32_t kStartUs = 10000;
constexpr uint32_t kRangeTo15Mhz = 0xAA0;
constexpr uint32_t kEnable = 0xFAB;
constexpr uint32_t kStartUp = 47;  // units of 256 cycles of the crystal: 1 ms
// 12 MHz times 125, divided by 6 and by 2.
constexpr uint32_t kFeedback = 125;
constexpr uint32_t kDivider1 = 6, kDivider2 = 2;
constexpr uint32_t kFromCrystal = 2;
constexpr uint32_t kFromPll = 1;  // of the auxiliary sources, the PLL is the first
constexpr uint32_t kCrystalMhz = 12;

bool selected(Register selected, uint32_t source, Patience& patience) noexcept {
  while ((load(base::kClocks, selected) >> source & 1U) == 0) {
    if (!patience.spend()) return false;
  }
  return true;
}

}  // namespace

bool start_clocks() noexcept {
  Patience patience = Patience::for_us(2 * kStartUs, kRingHz);
  store(base::kXosc, xosc::kStartup, kStartUp);
  store(base::kXosc, xosc::kCtrl, kRangeTo15Mhz | bits(xosc::kEnable, kEnable));
  if (!patience.until(base::kXosc, xosc::kStable, true)) return false;
  store(base::kClocks, clocks::kClkRefCtrl, kFromCrystal);
  if (!selected(clocks::kClkRefSelected, kFromCrystal, patience)) return false;

  store(base::kPllSys, pll::kCs, 1);
  store(base::kPllSys, pll::kFbdivInt, kFeedback);
  clear_bits(base::kPllSys, pll::kPwr, mask(pll::kPd) | mask(pll::kVcopd));
  if (!patience.until(base::kPllSys, pll::kLock, true)) return false;
  store(base::kPllSys, pll::kPrim, bits(pll::kPostdiv1, kDivider1) | bits(pll::kPostdiv2, kDivider2));
  clear_bits(base::kPllSys, pll::kPwr, mask(pll::kPostdivpd));
  store(base::kClocks, clocks::kClkSysCtrl, kFromPll);
  if (!selected(clocks::kClkSysSelected, kFromPll, patience)) return false;

  store(base::kClocks, clocks::kClkPeriCtrl, mask(clocks::kClkPeriEnable));
  store(base::kWatchdog, watchdog::kTick, mask(watchdog::kTickEnable) | bits(watchdog::kCycles, kCrystalMhz));
  return true;
}

}  // namespace whisker::hal::pico
