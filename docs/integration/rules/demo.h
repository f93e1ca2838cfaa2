/* Asks the look-up of a compiled rule base, and prints its answers. */
#ifndef DEMO_H
#define DEMO_H

#include <stdint.h>

/* How raw values of an input or output become units. The constants are computed at compile time, so printing
   needs no floating point. */
typedef struct {
  const char* name;
  int16_t low, high; /* raw; inputs only */
  int64_t origin;    /* 10^-4 units, 2^-16 of them */
  int64_t scale;     /* the same, per raw unit */
} quantity;

#define PARTS 655360000.0
#define QUANTITY(name, NAME, low, high) \
  { name, low, high, (int64_t)(NAME##_ORIGIN * PARTS), (int64_t)(PARTS / NAME##_PER_UNIT) }
#define INPUT(name, NAME) QUANTITY(name, NAME, NAME##_LOW, NAME##_HIGH)
#define OUTPUT(name, NAME) QUANTITY(name, NAME, 0, 0)

typedef struct {
  quantity inputs[2];
  int outputs;
  quantity output[2];
  void (*look_up)(int16_t a, int16_t b, int16_t* answers);
} demo;

/* Prints the answers at these raw inputs. */
void demo_ask(const demo* d, int16_t a, int16_t b);

/* Prints the instructions of a look-up, and a checksum of the answers to all raw inputs. */
void demo_measure(const demo* d);

#endif
