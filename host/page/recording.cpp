#include "host/page/recording.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::page {
namespace {

constexpr std::int32_t kFrameMs = 50;

Length fixed(double metres) {
  return Length::from_raw(static_cast<std::int32_t>(std::llround(metres * 1e6)));
}

}  // namespace

Recording::Recording(const Params& params)
    : ticks_a_frame_(static_cast<std::size_t>(std::max(1, kFrameMs / params.safety.period.raw()))),
      film_(params) {}

void Recording::add(const Moment& moment) {
  const TickRecord& r = moment.record;
  if (moment.patch != nullptr && records_.size() % ticks_a_frame_ == 0) {
    film_.add(records_.size(), {fixed(r.est_x_m), fixed(r.est_y_m)}, *moment.patch);
  }
  records_.push_back(r);
  health_.push_back(moment.health);
}

}  // namespace whisker::page
