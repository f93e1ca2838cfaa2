/* A robot that is programmed in C. Here it drives in a simulation; your functions call your drivers
 * instead of those in board.c. */
#include <stdio.h>

#include "board.h"
#include "firmware/c/whisker.h"

/* FNV-1a over the wheel commands: two programs that give the same commands print the same hash. */
static uint64_t add(uint64_t hash, int16_t command) {
  hash = (hash ^ ((uint16_t)command & 0xFF)) * UINT64_C(0x100000001B3);
  return (hash ^ ((uint16_t)command >> 8)) * UINT64_C(0x100000001B3);
}

int main(void) {
  static const disc kDiscs[] = {{1.2, 0.1, 0.25}, {2.2, -0.35, 0.2}, {2.1, 0.6, 0.2}};
  static whisker_robot robot;
  plant p = {0};
  const whisker_board board = plant_board(&p);
  whisker_params params;
  whisker_status status;
  uint64_t hash = UINT64_C(0xCBF29CE484222325);
  uint32_t now;

  p.discs = kDiscs;
  p.count = 3;

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
