/* A fan controller: degrees above the set point, their trend in degrees a minute; duty cycle in per cent. */
#include "fan.h"

#include "demo.h"

static void look_up(int16_t error, int16_t trend, int16_t* answers) {
  answers[0] = fan_look_up(error, trend).raw_duty;
}

static const demo fan = {
    {INPUT("error", FAN_ERROR), INPUT("trend", FAN_TREND)}, 1, {OUTPUT("duty", FAN_DUTY)}, look_up};

int main(void) {
  demo_ask(&fan, fan_error_raw(-2.0), fan_trend_raw(0.0));
  demo_ask(&fan, fan_error_raw(3.1), fan_trend_raw(0.0));
  demo_ask(&fan, fan_error_raw(3.1), fan_trend_raw(0.6));
  demo_ask(&fan, fan_error_raw(11.0), fan_trend_raw(-0.3));
  /* Here the error is greatest: the compiler prints this place. */
  demo_ask(&fan, fan_error_raw(3.875), fan_trend_raw(0.96875));
  demo_measure(&fan);
  return 0;
}
