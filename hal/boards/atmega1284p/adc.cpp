#include "hal/boards/atmega1284p/adc.hpp"

#include "hal/boards/atmega1284p/pins.hpp"

namespace whisker::hal::atmega1284p {
namespace {

constexpr uint8_t kDivideBy128 = bits::kADPS2 | bits::kADPS1 | bits::kADPS0;  // 125 kHz, of at most 200
constexpr uint16_t kPolls = 1000;                                             // of 7 cycles at least
constexpr int32_t kFullScale = 1023;

}  // namespace

void Adc::start() noexcept {
  for (const uint8_t channel : wiring::kInfraredChannel) set(reg::kDIDR0, bit(channel));
  store(reg::kADCSRA, bits::kADEN | kDivideBy128);
}

bool Adc::convert(uint8_t channel, int16_t& mv) noexcept {
  store(reg::kADMUX, bits::kREFS0 | channel);
  set(reg::kADCSRA, bits::kADSC);
  for (uint16_t polls = kPolls; is_set(reg::kADCSRA, bits::kADSC); --polls) {
    if (polls == 0) {
      troubles_.count(Trouble::adc_no_conversion);
      return false;
    }
  }
  const int32_t raw = load(reg::kADCL, reg::kADCH);
  mv = static_cast<int16_t>(raw * kSupplyMv / kFullScale);
  return true;
}

}  // namespace whisker::hal::atmega1284p
