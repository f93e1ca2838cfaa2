#include "board.h"

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

whisker_board plant_board(plant *p) {
  whisker_board board = {0};
  board.user = p;
  board.ranges = ranges;
  board.counts = counts;
  board.speeds = speeds;
  return board;
}
