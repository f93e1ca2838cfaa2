/* The demonstrations on QEMU's BBC micro:bit. Its Cortex-M0 runs the same instructions as a Cortex-M0+. */
#include "port.h"

int main(void);
extern char stack_top[];

/* Semihosting, a service of QEMU and of debug probes. Source: "Semihosting for AArch32 and AArch64", Arm. */
static void semihost(uintptr_t operation, const void* argument) {
  register uintptr_t r0 __asm__("r0") = operation;
  register const void* r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

static void leave(uintptr_t status) {
  const uintptr_t argument[2] = {0x20026, status}; /* the application ends */
  for (;;) semihost(0x20, argument);
}

void port_print(const char* text) { semihost(0x04, text); }

/* TIMER0 of the nRF51 counts at 16 MHz. With QEMU's option `-icount shift=10`, an instruction takes 1024
 * ns: 16.384 counts. */
#define TIMER(offset) (*(volatile uint32_t*)(0x40008000U + (offset)))

uint32_t port_stamp(void) {
  TIMER(0x040) = 1; /* capture */
  return TIMER(0x540);
}

uint32_t port_instructions(uint32_t from, uint32_t to) {
  return (uint32_t)(((uint64_t)(to - from) * 1000 + 8192) / 16384);
}

static void reset(void) {
  TIMER(0x508) = 3; /* 32 bits */
  TIMER(0x510) = 0; /* no prescaler */
  TIMER(0x000) = 1; /* start */
  leave((uintptr_t)main());
}

static void fault(void) { leave(99); }

/* Stack, reset, non-maskable interrupt and hard fault: no other exception is possible here. */
__attribute__((used, section(".vectors"))) static const struct {
  char* stack;
  void (*handlers[3])(void);
} vectors = {stack_top, {reset, fault, fault}};
