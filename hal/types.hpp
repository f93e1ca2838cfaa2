/// The values at the hardware boundary. They are integers with the width used on a bus, so that a robot
/// behind a bus gets exactly the same bits as a robot on a board.
#pragma once

#include <stdint.h>

namespace whisker::hal {

enum class RangeStatus : uint8_t {
  ok,        ///< mm is a distance; at or beyond the maximum range it counts as clear
  clear,     ///< the sensor works, and no echo returned from within the maximum range; mm is not used
  too_near,  ///< an object nearer than the minimum range; mm is not used
  invalid,   ///< the reading is lost; mm is not used
  stale,     ///< the sensor has no new reading; mm is not used
};

constexpr uint16_t kMostMm = 65533;

/// The latest measurement of one rangefinder.
struct RangeReading {
  uint16_t mm;  ///< distance from the apex of the sensor in mm; 0..kMostMm
  RangeStatus status;
  uint8_t age_ms;    ///< since the distance was true, including the measurement; 255: that or more, ignored
  uint8_t sequence;  ///< increases by one with every new measurement, modulo 16
};

constexpr int kBeams = 3;
enum Beam : int { kLeft = 0, kFront = 1, kRight = 2 };

struct RangeReadings {
  RangeReading beam[kBeams];  ///< indexed by Beam
};

/// The bump switches: bit 1 << Beam is set if the switch on that side of the body is pressed. A body with one
/// switch reports it as kFront; one with a left and a right half reports both if it touches straight ahead.
struct BumperReading {
  uint8_t pressed;
};

constexpr uint8_t kAllSwitches = (1 << kBeams) - 1;

/// The samples of the gyro since power-up. A sample is the yaw rate, counter-clockwise positive, in units of
/// GyroParams::range / 32768; it lies within +-32767. Its time is 1 / GyroParams::rate_hz.
struct GyroReading {
  uint32_t sum;        ///< of all samples, modulo 2^32
  uint16_t samples;    ///< their number, modulo 2^16
  uint16_t saturated;  ///< how many of them were at the limit of the chip's range, modulo 2^16
};

/// Wheel rim speeds, 0.1 mm/s, forward positive; +-3.2767 m/s.
struct WheelSpeeds {
  int16_t left;
  int16_t right;
};

/// Encoder counts since power-up, modulo 2^24, forward positive.
struct EncoderCounts {
  uint32_t left;
  uint32_t right;
};

constexpr uint32_t kEncoderModulus = UINT32_C(1) << 24;

}  // namespace whisker::hal
