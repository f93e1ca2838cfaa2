#pragma once

#include "hal/boards/stm32f405/ranger_kind.hpp"

namespace whisker::hal::stm32f405 {

/// VL53L0X and compatible sensors: 8-bit registers, one to start, one for the status, one to read from. With
/// its default settings it measures about 30 times a second, dark targets up to 0.7 m and white ones up to 2
/// m.
extern const RangerKind kVl53l0x;

namespace vl53l0x {
constexpr uint8_t kDefaultAddress = 0x29;
/// Registers, from the maker's programming interface.
enum Reg : uint8_t {
  kStart = 0x00,            ///< kBackToBack: continuous measurement
  kInterruptClear = 0x0B,   ///< 1: acknowledges the measurement
  kInterruptStatus = 0x13,  ///< bits 0..2 not zero: a measurement is ready
  kRangeStatus = 0x14,      ///< bits 3..6; the distance follows as bytes 10 and 11, high byte first
  kAddress = 0x8A,
  kModel = 0xC0,  ///< kModelValue
};
constexpr uint8_t kBackToBack = 0x02;
constexpr uint8_t kModelValue = 0xEE;
constexpr uint8_t kRangeBytes = 12;
/// Values of the status. Others are failures: 1 to 3 of the laser, 15 of the line. They prove nothing.
constexpr uint8_t kValid = 11;
/// The returned light is too weak. This happens in open ground and for a black or slanted target. It is
/// reported as clear, and range_clear_m limits what it means.
constexpr uint8_t kNoSignal = 4;
/// A bit for each status with which kOutOfReachMm means the same: too weak, too noisy (5, 7), out of phase
/// (6, 9), or valid.
constexpr uint16_t kSeesNothing = 1U << kNoSignal | 1U << 5 | 1U << 6 | 1U << 7 | 1U << 9 | 1U << kValid;
constexpr uint16_t kOutOfReachMm = 8190;
constexpr uint8_t kRangingMs = 33;  ///< its default timing budget
}  // namespace vl53l0x

}  // namespace whisker::hal::stm32f405
