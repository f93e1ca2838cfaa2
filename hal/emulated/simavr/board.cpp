// An AVR in simavr; three general-purpose registers connect it to the host program host/emulators/avr.cpp.
#include "hal/board.hpp"
#include "hal/emulated/common/milliseconds.hpp"

namespace whisker::hal {
namespace {

/// Read: the next byte of standard input.
volatile uint8_t& input = *reinterpret_cast<volatile uint8_t*>(0x3E);  // GPIOR0
/// Write: a byte of standard output.
volatile uint8_t& output = *reinterpret_cast<volatile uint8_t*>(0x4A);  // GPIOR1
/// Write: a command; read: its answer, byte by byte.
volatile uint8_t& control = *reinterpret_cast<volatile uint8_t*>(0x4B);  // GPIOR2

enum Command : uint8_t {
  kEnded = 1,    ///< answers 1 once standard input has ended, else 0
  kCycles = 2,   ///< answers the cycles so far, 4 bytes, low byte first
  kStack = 3,    ///< answers the lowest stack pointer so far, 2 bytes
  kLeave = 128,  ///< kLeave + n: exits with status n
};

uint32_t answer(Command command, int bytes) noexcept {
  control = command;
  uint32_t value = 0;
  for (int i = 0; i < bytes; ++i) value |= static_cast<uint32_t>(control) << (8 * i);
  return value;
}

class HostStream final : public ByteStream, public Console {
 public:
  bool read(uint8_t* to, size_t count) noexcept override {
    for (; count != 0; --count) *to++ = input;
    return answer(kEnded, 1) == 0;
  }
  bool write(const uint8_t* from, size_t count) noexcept override {
    for (; count != 0; --count) output = *from++;
    return true;
  }
  void print(const char* text) noexcept override {
    while (*text != '\0') output = static_cast<uint8_t>(*text++);
  }
};

struct Cycles {
  static constexpr uint32_t kPerMillisecond = 16000;  // at the emulator's 16 MHz
  static uint32_t now() noexcept { return answer(kCycles, 4); }
};

class CycleMeter final : public Meter {
 public:
  uint32_t stamp() noexcept override { return Cycles::now(); }
  uint32_t between(uint32_t from, uint32_t to) noexcept override { return to - from; }
  uint32_t deepest_stack() noexcept override { return answer(kStack, 2); }
};

mcu::Milliseconds<Cycles> clock;
HostStream host;
CycleMeter meter;
const Board kBoard{clock, host, host, nullptr, host, meter};

}  // namespace

const Board& board() noexcept { return kBoard; }

void leave(int status) noexcept {
  control = static_cast<uint8_t>(kLeave | (status & 0x7F));
  for (;;) {
  }
}

}  // namespace whisker::hal

// main returns to the start-up of avr-libc, which calls this.
extern "C" [[noreturn]] void exit(int status) { whisker::hal::leave(status); }
