// Vector table and reset. Sections and symbols are those of hal/runtime/cortex_m/sections.ld.
#include "firmware/math/crc32.hpp"
#include "hal/board.hpp"
#include "hal/boards/pico/image.hpp"
#include "hal/boards/pico/interrupts.hpp"
#include "hal/boards/pico/motors.hpp"
#include "hal/runtime/sections.hpp"
#include "hal/runtime/stack.hpp"

int main();

extern "C" {

extern const uint8_t __image_end[];

[[noreturn]] void reset() noexcept;
void millisecond_interrupt() noexcept;
void usb_interrupt() noexcept;
void line_interrupt() noexcept;
void bus_interrupt() noexcept;
void edge_interrupt() noexcept;
}

namespace whisker::hal::pico {
namespace {

using Handler = void (*)();

struct Vectors {
  uint32_t* stack;
  Handler exception[15];
  Handler interrupt[kInterrupts];
  uint32_t unused[6];  // 32 interrupts have a place
  ImageHeader image;
};

/// No fault or other interrupt is expected. The pulses would go on without the processor, so the driver of
/// the motors sleeps first; then the watchdog, which is no longer fed, resets the chip.
[[noreturn]] void stand_still() noexcept {
  Motors::cut_off();
  for (;;) {
  }
}

constexpr Vectors vectors() noexcept {
  Vectors v{};
  v.stack = __stack_top;
  for (Handler& handler : v.exception) handler = stand_still;
  for (Handler& handler : v.interrupt) handler = stand_still;
  v.exception[0] = reset;
  v.interrupt[static_cast<int>(Interrupt::timer0)] = millisecond_interrupt;
  v.interrupt[static_cast<int>(Interrupt::usb)] = usb_interrupt;
  v.interrupt[static_cast<int>(Interrupt::io_bank0)] = edge_interrupt;
  v.interrupt[static_cast<int>(Interrupt::uart0)] = line_interrupt;
  v.interrupt[static_cast<int>(Interrupt::i2c0)] = bus_interrupt;
  v.image = {ImageHeader::kMagic, __image_end, UINT32_MAX};
  return v;
}

[[gnu::used, gnu::section(".vectors")]] constexpr Vectors kVectors = vectors();

constexpr uintptr_t kFlash = 0x10000000;

}  // namespace

bool image_is_intact() noexcept {
  const auto* const sum = reinterpret_cast<const volatile uint8_t*>(&kVectors.image.sum);
  const auto* const first = reinterpret_cast<const volatile uint8_t*>(kFlash);
  // The compiler knows the constant, but not what the flash has.
  const auto* const end = *reinterpret_cast<const volatile uint8_t* const volatile*>(&kVectors.image.end);
  if (*reinterpret_cast<const volatile uint32_t*>(&kVectors.image.magic) != ImageHeader::kMagic ||
      end != __image_end) {
    return false;
  }
  Crc32 found;
  for (const auto* at = first; at < end; ++at)
    found.add(at >= sum && at < sum + sizeof(uint32_t) ? UINT8_MAX : *at);
  return found.value() == *reinterpret_cast<const volatile uint32_t*>(&kVectors.image.sum);
}

}  // namespace whisker::hal::pico

void reset() noexcept {
  using namespace whisker::hal;
  mcu::begin_memory();
  mcu::paint_stack(static_cast<uint32_t*>(__builtin_frame_address(0)) - 8);
  main();
  pico::stand_still();
}

/// Until the watchdog resets the chip.
void whisker::hal::leave(int) noexcept { pico::stand_still(); }
