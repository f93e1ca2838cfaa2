#pragma once

#include <algorithm>
#include <deque>
#include <string>

#include "hal/byte_line.hpp"

namespace whisker::hal::slcan {

/// One end of a line; the test holds the other end.
class Pipe final : public ByteLine {
 public:
  size_t take(uint8_t* to, size_t room) noexcept override {
    size_t count = 0;
    for (; count < room && !in.empty(); ++count) {
      to[count] = static_cast<uint8_t>(in.front());
      in.pop_front();
    }
    return count;
  }
  size_t offer(const uint8_t* from, size_t count) noexcept override {
    count = std::min(count, space);
    space -= count;
    out.insert(out.end(), from, from + count);
    return count;
  }
  bool ready() noexcept override { return up; }

  void come(const std::string& bytes) { in.insert(in.end(), bytes.begin(), bytes.end()); }
  /// Bytes sent since the last call.
  std::string sent() {
    std::string text(out.begin(), out.end());
    out.clear();
    return text;
  }

  std::deque<char> in;
  std::deque<char> out;
  size_t space = SIZE_MAX;  ///< room for this many more bytes
  bool up = true;
};

/// Passes the bytes that each has sent to the other.
inline void exchange(Pipe& a, Pipe& b) {
  b.come(a.sent());
  a.come(b.sent());
}

}  // namespace whisker::hal::slcan
