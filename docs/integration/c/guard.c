/* The guard alone, in C: whoever drives here asks for full speed ahead, whatever stands there. */
#include <stdio.h>

#include "board.h"

int main(void) {
  static const disc kDiscs[] = {{1.2, 0.0, 0.25}, {1.0, 0.6, 0.2}, {1.0, -0.6, 0.2}};
  static whisker_guard guard;
  plant p = {0};
  const whisker_board board = plant_board(&p);
  whisker_params params;
  whisker_guard_status status;
  uint32_t now;

  p.discs = kDiscs;
  p.count = 3;
  whisker_default_params(&params);
  /* Stop, do not go around: the guard alone only scales what is asked. */
  if (!whisker_set_param(&params, WHISKER_PARAM_GUARD_ASSIST, 0)) return 2;
  if (!whisker_guard_create(&guard, &params, &board)) return 2;
  whisker_guard_vouch(&guard, 350000);

  for (now = 0; now < 10000; now += 10) {
    whisker_guard_command(&guard, 300000, 0, now);
    whisker_guard_tick(&guard, now, &status);
    if (status.fault != 0) {
      printf("%s\n", whisker_fault_name(status.fault));
      return 6;
    }
    if (!plant_advance(&p)) return 5;
  }
  printf("%s: granted %d %%, wheels %d %d, %.3f m driven\n", whisker_guard_reason_name(status.reason),
         status.granted_forward * 100 / 16384, status.left, status.right, status.x_um * 1e-6);
  return status.reason == WHISKER_GUARD_OBSTACLE ? 0 : 4;
}
