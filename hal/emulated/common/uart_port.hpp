#pragma once

#include "hal/byte_line.hpp"
#include "hal/console.hpp"

namespace whisker::hal::mcu {

/// A UART as line and console. It is polled: bytes that arrive between polls are lost, unless
/// the UART buffers them. `Uart`: a class with static bool can_read(), uint8_t get(), bool can_write(), void
/// put(uint8_t).
template <class Uart>
class UartPort final : public ByteLine, public Console {
 public:
  size_t take(uint8_t* to, size_t room) noexcept override {
    size_t count = 0;
    while (count < room && Uart::can_read()) to[count++] = Uart::get();
    return count;
  }
  size_t offer(const uint8_t* from, size_t count) noexcept override {
    size_t taken = 0;
    while (taken < count && Uart::can_write()) Uart::put(from[taken++]);
    return taken;
  }
  bool ready() noexcept override { return true; }
  void print(const char* text) noexcept override {
    for (; *text != '\0'; ++text) {
      while (!Uart::can_write()) {
      }
      Uart::put(static_cast<uint8_t>(*text));
    }
  }
};

}  // namespace whisker::hal::mcu
