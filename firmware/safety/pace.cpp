#include "firmware/safety/pace.hpp"

#include "firmware/fuzzy/rules.hpp"
#include "firmware/planning/ground_inputs.hpp"
#include "firmware/planning/steering.hpp"
#include "firmware/safety/warning.hpp"

namespace whisker::safety {
namespace {

constexpr int32_t kPartOfSight = 8;
constexpr int32_t kSlowerUp = 4;
constexpr int32_t kSlowerDown = 2;

}  // namespace

void Pace::configure(const Params& params) noexcept {
  const Length sight = params.body.radius * planning::kSight;
  const Speed stops = planning::stopping_speed(sight / kPartOfSight, warning_delay(params, false), params);
  const Speed top = min(params.wheels.max_speed, stops);
  base_ = Speed::from_raw(multiply_divide(top.raw(), Q14::kOne, fuzzy::step_terms::VB.raw()));
  middle_ = sight / 2;
}

Speed Pace::wanted(Q14 step, Length nearest) const noexcept {
  return min(base_ * step, Speed::from_raw(multiply_divide(base_.raw(), nearest.raw(), middle_.raw())));
}

Speed Pace::follow(Speed wanted, Speed floor, Duration elapsed, const Params& params) noexcept {
  const Speed change = params.wheels.max_acceleration * elapsed;
  if (wanted > now_) {
    now_ = min(wanted, max(now_, floor) + change / kSlowerUp);
  } else {
    now_ = wanted == Speed{} ? Speed{} : max(wanted, now_ - change / kSlowerDown);
  }
  return now_;
}

}  // namespace whisker::safety
