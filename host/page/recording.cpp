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
      film_(params),
      map_watch_(params) {}

void Ticks::append(const Ticks& more, std::size_t index, std::size_t first) {
  const auto from = static_cast<std::ptrdiff_t>(index);
  records.insert(records.end(), more.records.begin() + from, more.records.end());
  health.insert(health.end(), more.health.begin() + from, more.health.end());
  frames.append(more.frames, first + index);
  map.append(more.map, first + index);
}

void Recording::add(const Moment& moment) {
  const TickRecord& r = moment.record;
  if (moment.patch != nullptr && count_ % ticks_a_frame_ == 0) {
    film_.add(count_, {fixed(r.est_x_m), fixed(r.est_y_m)}, *moment.patch, ticks_.frames);
  }
  if (map_watch_.look(moment.guide)) map_film_.add(count_, *map_watch_.last(), ticks_.map);
  ticks_.records.push_back(r);
  ticks_.health.push_back(moment.health);
  ++count_;
}

}  // namespace whisker::page
