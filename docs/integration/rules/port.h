/* What the demonstrations need of their computer: chip.c is an emulated Cortex-M0+, desktop.c any other. */
#ifndef PORT_H
#define PORT_H

#include <stdint.h>

void port_print(const char* text);

/* Stamps, and the instructions between two of them; 0 where none are counted. */
uint32_t port_stamp(void);
uint32_t port_instructions(uint32_t from, uint32_t to);

#endif
