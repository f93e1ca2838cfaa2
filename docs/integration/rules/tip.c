/* A tip for a waiter: marks from 0 to 10 for service and food, and an answer in per cent. */
#include "tip.h"

#include "demo.h"

static void look_up(int16_t service, int16_t food, int16_t* answers) {
  answers[0] = tip_look_up(service, food).raw_tip;
}

static const demo tip = {
    {INPUT("service", TIP_SERVICE), INPUT("food", TIP_FOOD)}, 1, {OUTPUT("tip", TIP_TIP)}, look_up};

int main(void) {
  demo_ask(&tip, tip_service_raw(1.0), tip_food_raw(9.0));
  demo_ask(&tip, tip_service_raw(6.5), tip_food_raw(7.2));
  demo_ask(&tip, tip_service_raw(4.0), tip_food_raw(4.5));
  /* Here the error is greatest: the compiler prints this place. */
  demo_ask(&tip, tip_service_raw(4.9375), tip_food_raw(7.75));
  demo_measure(&tip);
  return 0;
}
