/* The core's rules: clear distance ahead D, and on the right less on the left R, in units of 100 mm; factors of turn and step. */
#include "thesis.h"

#include "demo.h"

static void look_up(int16_t ahead, int16_t side, int16_t* answers) {
  const thesis_outputs out = thesis_look_up(ahead, side);
  answers[0] = out.raw_sa;
  answers[1] = out.raw_sd;
}

static const demo thesis = {{INPUT("D", THESIS_D), INPUT("R", THESIS_R)}, 2, {OUTPUT("SA", THESIS_SA), OUTPUT("SD", THESIS_SD)}, look_up};

int main(void) {
  demo_ask(&thesis, thesis_d_raw(9.0), thesis_r_raw(0.0));
  demo_ask(&thesis, thesis_d_raw(4.0), thesis_r_raw(5.5));
  demo_ask(&thesis, thesis_d_raw(4.0), thesis_r_raw(-5.5));
  demo_ask(&thesis, thesis_d_raw(1.25), thesis_r_raw(-1.0));
  demo_measure(&thesis);
  return 0;
}
