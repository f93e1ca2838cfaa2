// The compiler's helpers for a division, by the divider of the chip: RP2040 data sheet, 2.3.1.5. It has one
// dividend, so no handler runs between the dividend and the result. Names and registers: "Run-time ABI for
// the Arm Architecture", 4.3.1.
#include "hal/boards/pico/io.hpp"
#include "hal/boards/pico/reg/bases.hpp"
#include "hal/boards/pico/reg/sio.hpp"

using namespace whisker::hal::pico;

static_assert(base::kSio == 0xD0000000 && sio::kDivUdividend.offset == 0x60 &&
              sio::kDivUdivisor.offset == 0x64 && sio::kDivSdividend.offset == 0x68 &&
              sio::kDivSdivisor.offset == 0x6C && sio::kDivQuotient.offset == 0x70 &&
              sio::kDivRemainder.offset == 0x74);

asm(R"(
  .syntax unified
  .cpu cortex-m0plus
  .thumb
  .macro divide name, alias, dividend, divisor
  .section .text.\name, "ax"
  .global \name
  .global \alias
  .thumb_func
\name:
  .thumb_func
\alias:
  ldr r2, =0xD0000000
  mrs r3, primask
  cpsid i
  str r0, [r2, #\dividend]
  str r1, [r2, #\divisor]
  b 1f                       // 8 cycles
1:
  b 1f
1:
  b 1f
1:
  b 1f
1:
  ldr r1, [r2, #0x74]        // the quotient last: it ends the division
  ldr r0, [r2, #0x70]
  msr primask, r3
  bx lr
  .ltorg
  .endm
  divide __aeabi_uidiv, __aeabi_uidivmod, 0x60, 0x64
  divide __aeabi_idiv, __aeabi_idivmod, 0x68, 0x6C
)");
