/* An inverted pendulum: angle of the rod in degrees, its rate in degrees a second; the force on the cart. */
#include "pendulum.h"

#include "demo.h"

static void look_up(int16_t angle, int16_t rate, int16_t* answers) {
  answers[0] = pendulum_look_up(angle, rate).raw_force;
}

static const demo pendulum = {{INPUT("angle", PENDULUM_ANGLE), INPUT("rate", PENDULUM_RATE)},
                              1,
                              {OUTPUT("force", PENDULUM_FORCE)},
                              look_up};

int main(void) {
  demo_ask(&pendulum, pendulum_angle_raw(0.0), pendulum_rate_raw(0.0));
  demo_ask(&pendulum, pendulum_angle_raw(4.0), pendulum_rate_raw(12.0));
  demo_ask(&pendulum, pendulum_angle_raw(-4.0), pendulum_rate_raw(-12.0));
  demo_ask(&pendulum, pendulum_angle_raw(12.0), pendulum_rate_raw(-45.0));
  /* Here the error is greatest: the compiler prints this place. */
  demo_ask(&pendulum, pendulum_angle_raw(9.6875), pendulum_rate_raw(59.0625));
  demo_measure(&pendulum);
  return 0;
}
