#include "host/harness/run/run_log.hpp"

#include <algorithm>
#include <cmath>

namespace whisker {
namespace {

struct Pace {
  std::int32_t sample_ms, frame_ms;
};
constexpr Pace kFull{0, 50};
constexpr Pace kCoarse{200, 1000};

std::size_t one_in(std::int32_t wanted, std::int32_t step) {
  return static_cast<std::size_t>(std::max(1, wanted / std::max(1, step)));
}

Length fixed(double metres) {
  return Length::from_raw(static_cast<std::int32_t>(std::llround(metres * 1e6)));
}

}  // namespace

RunLog::RunLog(RunSetting setting, Detail detail)
    : setting_(std::move(setting)),
      detail_(detail),
      film_(setting_.scenario.robot),
      map_watch_(setting_.scenario.robot) {
  const Pace pace = detail == Detail::full ? kFull : kCoarse;
  const std::int32_t period = setting_.scenario.robot.safety.period.raw();
  every_ = one_in(pace.sample_ms, period);
  kept_a_frame_ = one_in(pace.frame_ms, period * static_cast<std::int32_t>(every_));
}

void Ticks::append(const Ticks& more, std::size_t index, std::size_t first) {
  const auto from = static_cast<std::ptrdiff_t>(index);
  records.insert(records.end(), more.records.begin() + from, more.records.end());
  health.insert(health.end(), more.health.begin() + from, more.health.end());
  frames.append(more.frames, first + index);
  map.append(more.map, first + index);
}

void RunLog::watch(RunOptions& options) {
  options.watch = [this, also = options.watch](const Moment& moment) {
    add(moment);
    if (also) also(moment);
  };
}

void RunLog::add(const Moment& moment) {
  const TickRecord& r = moment.record;
  const bool kept = count_++ % every_ == 0;
  if (moment.local_grid != nullptr && kept && kept_ % kept_a_frame_ == 0) {
    film_.add(kept_, {fixed(r.est_x_m), fixed(r.est_y_m)}, *moment.local_grid, ticks_.frames);
  }
  if (map_watch_.look(moment.guide)) note(*map_watch_.last());
  if (kept) {
    keep(r, moment.health);
  } else {
    last_ = {r, moment.health};
  }
}

void RunLog::note(const MapPicture& map) {
  map_ = map;
  map_film_.add(kept_, map, ticks_.map);
}

void RunLog::end(RunResult result) {
  if (last_) keep(last_->first, last_->second);
  result_ = std::move(result);
}

void RunLog::keep(const TickRecord& record, const Health& health) {
  ticks_.records.push_back(record);
  ticks_.health.push_back(health);
  last_.reset();
  ++kept_;
}

}  // namespace whisker
