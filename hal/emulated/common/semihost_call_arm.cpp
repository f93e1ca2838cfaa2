#include "hal/emulated/common/semihosting.hpp"

namespace whisker::hal::mcu {

uintptr_t semihost(uintptr_t operation, const void* argument) noexcept {
  register uintptr_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

}  // namespace whisker::hal::mcu
