/// Pins by number.
#pragma once

#include "hal/boards/pico/io.hpp"
#include "hal/boards/pico/reg/bases.hpp"
#include "hal/boards/pico/reg/sio.hpp"
#include "hal/boards/pico/wiring.hpp"

namespace whisker::hal::pico {

using wiring::Gpio;

/// Number of a function: RP2040 data sheet, table 2.
enum class Function : uint8_t { uart = 2, i2c = 3, pwm = 4, sio = 5, pio0 = 6 };

enum class Pull : uint8_t { none, up, down };

/// The pad takes input; `pull` holds it while nothing else does.
void connect(Gpio pin, Function function, Pull pull) noexcept;
void make_output(Gpio pin, bool high) noexcept;

constexpr uint32_t bit(Gpio pin) noexcept { return UINT32_C(1) << pin; }
inline void write(Gpio pin, bool high) noexcept {
  store(base::kSio, high ? sio::kGpioOutSet : sio::kGpioOutClr, bit(pin));
}
/// Drives a pin, or leaves it to its pull.
inline void drive(Gpio pin, bool driven) noexcept {
  store(base::kSio, driven ? sio::kGpioOeSet : sio::kGpioOeClr, bit(pin));
}
inline bool read(Gpio pin) noexcept { return (load(base::kSio, sio::kGpioIn) & bit(pin)) != 0; }

/// Takes everything out of reset that the board uses. False: something stays in reset.
bool wake_peripherals() noexcept;
/// Configures every pin of `wiring`; motors off, rangefinders in reset.
void set_up_pins() noexcept;

}  // namespace whisker::hal::pico
