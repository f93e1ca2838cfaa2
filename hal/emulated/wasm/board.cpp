// A WebAssembly module as a board. It imports three functions from the embedding page or program; it exports
// its memory, and `start` runs main.
#include "hal/board.hpp"

extern "C" {

[[clang::import_module("host"), clang::import_name("read")]] int32_t host_read(uint8_t* to, int32_t count);
[[clang::import_module("host"), clang::import_name("write")]] int32_t host_write(const uint8_t* from,
                                                                                 int32_t count);
[[clang::import_module("host"), clang::import_name("now_ms")]] uint32_t host_now_ms();
}

int main();

namespace whisker::hal {
namespace {

class HostStream final : public ByteStream, public Console {
 public:
  bool read(uint8_t* to, size_t count) noexcept override {
    return host_read(to, static_cast<int32_t>(count)) != 0;
  }
  bool write(const uint8_t* from, size_t count) noexcept override {
    return host_write(from, static_cast<int32_t>(count)) != 0;
  }
  void print(const char* text) noexcept override {
    int32_t length = 0;
    while (text[length] != '\0') ++length;
    host_write(reinterpret_cast<const uint8_t*>(text), length);
  }
};

class HostClock final : public Clock {
 public:
  uint32_t now_ms() noexcept override { return host_now_ms(); }
};

class NoMeter final : public Meter {
 public:
  uint32_t stamp() noexcept override { return 0; }
  uint32_t between(uint32_t, uint32_t) noexcept override { return 0; }
  uint32_t deepest_stack() noexcept override { return 0; }
};

HostClock clock;
HostStream host;
NoMeter meter;
const Board kBoard{clock, host, nullptr, host, meter};

}  // namespace

const Board& board() noexcept { return kBoard; }

void leave(int) noexcept { __builtin_trap(); }

}  // namespace whisker::hal

extern "C" [[clang::export_name("start")]] int32_t start() { return main(); }
