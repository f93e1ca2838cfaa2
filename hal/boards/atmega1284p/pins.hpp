/// The board's wiring.
///
/// | pin | what |
/// | PB0 (ICP1) | echoes of all three ultrasonic sensors, joined by diodes |
/// | PB1, PB2, PB3 | their triggers: left, front, right |
/// | PB4, PB5 | left motor's driver: forward, backward |
/// | PC3, PC4 | right motor's driver: forward, backward |
/// | PC0, PC1, PC2 | analogue infrared: left, front, right |
/// | PD2, PD3 | left wheel's encoder: A, B |
/// | PD4, PD7 | right wheel's encoder: A, B |
/// | PD6 (OC0A), PD5 (OC0B) | pulse widths: left, right |
#pragma once

#include <stdint.h>

#include "hal/boards/atmega1284p/registers.hpp"

namespace whisker::hal::atmega1284p::wiring {

inline constexpr uint8_t kEcho = bit(0);                         // port B
inline constexpr uint8_t kTrigger[] = {bit(1), bit(2), bit(3)};  // port B
inline constexpr uint8_t kLeftForward = bit(4);                  // port B
inline constexpr uint8_t kLeftBackward = bit(5);                 // port B
inline constexpr uint8_t kRightForward = bit(3);                 // port C
inline constexpr uint8_t kRightBackward = bit(4);                // port C
inline constexpr uint8_t kInfraredChannel[] = {0, 1, 2};         // port C
inline constexpr uint8_t kLeftA = bit(2);                        // port D
inline constexpr uint8_t kLeftB = bit(3);                        // port D
inline constexpr uint8_t kRightA = bit(4);                       // port D
inline constexpr uint8_t kRightB = bit(7);                       // port D
inline constexpr uint8_t kPulses = bit(6) | bit(5);              // port D

}  // namespace whisker::hal::atmega1284p::wiring
