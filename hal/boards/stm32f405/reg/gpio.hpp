/// Pins.
#pragma once

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::gpio {  // GPIOA GPIOB GPIOC

inline constexpr PinField kModer{0x00, 2, 0};    ///< MODER.MODER0..MODER15
inline constexpr PinField kOtyper{0x04, 1, 0};   ///< OTYPER.OT0..OT15
inline constexpr PinField kOspeedr{0x08, 2, 0};  ///< OSPEEDR.OSPEEDR0..OSPEEDR15
inline constexpr PinField kPupdr{0x0C, 2, 0};    ///< PUPDR.PUPDR0..PUPDR15
inline constexpr PinField kIdr{0x10, 1, 0};      ///< IDR.IDR0..IDR15
inline constexpr Register kBsrr{0x18};           ///< BSRR
inline constexpr PinField kBs{0x18, 1, 0};       ///< BSRR.BS0..BS15
inline constexpr PinField kAfrl{0x20, 4, 0};     ///< AFRL.AFRL0..AFRL7
inline constexpr PinField kAfrh{0x24, 4, 8};     ///< AFRH.AFRH8..AFRH15

}  // namespace whisker::hal::stm32f405::gpio
