/// Conversion between encoder counts modulo 2^24 and 16-bit counters.
#pragma once

#include <stdint.h>

#include "hal/types.hpp"

namespace whisker::hal::mcu {

/// Counts between two readings, forward positive. Valid for less than 32768 counts.
constexpr int16_t counts_between(uint32_t before, uint32_t after) noexcept {
  const uint16_t step = static_cast<uint16_t>(after - before);
  return static_cast<int16_t>(step <= INT16_MAX ? step : int32_t{step} - INT32_C(0x10000));
}

/// Continues a total with the new value of its 16-bit counter; valid for less than 32768 counts.
constexpr uint32_t follow_counter(uint32_t total, uint16_t counter) noexcept {
  const int16_t step = counts_between(total, counter);
  return (total + static_cast<uint32_t>(int32_t{step})) % hal::kEncoderModulus;
}

static_assert(counts_between(0, 5) == 5 && counts_between(2, 0xFFFFFF) == -3);
static_assert(follow_counter(0xFFFFFF, 1) == 1 && follow_counter(0, 0xFFFF) == 0xFFFFFF);

}  // namespace whisker::hal::mcu
