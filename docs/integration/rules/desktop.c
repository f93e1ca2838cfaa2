/* The demonstrations on a computer with an operating system. */
#include <stdio.h>

#include "port.h"

void port_print(const char* text) { fputs(text, stdout); }

uint32_t port_stamp(void) { return 0; }

uint32_t port_instructions(uint32_t from, uint32_t to) { return to - from; }
