#pragma once

#include <stdint.h>

#include "hal/boards/pico/io.hpp"

namespace whisker::hal::pico {

/// A direction of an endpoint, with room for one packet in the memory that the controller shares with the
/// program. The controller has the room from arm() until the packet has passed.
class UsbPipe {
 public:
  static constexpr uint8_t kPacket = 64;
  /// As the host sees it.
  enum class Way : uint8_t { in, out };

  /// control: of the buffer; room: its offset in the shared memory.
  constexpr UsbPipe(Way way, Register control, uint16_t room) noexcept
      : control_(control), room_(room), way_(way) {}

  /// Takes the room back. The next packet is DATA1, or DATA0.
  void reset(bool data1) noexcept;
  /// in: the host gets `size` bytes of the room; out: the room takes a packet of the host.
  void arm(uint8_t size) noexcept;
  void arm() noexcept { arm(kPacket); }
  /// The host gets a STALL until reset().
  void halt() noexcept;
  bool halted() const noexcept { return halted_; }

  /// Bytes of the packet that has come.
  uint8_t size() const noexcept;
  void put(uint8_t at, uint8_t byte) noexcept { room()[at] = byte; }
  uint8_t get(uint8_t at) const noexcept { return room()[at]; }

 private:
  volatile uint8_t* room() const noexcept;

  Register control_;
  uint16_t room_;
  Way way_;
  bool data1_ = false;
  bool halted_ = false;
};

}  // namespace whisker::hal::pico
