#pragma once

#include <stddef.h>
#include <stdint.h>

#include "hal/boards/common/shared.hpp"
#include "hal/boards/pico/usb_pipe.hpp"

namespace whisker::hal::pico {

/// The bytes between the host and the program. Only the functions that say so may run while the handler of
/// the USB interrupt may.
class UsbData {
 public:
  // Where the packets are in the shared memory.
  static constexpr uint16_t kNoticesRoom = 0x180, kInRoom = 0x1C0, kOutRoom = 0x200;

  UsbData() noexcept;

  /// The host has chosen the configuration.
  void begin() noexcept;
  /// It is gone, or has chosen none.
  void end() noexcept;
  /// Null: the device has no such endpoint.
  const UsbPipe* pipe(uint8_t address) const noexcept;
  /// A halted endpoint answers with STALL; the next packet of one that no longer is has DATA0. False: there
  /// is no such endpoint.
  bool halt(uint8_t address, bool halted) noexcept;
  /// A packet has passed.
  void on_sent() noexcept;
  void on_received() noexcept;

  /// Nothing is left to take, and nothing to send but the packet that the controller has.
  void discard() noexcept;
  /// Beside the handler. Returns the number of bytes that found room.
  size_t put(const uint8_t* from, size_t count) noexcept;
  /// Sends what waits.
  void go_on() noexcept;
  /// Beside the handler: bytes that have come.
  bool has_come() const noexcept { return left_ != 0; }
  size_t take(uint8_t* to, size_t room) noexcept;

 private:
  static constexpr uint16_t kDepth = 1024;
  void listen() noexcept;

  UsbPipe notices_, in_, out_;
  bool on_ = false;
  // To the host.
  mcu::Ring<uint8_t, kDepth> queue_;
  volatile bool busy_ = false;  // the controller has a packet
  uint8_t packet_ = 0;          // its bytes of the queue
  bool open_ended_ = false;     // the last packet was full, so the host expects another one
  // From the host.
  volatile uint8_t left_ = 0;  // bytes of its packet that are still to take
  uint8_t at_ = 0;
};

}  // namespace whisker::hal::pico
