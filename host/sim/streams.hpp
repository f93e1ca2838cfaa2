/// The random number stream of each source of noise. Switching a source off does not change the numbers of
/// the others.
#pragma once

#include <stdint.h>

namespace whisker::sim {

constexpr uint32_t kStreamWheelScale = 0;
constexpr uint32_t kStreamDrift = 1;
// One of each per beam: add hal::Beam.
constexpr uint32_t kStreamRangeNoise = 16;
constexpr uint32_t kStreamDropout = 32;
constexpr uint32_t kStreamFalseClear = 48;
constexpr uint32_t kStreamPhantom = 64;
constexpr uint32_t kStreamCrosstalk = 80;

}  // namespace whisker::sim
