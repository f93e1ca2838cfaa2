/// Which stream of random numbers feeds which source of noise. A source that is off changes no other's
/// numbers.
#pragma once

#include <stdint.h>

namespace whisker::sim {

constexpr uint32_t kStreamWheelScale = 0;
constexpr uint32_t kStreamDrift = 1;
// One of each per beam: add hal::Beam.
constexpr uint32_t kStreamRangeNoise = 16;
constexpr uint32_t kStreamDropout = 32;
constexpr uint32_t kStreamFalseClear = 48;

}  // namespace whisker::sim
