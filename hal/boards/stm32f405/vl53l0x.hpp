#pragma once

#include "hal/boards/stm32f405/ranger_kind.hpp"

namespace whisker::hal::stm32f405 {

/// VL53L0X and what works like it: 8-bit registers, one to start, one to ask, one to read from. It measures
/// about 30 times a second with the settings that it wakes up with, to 1.2 m or more.
extern const RangerKind kVl53l0x;

namespace vl53l0x {
constexpr uint8_t kDefaultAddress = 0x29;
/// Its registers, after its maker's programming interface.
enum Reg : uint8_t {
  kStart = 0x00,            ///< kBackToBack: measures on and on
  kInterruptClear = 0x0B,   ///< 1: the measurement has been taken
  kInterruptStatus = 0x13,  ///< bits 0..2 not zero: there is a measurement
  kRangeStatus = 0x14,      ///< bits 3..6; the distance follows as bytes 10 and 11, high byte first
  kAddress = 0x8A,
  kModel = 0xC0,  ///< kModelValue
};
constexpr uint8_t kBackToBack = 0x02;
constexpr uint8_t kModelValue = 0xEE;
constexpr uint8_t kRangeBytes = 12;
/// Values of the status.
constexpr uint8_t kValid = 11;
/// The light came back too weak or out of phase. That is all that it says of open ground, and of a black or
/// slanted target: it is reported as clear, and proves as much as range_clear_m says.
constexpr uint8_t kNoSignal = 4;
constexpr uint16_t kOutOfReachMm = 8190;
constexpr uint8_t kRangingMs = 33;  ///< the timing budget that it wakes up with
}  // namespace vl53l0x

}  // namespace whisker::hal::stm32f405
