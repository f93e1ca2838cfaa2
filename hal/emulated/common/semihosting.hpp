/// Services of the emulator or a debug probe: ARM semihosting, also on RISC-V. Source: "Semihosting for
/// AArch32 and AArch64", Arm, and the RISC-V semihosting specification.
#pragma once

#include "hal/byte_stream.hpp"

namespace whisker::hal::mcu {

/// One semihosting call. Without a debugger, it does not return.
uintptr_t semihost(uintptr_t operation, const void* argument) noexcept;

/// Standard input and output of the emulator process.
class SemihostStream final : public ByteStream {
 public:
  bool read(uint8_t* to, size_t count) noexcept override;
  bool write(const uint8_t* from, size_t count) noexcept override;

 private:
  uintptr_t input_ = 0;  // handles; 0: not open yet
  uintptr_t output_ = 0;
};

[[noreturn]] void semihost_exit(int status) noexcept;

}  // namespace whisker::hal::mcu
