/// The seam for rangefinders on I2C: a kind of sensor is two functions.
#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/i2c.hpp"
#include "hal/types.hpp"

namespace whisker::hal::stm32f405 {

enum class Taken : uint8_t {
  nothing_new,  ///< it is still measuring
  measured,
  failed,  ///< it did not answer, or not as its kind does
};

/// To add a kind, write the two functions on I2c::transfer() and hand a RangerKind to I2cRangers. Both may
/// do a few transfers and must not wait for anything else: `take` is called again some milliseconds later.
///
/// A VL53L1X fits: its registers have 16-bit indices, and its `start` first writes the block of settings
/// that its maker publishes under a licence of their own, which is why that block is not part of this
/// project.
struct RangerKind {
  /// The sensor has just woken, alone at its default address: move it to `address` and let it measure on and
  /// on. False: it did not answer, or is another kind.
  bool (*start)(I2c& bus, uint8_t address) noexcept;
  /// Fetches a measurement made since the last one, if there is one: fills in mm and status of `out`.
  Taken (*take)(I2c& bus, uint8_t address, hal::RangeReading& out) noexcept;
  uint16_t wake_ms;    ///< from the release of its reset until it answers
  uint16_t silent_ms;  ///< without a measurement for this long it is taken for dead
  uint8_t ranging_ms;  ///< what a measurement takes: a part of its age when it is fetched
};

}  // namespace whisker::hal::stm32f405
