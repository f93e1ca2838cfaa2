#include "hal/boards/atmega1284p/ticker.hpp"

#include "hal/boards/atmega1284p/registers.hpp"

namespace whisker::hal::atmega1284p {
namespace {

constexpr uint8_t kCountsPerMs = 250;  // 16 MHz / 64

}  // namespace

void Ticker::start() noexcept {
  store(reg::kOCR2A, kCountsPerMs - 1);
  store(reg::kTCCR2A, bits::kWGM21);
  store(reg::kTIMSK2, bits::kOCIE2A);
  store(reg::kTCCR2B, bits::kCS22);
}

}  // namespace whisker::hal::atmega1284p
