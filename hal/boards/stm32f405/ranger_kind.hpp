/// Interface of rangefinders on I2C: a kind of sensor consists of two functions.
#pragma once

#include <stdint.h>

#include "hal/boards/stm32f405/i2c.hpp"
#include "hal/types.hpp"

namespace whisker::hal::stm32f405 {

enum class Taken : uint8_t {
  nothing_new,  ///< it is still measuring
  measured,
  failed,  ///< no answer, or not the answer of its kind
};

/// To add a kind, write the two functions with I2c::transfer() and pass a RangerKind to I2cRangers. Both may
/// do a few transfers and must not wait for anything else: `take` is called again some milliseconds later.
///
/// A VL53L1X fits. Its registers have 16-bit indices, and its `start` first writes a block of settings that
/// its maker publishes under its own licence, so this project does not contain that block.
struct RangerKind {
  /// The sensor has just started, alone at its default address: move it to `address` and start continuous
  /// measurement. False: it did not answer, or is another kind.
  bool (*start)(I2c& bus, uint8_t address) noexcept;
  /// Fetches a new measurement, if there is one: sets mm and status of `out`.
  Taken (*take)(I2c& bus, uint8_t address, hal::RangeReading& out) noexcept;
  uint16_t wake_ms;    ///< from the release of its reset until it answers
  uint16_t silent_ms;  ///< without a measurement for this long, the sensor is restarted
  uint8_t ranging_ms;  ///< duration of a measurement: part of its age
};

}  // namespace whisker::hal::stm32f405
