#pragma once

#include <stdint.h>

namespace whisker::hal::pico {

/// I2C0 as the only master, 400 kHz: one transfer at a time, of which only the end is an interrupt, because
/// all of its bytes fit into the queues of the chip.
class I2c {
 public:
  static constexpr uint8_t kLongest = 14;  ///< bytes of a transfer, in both directions

  struct Transfer {
    uint8_t address;  ///< 7 bits
    uint8_t out[2];
    uint8_t out_size;  ///< 1 or 2: a register, or a register and its value
    uint8_t in_size;   ///< read afterwards; 0: nothing
  };
  enum class End : uint8_t {
    none,       ///< not yet
    done,       ///< in() has what was read
    no_answer,  ///< from the address, or a byte was refused
    lost,       ///< another one held the lines: call recover()
  };

  void start() noexcept;
  /// Only if the last transfer has ended.
  void begin(const Transfer& transfer) noexcept;
  /// In the handler of the interrupt.
  End on_interrupt() noexcept;
  /// After a transfer that does not end: gives the lines nine clocks, after which every device lets go of
  /// them, and begins anew. Takes 0.2 ms.
  void recover() noexcept;
  const uint8_t (&in() const noexcept)[kLongest] { return in_; }

 private:
  void configure() noexcept;

  uint8_t in_[kLongest] = {};
  uint8_t in_size_ = 0;
  bool refused_ = false;
};

}  // namespace whisker::hal::pico
