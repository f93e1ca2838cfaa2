#include "hal/emulated/common/semihosting.hpp"

namespace whisker::hal::mcu {
namespace {

enum Operation : uintptr_t { kOpen = 0x01, kWrite = 0x05, kRead = 0x06, kExitExtended = 0x20 };
enum Mode : uintptr_t { kReadBinary = 1, kWriteBinary = 5 };
constexpr uintptr_t kFailed = UINTPTR_MAX;
constexpr uintptr_t kApplicationExit = 0x20026;

template <size_t kSize>
uintptr_t open(const char (&name)[kSize], Mode mode) noexcept {
  const uintptr_t argument[] = {reinterpret_cast<uintptr_t>(name), mode, kSize - 1};
  return semihost(kOpen, argument);
}

}  // namespace

bool SemihostStream::read(uint8_t* to, size_t count) noexcept {
  if (input_ == 0) input_ = open("/dev/stdin", kReadBinary);
  if (input_ == kFailed) return false;
  while (count != 0) {
    const uintptr_t argument[] = {input_, reinterpret_cast<uintptr_t>(to), count};
    const uintptr_t missing = semihost(kRead, argument);
    if (missing >= count) return false;  // end of input, or failure
    to += count - missing;
    count = missing;
  }
  return true;
}

bool SemihostStream::write(const uint8_t* from, size_t count) noexcept {
  if (output_ == 0) output_ = open("/dev/stdout", kWriteBinary);
  if (output_ == kFailed) return false;
  const uintptr_t argument[] = {output_, reinterpret_cast<uintptr_t>(from), count};
  return semihost(kWrite, argument) == 0;
}

void semihost_exit(int status) noexcept {
  const uintptr_t argument[] = {kApplicationExit, static_cast<uintptr_t>(status)};
  for (;;) semihost(kExitExtended, argument);
}

}  // namespace whisker::hal::mcu
