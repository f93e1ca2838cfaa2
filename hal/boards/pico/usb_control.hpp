#pragma once

#include <stdint.h>

#include "hal/boards/pico/usb_data.hpp"

namespace whisker::hal::pico {

/// Endpoint 0: the requests of USB 2.0, 9.4, and of a serial line. Any other one gets a STALL. For the
/// handler of the USB interrupt.
class UsbControl {
 public:
  static constexpr uint8_t kIdBytes = 8;

  explicit UsbControl(UsbData& data) noexcept;

  /// id: another one for each robot.
  void set_id(const uint8_t (&id)[kIdBytes]) noexcept;
  void on_bus_reset() noexcept;
  void on_setup() noexcept;
  void on_sent() noexcept;
  void on_received() noexcept;
  /// Beside the handler: a program on the host has opened the port.
  bool opened() const noexcept { return configuration_ != 0 && terminal_ready_; }

 private:
  enum class Stage : uint8_t { idle, data_in, data_out, status_in, status_out };
  /// What a request gets.
  enum class Answer : uint8_t { stall, done, data, wants_data };
  struct Setup {
    uint16_t what;  ///< bmRequestType and bRequest
    uint16_t value, index, length;
  };

  Answer answer(const Setup& setup) noexcept;
  Answer answer_interface(const Setup& setup) noexcept;
  Answer answer_endpoint(const Setup& setup) noexcept;
  Answer describe(const Setup& setup) noexcept;
  Answer say(const uint8_t* data, uint8_t size) noexcept;
  Answer say_word(uint8_t first, uint8_t size) noexcept;
  Answer say_text(const char* text, uint8_t size) noexcept;
  void send_data() noexcept;
  void finish() noexcept;
  void stall() noexcept;

  static constexpr uint8_t kCodingBytes = 7;

  UsbData& data_;
  UsbPipe in_, out_;
  Stage stage_ = Stage::idle;
  const uint8_t* next_ = nullptr;
  uint8_t left_ = 0;
  bool short_ends_ = false;  // the host expects more bytes than there are
  uint8_t address_ = 0;      // that holds when the request has ended
  volatile uint8_t configuration_ = 0;
  volatile bool terminal_ready_ = false;
  /// 921,600 baud, 8 data bits: only kept for who asks.
  uint8_t coding_[kCodingBytes] = {0x00, 0x10, 0x0E, 0x00, 0, 0, 8};
  char id_[2 * kIdBytes] = {};
  uint8_t said_[UsbPipe::kPacket] = {};
};

}  // namespace whisker::hal::pico
