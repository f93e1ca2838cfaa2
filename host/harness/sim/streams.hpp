/// The random number stream of each source of noise. Switching a source off does not change the numbers of
/// the others.
#pragma once

#include <stdint.h>

namespace whisker::sim {

constexpr uint32_t kStreamWheelScale = 0;
constexpr uint32_t kStreamDrift = 1;
constexpr uint32_t kStreamWheelScaleCommon = 2;
// One per wheel: add 0 for the left and 1 for the right one.
constexpr uint32_t kStreamWheelSlip = 3;
constexpr uint32_t kStreamGyroBias = 5;
constexpr uint32_t kStreamGyroScale = 6;
constexpr uint32_t kStreamGyroWalk = 7;
constexpr uint32_t kStreamGyroWarmUp = 8;
constexpr uint32_t kStreamFix = 9;
// One of each per beam: add hal::Beam.
constexpr uint32_t kStreamRangeNoise = 16;
constexpr uint32_t kStreamDropout = 32;
constexpr uint32_t kStreamFalseClear = 48;
constexpr uint32_t kStreamPhantom = 64;
constexpr uint32_t kStreamCrosstalk = 80;
constexpr uint32_t kStreamCoverGlass = 96;
// Which obstacles absorb; one per kind of obstacle, so that a new one changes no other kind: add its Kind.
constexpr uint32_t kStreamSoft = 112;

}  // namespace whisker::sim
