#pragma once

#include <stdint.h>

#include "hal/boards/pico/io.hpp"
#include "hal/boards/pico/reg/bases.hpp"
#include "hal/boards/pico/reg/ppb.hpp"

namespace whisker::hal::pico {

/// Numbers of the interrupts that the board uses: RP2040 data sheet, 2.3.2. No handler interrupts another,
/// except that of the pins, whose edges are timed: it interrupts all others; and all interrupt that of the
/// USB, which can wait.
enum class Interrupt : uint8_t { timer0 = 0, usb = 5, io_bank0 = 13, uart0 = 20, i2c0 = 23 };
constexpr uint8_t kInterrupts = 26;

constexpr uint32_t priority_of(Interrupt interrupt) noexcept {
  if (interrupt == Interrupt::io_bank0) return 0;
  return interrupt == Interrupt::usb ? 2 : 1;
}

inline void enable(Interrupt interrupt) noexcept {
  const auto number = static_cast<uint8_t>(interrupt);
  const uint32_t bit = UINT32_C(1) << number;
  const Field priority{static_cast<uint16_t>(ppb::kNvicIpr0.offset + (number & ~3U)),
                       static_cast<uint8_t>(ppb::kIp0.lsb + 8 * (number & 3U)), ppb::kIp0.width};
  set(base::kPpb, priority, priority_of(interrupt));
  store(base::kPpb, ppb::kNvicIcpr, bit);
  store(base::kPpb, ppb::kNvicIser, bit);
}

/// No handler runs while this lives.
class Uninterrupted {
 public:
  Uninterrupted() noexcept { asm volatile("mrs %0, primask\n cpsid i" : "=r"(before_)::"memory"); }
  ~Uninterrupted() { asm volatile("msr primask, %0" ::"r"(before_) : "memory"); }
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

 private:
  uint32_t before_;
};

inline void wait_for_interrupt() noexcept { asm volatile("wfi" ::: "memory"); }

}  // namespace whisker::hal::pico
