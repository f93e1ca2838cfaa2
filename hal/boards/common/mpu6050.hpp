/// Facts of the MPU-6050, for its drivers.
#pragma once

#include "firmware/params.hpp"

namespace whisker::hal::mcu {

/// From the maker's "MPU-6000/MPU-6050 Register Map and Descriptions", RM-MPU-6000A-00, revision 4.2, and
/// "Product Specification", PS-MPU-6000A-00, revision 3.4.
namespace mpu6050 {
constexpr uint8_t kAddress = 0x68;  ///< with AD0 low
enum Reg : uint8_t {
  kSampleRateDivider = 0x19,  ///< samples at 1 kHz / (1 + divider), if the low pass filter is on
  kConfig = 0x1A,             ///< bits 0..2: the filter
  kGyroConfig = 0x1B,         ///< bits 3..4: full scale, 250 deg/s << n
  kFifoEnable = 0x23,         ///< bit 4: the rate about z goes to the FIFO
  kUserControl = 0x6A,        ///< bit 6: FIFO on; bit 2: empties it, while it is off
  kPower = 0x6B,              ///< bit 7: reset; bit 6: sleep; bits 0..2: clock source
  kFifoCount = 0x72,          ///< bytes in the FIFO, high byte first; the first byte latches both
  kFifo = 0x74,               ///< the oldest byte; a read of several does not move to the next register
  kWhoAmI = 0x75,
};
constexpr uint8_t kIdentity = 0x68;
constexpr uint8_t kReset = 0x80;
constexpr uint8_t kClockOfZ = 0x03;  ///< PLL on the gyro about z: steadier than the internal oscillator
constexpr uint8_t kFilter = 0x03;    ///< 42 Hz, delay 4.8 ms
constexpr uint8_t kRateToFifo = 0x10;
constexpr uint8_t kFifoOff = 0x04;  ///< and emptied
constexpr uint8_t kFifoOn = 0x40;
constexpr uint16_t kFifoBytes = 1024;
constexpr int32_t kFilteredHz = 1000;
constexpr uint32_t kResetMs = 100;
constexpr uint32_t kSettleMs = 50;  ///< the rate is within 1 deg/s of its final value 30 ms after the start

/// What the registers must hold. False: the chip does not have this rate or this range.
struct Setup {
  bool possible = false;
  uint8_t divider = 0;
  uint8_t full_scale = 0;
};
constexpr Setup setup_of(const GyroParams& gyro) noexcept {
  // 250 deg/s in microradians per second; a sample of 32768 is exactly the full scale.
  constexpr int32_t kSmallest = 4363323;
  if (gyro.rate_hz <= 0 || kFilteredHz % gyro.rate_hz != 0) return {};
  for (uint8_t n = 0; n < 4; ++n) {
    const int32_t off = gyro.range.raw() - (kSmallest << n);
    if (off > -10 && off < 10) {
      return {true, static_cast<uint8_t>(kFilteredHz / gyro.rate_hz - 1), static_cast<uint8_t>(n << 3)};
    }
  }
  return {};
}
}  // namespace mpu6050

/// How the chip lies on the robot.
enum class Facing : int8_t {
  up = 1,  ///< its lid looks up: its z axis, too
  down = -1,
};

}  // namespace whisker::hal::mcu
