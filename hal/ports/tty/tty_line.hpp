#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

#include "hal/byte_line.hpp"

namespace whisker::hal::tty {

struct TtyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A serial device, a pseudo terminal, or a Unix socket with a listener, by its path. It may be missing:
/// ready() tries to open it again, also after it was lost.
class TtyLine final : public ByteLine {
 public:
  static constexpr int kBaud = 115200;

  /// baud: of a serial device, 8 data bits, no parity; standard rates from 9600 to 4000000. Throws TtyError
  /// for another rate, or if `path` is something else.
  explicit TtyLine(std::string path, int baud = kBaud);
  ~TtyLine();
  TtyLine(const TtyLine&) = delete;
  TtyLine& operator=(const TtyLine&) = delete;

  size_t take(uint8_t* to, size_t room) noexcept override;
  size_t offer(const uint8_t* from, size_t count) noexcept override;
  bool ready() noexcept override;

  /// For people: what is missing; empty while the other end is connected.
  std::string waits_for() const;
  /// Becomes readable when take() can continue after it returned 0; -1 while the other end is not connected.
  /// Changes in ready(), take() and offer() only.
  int descriptor() const noexcept { return file_; }

 private:
  using Clock = std::chrono::steady_clock;
  void open() noexcept;
  bool connect_to() noexcept;
  bool open_device() noexcept;
  void lose() noexcept;

  std::string path_;
  unsigned speed_;
  int file_ = -1;
  bool is_socket_ = false;
  bool just_lost_ = false;
  int error_ = 0;
  bool tried_ = false;
  Clock::time_point tried_at_;
  uint8_t came_[256] = {};
  size_t came_first_ = 0;
  size_t came_end_ = 0;
};

}  // namespace whisker::hal::tty
