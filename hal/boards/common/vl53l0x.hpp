/// VL53L0X and compatible sensors: 8-bit registers, one to start, one for the status, one to read from. With
/// its default settings it measures about 30 times a second, dark targets up to 0.7 m and white ones up to 2
/// m.
#pragma once

#include "hal/types.hpp"

namespace whisker::hal::mcu::vl53l0x {
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

/// Sets mm and status from the bytes that start at kRangeStatus. It never says `clear` for a failure.
inline void decode(const uint8_t (&bytes)[kRangeBytes], RangeReading& out) noexcept {
  const uint8_t status = (bytes[0] >> 3) & 0x0F;
  out.mm = static_cast<uint16_t>((bytes[10] << 8) | bytes[11]);
  const bool nothing = out.mm >= kOutOfReachMm && (kSeesNothing >> status & 1U) != 0;
  if (nothing || status == kNoSignal) {
    out.status = RangeStatus::clear;
  } else {
    out.status = status == kValid ? RangeStatus::ok : RangeStatus::invalid;
  }
}

}  // namespace whisker::hal::mcu::vl53l0x
