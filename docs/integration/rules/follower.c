/* A follower: metres to the leader and its bearing in degrees; speed in m/s and turn in degrees a second. */
#include "follower.h"

#include "demo.h"

static void look_up(int16_t distance, int16_t bearing, int16_t* answers) {
  const follower_outputs out = follower_look_up(distance, bearing);
  answers[0] = out.raw_speed;
  answers[1] = out.raw_turn;
}

static const demo follower = {{INPUT("distance", FOLLOWER_DISTANCE), INPUT("bearing", FOLLOWER_BEARING)},
                              2,
                              {OUTPUT("speed", FOLLOWER_SPEED), OUTPUT("turn", FOLLOWER_TURN)},
                              look_up};

int main(void) {
  demo_ask(&follower, follower_distance_raw(0.4), follower_bearing_raw(0.0));
  demo_ask(&follower, follower_distance_raw(1.2), follower_bearing_raw(25.0));
  demo_ask(&follower, follower_distance_raw(1.8), follower_bearing_raw(-50.0));
  /* Here the error is greatest: the compiler prints these places. */
  demo_ask(&follower, follower_distance_raw(1.1234375), follower_bearing_raw(-60.0));
  demo_ask(&follower, follower_distance_raw(0.4765625), follower_bearing_raw(-59.8828125));
  demo_measure(&follower);
  return 0;
}
