#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

#include "hal/byte_line.hpp"

namespace whisker::hal::tty {

struct TtyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A serial device, a pseudo terminal, or a Unix socket that somebody listens on, by its path. It need not be
/// there: ready() looks for it again and again, also after it was lost.
class TtyLine final : public ByteLine {
 public:
  static constexpr int kBaud = 115200;

  /// baud: of a serial device, 8 data bits, no parity; 9600 to 4000000, the usual ones only. Throws TtyError
  /// if it is none, or something else is at `path`.
  explicit TtyLine(std::string path, int baud = kBaud);
  ~TtyLine();
  TtyLine(const TtyLine&) = delete;
  TtyLine& operator=(const TtyLine&) = delete;

  size_t take(uint8_t* to, size_t room) noexcept override;
  size_t offer(const uint8_t* from, size_t count) noexcept override;
  bool ready() noexcept override;

  /// For a person: what is in the way; empty while there is another end.
  std::string waits_for() const;
  /// Becomes readable when more can be taken, once take() has returned 0; -1 while there is no other end.
  /// Changes only in ready(), take() and offer().
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
