// Runs an AVR image in simavr and connects this process's standard input and output to the three registers of
// hal/emulated/simavr/board.cpp. Exit status: the image's, 124 after too many cycles, 2 for usage.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <unistd.h>

extern "C" {
#include <simavr/avr_ioport.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_io.h>
}

namespace {

constexpr avr_io_addr_t kInput = 0x3E, kOutput = 0x4A, kControl = 0x4B;
constexpr avr_io_addr_t kStackLow = 0x5D, kStackHigh = 0x5E;
constexpr int kTimedOut = 124;
constexpr std::uint64_t kMostCycles = std::uint64_t{1} << 40;

enum Command : std::uint8_t { kEnded = 1, kCycles = 2, kStack = 3, kLeave = 128 };

struct Host {
  FILE* output = nullptr;
  bool ended = false;
  int status = -1;
  std::uint64_t answer = 0;
  std::uint16_t lowest_stack = UINT16_MAX;
};

std::uint8_t read_input(avr_t*, avr_io_addr_t, void* param) {
  Host& host = *static_cast<Host*>(param);
  std::fflush(host.output);
  const int c = std::getchar();
  host.ended = host.ended || c == EOF;
  return static_cast<std::uint8_t>(c);
}

void write_output(avr_t*, avr_io_addr_t, std::uint8_t value, void* param) {
  std::putc(value, static_cast<Host*>(param)->output);
}

void write_control(avr_t* avr, avr_io_addr_t, std::uint8_t value, void* param) {
  Host& host = *static_cast<Host*>(param);
  switch (value) {
    case kEnded: host.answer = host.ended ? 1 : 0; break;
    case kCycles: host.answer = avr->cycle; break;
    case kStack: host.answer = static_cast<std::uint64_t>(avr->ramend - host.lowest_stack); break;
    default:
      if (value >= kLeave) host.status = value - kLeave;
  }
}

std::uint8_t read_control(avr_t*, avr_io_addr_t, void* param) {
  Host& host = *static_cast<Host*>(param);
  const auto byte = static_cast<std::uint8_t>(host.answer);
  host.answer >>= 8;
  return byte;
}

/// The stack pointer changes one byte at a time; between the two writes it may point outside the used RAM.
void watch_stack(const avr_t& avr, Host& host) {
  const auto pointer = static_cast<std::uint16_t>(avr.data[kStackLow] | avr.data[kStackHigh] << 8);
  if (pointer < host.lowest_stack && pointer > avr.ramend / 2) host.lowest_stack = pointer;
}

/// simavr prints to standard output: it gets standard error instead.
FILE* take_standard_output() {
  const int own = dup(STDOUT_FILENO);
  return own >= 0 && dup2(STDERR_FILENO, STDOUT_FILENO) >= 0 ? fdopen(own, "wb") : nullptr;
}

int run(const char* image) {
  Host host;
  host.output = take_standard_output();
  if (host.output == nullptr) return 1;
  elf_firmware_t firmware{};
  if (elf_read_firmware(image, &firmware) != 0) {
    std::fprintf(stderr, "whisker_avr: %s: cannot be read\n", image);
    return 2;
  }
  const char* mcu = std::getenv("WHISKER_AVR_MCU");
  avr_t* avr = avr_make_mcu_by_name(mcu != nullptr ? mcu : "atmega1284p");
  if (avr == nullptr) return 2;
  avr_init(avr);
  avr->log = LOG_NONE;
  firmware.frequency = 16000000;
  avr_load_firmware(avr, &firmware);
  avr_register_io_read(avr, kInput, read_input, &host);
  avr_register_io_write(avr, kOutput, write_output, &host);
  avr_register_io_write(avr, kControl, write_control, &host);
  avr_register_io_read(avr, kControl, read_control, &host);
  while (host.status < 0) {
    const int state = avr_run(avr);
    watch_stack(*avr, host);
    if (state == cpu_Done || state == cpu_Crashed) host.status = 99;
    if (avr->cycle > kMostCycles) host.status = kTimedOut;
  }
  return std::fflush(host.output) == 0 ? host.status : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: whisker_avr IMAGE.elf\n", stderr);
    return 2;
  }
  return run(argv[1]);
}
