#include "hal/boards/stm32f405/random.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/rng.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr uint32_t kDrawUs = 250;  // a number takes 40 periods of 48 MHz

}  // namespace

bool draw_random(const Clocks& clocks, Troubles& troubles, uint32_t& number) noexcept {
  set(base::kRng, rng::kRngen, 1);
  Patience patience = Patience::for_us(kDrawUs, clocks.core_hz);
  uint32_t drawn[2] = {};
  bool ready = true;
  for (uint32_t& next : drawn) {
    ready = ready && patience.until(base::kRng, rng::kDrdy, true);
    next = load(base::kRng, rng::kDr);
  }
  set(base::kRng, rng::kRngen, 0);
  // The reference manual: the first number only serves to compare the second one with it.
  if (!ready || drawn[0] == drawn[1]) {
    troubles.count(Trouble::random_not_ready);
    return false;
  }
  number = drawn[1];
  return true;
}

}  // namespace whisker::hal::stm32f405
