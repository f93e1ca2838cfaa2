#include "firmware/calibration/values.hpp"

namespace whisker::calibration {
namespace {

void set(Params& params, Quantity quantity, int32_t value) noexcept {
  switch (quantity) {
    case Quantity::gyro_scale: params.gyro.scale = Ratio::from_raw(value); break;
    case Quantity::wheel_ratio: params.wheels.ratio = Ratio::from_raw(value); break;
    case Quantity::counts_per_metre: params.wheels.counts_per_metre = value; break;
    case Quantity::track: params.body.track = Length::from_raw(value); break;
  }
}

}  // namespace

int32_t value_in(const Params& params, Quantity quantity) noexcept {
  switch (quantity) {
    case Quantity::gyro_scale: return params.gyro.scale.raw();
    case Quantity::wheel_ratio: return params.wheels.ratio.raw();
    case Quantity::counts_per_metre: return params.wheels.counts_per_metre;
    case Quantity::track: return params.body.track.raw();
  }
  return 0;
}

int32_t corrected(int32_t value, Ratio correction) noexcept {
  return saturate32(value + divide_rounded(int64_t{value} * correction.raw(), 1000000));
}

void rescale(Values& values, const Params& params, Measured counts_per_metre) noexcept {
  const Measured before = values[Quantity::counts_per_metre];
  const int32_t counts = before.known() ? before.value : params.wheels.counts_per_metre;
  Measured& track = values[Quantity::track];
  const int32_t length = track.known() ? track.value : params.body.track.raw();
  if (!track.known()) track.sigma = counts_per_metre.sigma;
  track.value = multiply_divide(length, counts, counts_per_metre.value);
  values[Quantity::counts_per_metre] = counts_per_metre;
}

ParamFault apply(const Values& values, Params& params) noexcept {
  Params changed = params;
  for (int i = 0; i < kQuantities; ++i) {
    if (values.of[i].known()) set(changed, static_cast<Quantity>(i), values.of[i].value);
  }
  const ParamFault fault = check(changed);
  if (fault == ParamFault::none) params = changed;
  return fault;
}

}  // namespace whisker::calibration
