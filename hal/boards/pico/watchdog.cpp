#include "hal/boards/pico/watchdog.hpp"

#include "hal/boards/pico/io.hpp"
#include "hal/boards/pico/reg/bases.hpp"
#include "hal/boards/pico/reg/psm.hpp"
#include "hal/boards/pico/reg/watchdog.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kStages = 0x1FFFF;
/// Erratum RP2040-E1: it counts down by two every microsecond.
constexpr uint32_t kCountsPerMs = 2000;

}  // namespace

void Watchdog::start(uint32_t timeout_ms) noexcept {
  load_ = timeout_ms * kCountsPerMs;
  // It resets what is chosen here: everything but the oscillators.
  set_bits(base::kPsm, psm::kWdsel, kStages & ~(mask(psm::kRosc) | mask(psm::kXosc)));
  feed();
  set_bits(base::kWatchdog, watchdog::kCtrl, mask(watchdog::kEnable));
}

void Watchdog::feed() noexcept { store(base::kWatchdog, watchdog::kLoad, load_); }

}  // namespace whisker::hal::pico
