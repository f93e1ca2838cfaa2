#include "demo.h"

#include "port.h"

static void print_number(uint32_t number, int least_digits, const char* after) {
  char text[12];
  char* at = text + sizeof text;
  *--at = '\0';
  do {
    *--at = (char)('0' + number % 10U);
    number /= 10U;
  } while (--least_digits > 0 || number != 0);
  port_print(at);
  port_print(after);
}

/* "tip 18.2500 (18688)": value in units, and the raw value. */
static void print_quantity(const quantity* q, int16_t raw) {
  const int64_t parts = q->origin + raw * q->scale;
  const uint32_t shown = (uint32_t)(((uint64_t)(parts < 0 ? -parts : parts) + 0x8000U) >> 16);
  port_print(q->name);
  port_print(parts < 0 && shown != 0 ? " -" : " ");
  print_number(shown / 10000U, 1, ".");
  print_number(shown % 10000U, 4, raw < 0 ? " (-" : " (");
  print_number((uint32_t)(raw < 0 ? -raw : raw), 1, ")");
}

void demo_ask(const demo* d, int16_t a, int16_t b) {
  int16_t answers[2];
  int i;
  d->look_up(a, b, answers);
  print_quantity(&d->inputs[0], a);
  port_print(", ");
  print_quantity(&d->inputs[1], b);
  for (i = 0; i < d->outputs; ++i) {
    port_print(i == 0 ? " -> " : ", ");
    print_quantity(&d->output[i], answers[i]);
  }
  port_print("\n");
}

static void idle(int16_t a, int16_t b, int16_t* answers) { (void)a, (void)b, (void)answers; }

static uint32_t cost(void (*volatile look_up)(int16_t, int16_t, int16_t*), int16_t a, int16_t b) {
  int16_t answers[2];
  const uint32_t from = port_stamp();
  look_up(a, b, answers);
  return port_instructions(from, port_stamp());
}

/* Over a grid that reaches beyond both ranges. */
static void measure_cost(const demo* d) {
  uint32_t least = UINT32_MAX;
  uint32_t most = 0;
  int32_t a;
  int32_t b;
  for (a = d->inputs[0].low - 37; a <= d->inputs[0].high + 37; a += 37) {
    for (b = d->inputs[1].low - 41; b <= d->inputs[1].high + 41; b += 41) {
      const uint32_t one = cost(d->look_up, (int16_t)a, (int16_t)b) - cost(idle, (int16_t)a, (int16_t)b);
      if (one < least) least = one;
      if (one > most) most = one;
    }
  }
  if (most == 0) return; /* not counted here */
  port_print("a look-up: ");
  if (least != most) print_number(least, 1, " to ");
  print_number(most, 1, " instructions\n");
}

void demo_measure(const demo* d) {
  uint32_t hash = 2166136261U; /* FNV-1a over the answers */
  uint32_t asked = 0;
  int32_t a;
  int32_t b;
  int i;
  measure_cost(d);
  for (a = d->inputs[0].low; a <= d->inputs[0].high; ++a) {
    for (b = d->inputs[1].low; b <= d->inputs[1].high; ++b, ++asked) {
      int16_t answers[2];
      d->look_up((int16_t)a, (int16_t)b, answers);
      for (i = 0; i < d->outputs; ++i) hash = (hash ^ (uint16_t)answers[i]) * 16777619U;
    }
  }
  print_number(asked, 1, " inputs, checksum ");
  print_number(hash, 1, "\n");
}
