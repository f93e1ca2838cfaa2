#include "hal/boards/stm32f405/adc.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/stm32f405/reg/adc.hpp"
#include "hal/boards/stm32f405/reg/adc_common.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr uint32_t kDivideBy4 = 1;  // 21 MHz; at most 36 MHz allowed
constexpr uint32_t kSample84 = 4;   // register code for 84 cycles
constexpr uint32_t kConversionUs = 50;
constexpr int32_t kFullScale = 4095;

constexpr uint32_t sample_times() noexcept {
  uint32_t all = 0;
  for (uint32_t channel = 0; channel < 9; ++channel) all |= kSample84 << (3 * channel);
  return all;
}

}  // namespace

void Adc::start(const Clocks& clocks, Troubles& troubles) noexcept {
  troubles_ = &troubles;
  core_hz_ = clocks.core_hz;
  set(base::kAdcCommon, adc_common::kAdcpre, kDivideBy4);
  store(base::kAdc1, adc::kSmpr1, sample_times());
  set(base::kAdc1, adc::kAdon, 1);
}

bool Adc::convert(uint8_t channel, int16_t& mv) noexcept {
  // A result that arrived late would be mistaken for this conversion's.
  store(base::kAdc1, adc::kSr, 0);
  set(base::kAdc1, adc::kSq1, channel);
  set(base::kAdc1, adc::kSwstart, 1);
  if (!Patience::for_us(kConversionUs, core_hz_).until(base::kAdc1, adc::kEoc, true)) {
    set(base::kAdc1, adc::kAdon, 0);
    set(base::kAdc1, adc::kAdon, 1);
    troubles_->count(Trouble::adc_no_conversion);
    return false;
  }
  const int32_t raw = static_cast<int32_t>(load(base::kAdc1, adc::kDr) & 0xFFF);
  mv = static_cast<int16_t>(raw * kSupplyMv / kFullScale);
  return true;
}

}  // namespace whisker::hal::stm32f405
