// The second-stage bootloader: the boot ROM copies these 256 bytes into the RAM and calls them, if their sum
// is right (toolchain/uf2.py adds it). They make the flash of a Pico, a W25Q16JV, readable over four lines in
// 20 clocks a word, and start the program; called by the program, they return.
//
// Registers: RP2040 data sheet, 4.10.13. Commands: W25Q16JV data sheet, 8.1.2.

asm(R"(
  .syntax unified
  .cpu cortex-m0plus
  .thumb
  .section .boot2, "ax"
  .global boot2
  .thumb_func
boot2:
  push {lr}
  ldr r3, =0x18000000        // SSI
  movs r1, #0
  str r1, [r3, #0x08]        // off
  movs r1, #2
  str r1, [r3, #0x14]        // half of the core's clock
  movs r1, #1
  movs r2, #0xF0
  str r1, [r3, r2]           // sample one clock later
  ldr r1, =0x00070000        // frames of 8 bits, sent and received, on one line
  str r1, [r3, #0x00]
  movs r1, #1
  str r1, [r3, #0x08]

  movs r0, #0x35             // status register 2
  bl read_status
  movs r2, #2                // QE
  tst r0, r2
  bne four_lines
  movs r0, #0x06             // write enable
  str r0, [r3, #0x60]
  bl wait_ready
  ldr r0, [r3, #0x60]
  movs r0, #0x31             // write status register 2
  str r0, [r3, #0x60]
  str r2, [r3, #0x60]
  bl wait_ready
  ldr r0, [r3, #0x60]
  ldr r0, [r3, #0x60]
busy:
  movs r0, #0x05             // status register 1
  bl read_status
  movs r1, #1                // BUSY
  tst r0, r1
  bne busy

four_lines:
  movs r1, #0
  str r1, [r3, #0x08]
  ldr r1, =0x005F0300        // frames of 32 bits, read after command and address, on four lines
  str r1, [r3, #0x00]
  movs r1, #0
  str r1, [r3, #0x04]        // one frame
  ldr r1, =0x00002221        // command on one line, 32 bits of address and mode on four, 4 clocks of pause
  ldr r2, =0x180000F4
  str r1, [r2]
  movs r1, #1
  str r1, [r3, #0x08]
  movs r1, #0xEB             // fast read, quad
  str r1, [r3, #0x60]
  movs r1, #0xA0             // the next reads have no command
  str r1, [r3, #0x60]
  bl wait_ready
  ldr r1, [r3, #0x60]
  movs r1, #0
  str r1, [r3, #0x08]
  ldr r1, =0xA0002022        // no command, all on four lines
  str r1, [r2]
  movs r1, #1
  str r1, [r3, #0x08]

  pop {r0}
  cmp r0, #0                 // the boot ROM calls with 0
  beq start
  bx r0
start:
  ldr r0, =0x10000100        // vectors of the program
  ldr r1, =0xE000ED08        // VTOR
  str r0, [r1]
  ldmia r0!, {r1, r2}
  msr msp, r1
  bx r2

read_status:
  push {lr}
  str r0, [r3, #0x60]
  str r0, [r3, #0x60]
  bl wait_ready
  ldr r0, [r3, #0x60]
  ldr r0, [r3, #0x60]
  pop {pc}

wait_ready:
  ldr r1, [r3, #0x28]        // SR
  movs r0, #4                // all sent
  tst r1, r0
  beq wait_ready
  movs r0, #1                // still shifting
  tst r1, r0
  bne wait_ready
  bx lr
  .ltorg
)");
