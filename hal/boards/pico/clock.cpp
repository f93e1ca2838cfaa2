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
/// 12 MHz times `feedback`, divided by both dividers.
struct Pll {
  Address base;
  uint32_t feedback;
  uint32_t divider1, divider2;
};
constexpr Pll kOfCore{base::kPllSys, 125, 6, 2};
constexpr Pll kOfUsb{base::kPllUsb, 100, 5, 5};
constexpr uint32_t kFromCrystal = 2;
constexpr uint32_t kFromPll = 1;  // of the auxiliary sources, the PLL is the first
constexpr uint32_t kCrystalMhz = 12;

bool selected(Register selected, uint32_t source, Patience& patience) noexcept {
  while ((load(base::kClocks, selected) >> source & 1U) == 0) {
    if (!patience.spend()) return false;
  }
  return true;
}

bool started(const Pll& pll, Patience& patience) noexcept {
  store(pll.base, pll::kCs, 1);
  store(pll.base, pll::kFbdivInt, pll.feedback);
  clear_bits(pll.base, pll::kPwr, mask(pll::kPd) | mask(pll::kVcopd));
  if (!patience.until(pll.base, pll::kLock, true)) return false;
  store(pll.base, pll::kPrim, bits(pll::kPostdiv1, pll.divider1) | bits(pll::kPostdiv2, pll.divider2));
  clear_bits(pll.base, pll::kPwr, mask(pll::kPostdivpd));
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

  if (!started(kOfCore, patience)) return false;
  store(base::kClocks, clocks::kClkSysCtrl, kFromPll);
  if (!selected(clocks::kClkSysSelected, kFromPll, patience)) return false;

  store(base::kClocks, clocks::kClkPeriCtrl, mask(clocks::kClkPeriEnable));
  store(base::kWatchdog, watchdog::kTick, mask(watchdog::kTickEnable) | bits(watchdog::kCycles, kCrystalMhz));
  return true;
}

bool start_usb_clock() noexcept {
  Patience patience = Patience::for_us(kStartUs, kCoreHz);
  if (!started(kOfUsb, patience)) return false;
  store(base::kClocks, clocks::kClkUsbCtrl, mask(clocks::kClkUsbEnable));
  return true;
}

}  // namespace whisker::hal::pico
