// A process on this computer as a board, for the same programs that run on chips.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "hal/board.hpp"

namespace whisker::hal {
namespace {

class ProcessClock final : public Clock {
 public:
  uint32_t now_ms() noexcept override {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return static_cast<uint32_t>(t.tv_sec) * 1000U + static_cast<uint32_t>(t.tv_nsec / 1000000);
  }
};

class StandardStream final : public ByteStream {
 public:
  bool read(uint8_t* to, size_t count) noexcept override { return std::fread(to, 1, count, stdin) == count; }
  bool write(const uint8_t* from, size_t count) noexcept override {
    return std::fwrite(from, 1, count, stdout) == count && std::fflush(stdout) == 0;
  }
};

class StandardError final : public Console {
 public:
  void print(const char* text) noexcept override { std::fputs(text, stderr); }
};

class NoMeter final : public Meter {
 public:
  uint32_t stamp() noexcept override { return 0; }
  uint32_t between(uint32_t, uint32_t) noexcept override { return 0; }
  uint32_t deepest_stack() noexcept override { return 0; }
};

}  // namespace

const Board& board() noexcept {
  static ProcessClock clock;
  static StandardStream stream;
  static StandardError console;
  static NoMeter meter;
  static const Board board{clock, console, nullptr, stream, meter};
  return board;
}

void leave(int status) noexcept { std::exit(status); }

}  // namespace whisker::hal
