#pragma once

#include <stdint.h>

#include "hal/boards/common/shared.hpp"
#include "hal/boards/pico/usb_control.hpp"
#include "hal/boards/pico/usb_data.hpp"
#include "hal/byte_line.hpp"

namespace whisker::hal::pico {

/// The chip's USB socket as a serial port of the host: a CDC-ACM device. It is open while a program on the
/// host has the port open, which the host says by the line state (DTR). No call waits: an interrupt moves the
/// packets. A host that does not read fills the queue, and then offer() takes nothing.
class UsbLine final : public ByteLine {
 public:
  /// Once the clock of the USB runs. id: another one for each robot.
  void start(const uint8_t (&id)[UsbControl::kIdBytes]) noexcept;

  size_t take(uint8_t* to, size_t room) noexcept override;
  size_t offer(const uint8_t* from, size_t count) noexcept override;
  bool ready() noexcept override;
  /// How often there was no room since the last call: the host does not read.
  uint8_t collect_refused() noexcept { return refused_.collect(); }

  /// Handler of the USB.
  void on_interrupt() noexcept;

 private:
  bool open() const noexcept { return control_.opened() && !suspended_; }

  UsbData data_;
  UsbControl control_{data_};
  mcu::Events refused_;
  volatile bool suspended_ = false;
  volatile bool parted_ = false;  // it was closed since ready() was called
};

}  // namespace whisker::hal::pico
