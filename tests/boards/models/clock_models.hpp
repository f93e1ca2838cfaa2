#pragma once

#include "hal/boards/stm32f405/reg/flash.hpp"
#include "hal/boards/stm32f405/reg/rcc.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// Oscillators and the clock switch, each with a possible fault.
class RccModel : public Peripheral {
 public:
  RccModel() { word(rcc::kCr.offset) = 0x83; }

  void advance() override {
    put(rcc::kHserdy, get(rcc::kHseon) != 0 && !dead_crystal && ++crystal_ > 1000 ? 1 : 0);
    const bool source = get(rcc::kPllsrc) == 0 || get(rcc::kHserdy) != 0;
    put(rcc::kPllrdy, get(rcc::kPllon) != 0 && source && !pll_without_lock && ++pll_ > 100 ? 1 : 0);
    if (switch_stuck) return;
    const std::uint32_t wanted = get(rcc::kSw);
    if (wanted != 2 || get(rcc::kPllrdy) != 0) put(rcc::kSws, wanted);
  }
  /// Core clock for the current set-up; 0 if the data sheet forbids it.
  double core_mhz(RccModel& rcc, Peripheral& flash) {
    if (rcc.get(rcc::kSws) == 0) return 16;
    const double input = get(rcc::kPllsrc) != 0 ? 8 : 16;
    const double vco_in = input / get(rcc::kPllm);
    const double vco = vco_in * get(rcc::kPlln);
    const double core = vco / (2 * (get(rcc::kPllp) + 1));
    const bool allowed = vco_in >= 1 && vco_in <= 2 && vco >= 100 && vco <= 432 && core <= 168 &&
                         core <= 30 * (flash.get(flash::kLatency) + 1);
    return allowed ? core : 0;
  }
  double bus_mhz(double core, Field prescaler) {
    const std::uint32_t code = get(prescaler);
    return code < 4 ? core : core / (2 << (code - 4));
  }

  bool dead_crystal = false;
  bool pll_without_lock = false;
  bool switch_stuck = false;

 private:
  int crystal_ = 0;
  int pll_ = 0;
};

}  // namespace whisker::hal::stm32f405::model
