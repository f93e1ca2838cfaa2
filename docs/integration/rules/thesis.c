/* Rules that steer a robot: D, distance ahead; R, distance on the right less that on the left; factors of
 * turn SA and step SD. */
#include "thesis.h"

#include "demo.h"

static void look_up(int16_t ahead, int16_t side, int16_t* answers) {
  const thesis_outputs out = thesis_look_up(ahead, side);
  answers[0] = out.raw_sa;
  answers[1] = out.raw_sd;
}

static const demo thesis = {{INPUT("D", THESIS_D), INPUT("R", THESIS_R)},
                            2,
                            {OUTPUT("SA", THESIS_SA), OUTPUT("SD", THESIS_SD)},
                            look_up};

int main(void) {
  demo_ask(&thesis, thesis_d_raw(9.0), thesis_r_raw(0.0));
  demo_ask(&thesis, thesis_d_raw(4.1), thesis_r_raw(5.3));
  demo_ask(&thesis, thesis_d_raw(4.1), thesis_r_raw(-5.3));
  /* Here the error is greatest: the compiler prints these places. */
  demo_ask(&thesis, thesis_d_raw(2.9375), thesis_r_raw(-0.125));
  demo_ask(&thesis, thesis_d_raw(8.921875), thesis_r_raw(-4.1171875));
  demo_measure(&thesis);
  return 0;
}
