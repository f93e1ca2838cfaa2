/* A simulated robot among round obstacles: the reference robot of Whisker with ideal wheels and rangefinders.
 */
#ifndef PLANT_H
#define PLANT_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct disc {
  double x, y, radius; /* m */
} disc;

typedef struct plant {
  const disc *discs;
  int count;
  double x, y, heading; /* m, rad */
  double way[2];        /* of the wheels, m */
  double speed[2];      /* m/s */
  int ticks;
} plant;

/* The readings of a beam. */
typedef struct echo {
  bool clear;
  uint16_t mm;
  uint8_t sequence;
} echo;

/* Drives for 10 ms. False: the body touches an obstacle. */
bool plant_advance(plant *p);
/* Left 0, right 1; 0.1 mm/s. */
void plant_command(plant *p, int wheel, int16_t speed);
uint32_t plant_count(const plant *p, int wheel);
/* Left 0, front 1, right 2. New readings come every 20 ms. */
echo plant_echo(const plant *p, int beam);

#ifdef __cplusplus
}
#endif

#endif
