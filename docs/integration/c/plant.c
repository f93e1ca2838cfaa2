#include "plant.h"

#include <math.h>

static const double kPi = 3.14159265358979323846;

bool plant_advance(plant *p) {
  const double left = p->speed[0] * 0.01, right = p->speed[1] * 0.01;
  const double turn = (right - left) / 0.14;
  int i;
  p->x += (left + right) / 2 * cos(p->heading + turn / 2);
  p->y += (left + right) / 2 * sin(p->heading + turn / 2);
  p->heading += turn;
  p->way[0] += left;
  p->way[1] += right;
  ++p->ticks;
  for (i = 0; i < p->count; ++i) {
    if (hypot(p->discs[i].x - p->x, p->discs[i].y - p->y) < p->discs[i].radius + 0.09) return false;
  }
  return true;
}

void plant_command(plant *p, int wheel, int16_t speed) { p->speed[wheel] = speed * 1e-4; }

uint32_t plant_count(const plant *p, int wheel) {
  return (uint32_t)((int64_t)floor(p->way[wheel] * 5000) & 0xFFFFFF);
}

/* The nearest point of a disc within the cone of a beam; 1000 if there is none. */
static double distance_to(const plant *p, const disc *d, double axis) {
  const double half = 12.5 * kPi / 180;
  const double x = d->x - p->x, y = d->y - p->y;
  const double away = hypot(x, y);
  const double off = fabs(remainder(atan2(y, x) - axis, 2 * kPi));
  if (off <= half) return away - d->radius;
  /* The edge of the cone may still meet the disc. */
  const double across = away * sin(off - half);
  if (off - half >= kPi / 2 || across >= d->radius) return 1000;
  return away * cos(off - half) - sqrt(d->radius * d->radius - across * across);
}

echo plant_echo(const plant *p, int beam) {
  const double axis = p->heading + (1 - beam) * 30 * kPi / 180;
  double nearest = 2.0;
  echo e;
  int i;
  for (i = 0; i < p->count; ++i) {
    const double distance = distance_to(p, &p->discs[i], axis);
    if (distance < nearest) nearest = distance;
  }
  e.clear = nearest >= 2.0;
  e.mm = (uint16_t)(nearest * 1000);
  e.sequence = (uint8_t)(p->ticks / 2 % 16);
  return e;
}
