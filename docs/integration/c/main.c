/* A robot that is programmed in C. Here it drives in a simulation; your functions call your drivers instead.
 */
#include <stdio.h>

#include "firmware/c/whisker.h"
#include "plant.h"

static bool ranges(void *user, whisker_range readings[3]) {
  const plant *p = user;
  int beam;
  for (beam = 0; beam < 3; ++beam) {
    const echo e = plant_echo(p, beam);
    readings[beam].status = e.clear ? WHISKER_RANGE_CLEAR : WHISKER_RANGE_OK;
    readings[beam].mm = e.mm;
    readings[beam].age_ms = 0;
    readings[beam].sequence = e.sequence;
  }
  return true;
}

static bool counts(void *user, uint32_t *left, uint32_t *right) {
  *left = plant_count(user, 0);
  *right = plant_count(user, 1);
  return true;
}

static bool speeds(void *user, int16_t left, int16_t right) {
  plant_command(user, 0, left);
  plant_command(user, 1, right);
  return true;
}

/* FNV-1a over the wheel commands: two programs that give the same commands print the same hash. */
static uint64_t add(uint64_t hash, int16_t command) {
  hash = (hash ^ ((uint16_t)command & 0xFF)) * UINT64_C(0x100000001B3);
  return (hash ^ ((uint16_t)command >> 8)) * UINT64_C(0x100000001B3);
}

int main(void) {
  static const disc kDiscs[] = {{1.2, 0.1, 0.25}, {2.2, -0.35, 0.2}, {2.1, 0.6, 0.2}};
  static whisker_robot robot;
  plant p = {0};
  whisker_board board = {0};
  whisker_params params;
  whisker_status status;
  uint64_t hash = UINT64_C(0xCBF29CE484222325);
  uint32_t now;

  p.discs = kDiscs;
  p.count = 3;
  board.user = &p;
  board.ranges = ranges;
  board.counts = counts;
  board.speeds = speeds;

  whisker_default_params(&params);
  if (!whisker_set_param(&params, WHISKER_PARAM_BODY_RADIUS, 90000)) return 2;
  if (whisker_check_params(&params) != 0) {
    printf("%s\n", whisker_param_fault_name(whisker_check_params(&params)));
    return 2;
  }
  if (!whisker_create(&robot, &params, &board)) return 2;
  whisker_place(&robot, 0, 0, whisker_heading(0));
  whisker_set_goal(&robot, 3000000, 0, 50000);

  for (now = 0; now < 120000; now += 10) {
    whisker_tick(&robot, now, &status);
    hash = add(add(hash, status.left), status.right);
    if (status.fault != 0) {
      printf("%s\n", whisker_fault_name(status.fault));
      return 6;
    }
    if (status.outcome > WHISKER_OUTCOME_RUNNING) break;
    if (!plant_advance(&p)) return 5;
  }
  printf("%s after %.2f s at %.3f %.3f, commands %08x%08x\n", whisker_mode_name(status.mode), now / 1000.0,
         status.x_um * 1e-6, status.y_um * 1e-6, (unsigned)(hash >> 32), (unsigned)(hash & 0xFFFFFFFFU));
  return status.outcome == WHISKER_OUTCOME_REACHED ? 0 : 4;
}
