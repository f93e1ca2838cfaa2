#include "host/run/event_player.hpp"

#include <algorithm>

namespace whisker {
namespace {

bool gives_mission(const Event& e) { return e.kind == EventKind::goal || e.kind == EventKind::restart; }

}  // namespace

EventPlayer::EventPlayer(const std::vector<Event>& events) : events_(events) {
  std::stable_sort(events_.begin(), events_.end(),
                   [](const Event& a, const Event& b) { return a.t_s < b.t_s; });
}

const Event* EventPlayer::next(double now_s) {
  return next_ < events_.size() && events_[next_].t_s <= now_s ? &events_[next_++] : nullptr;
}

bool EventPlayer::mission_to_come(double until_s) const {
  return std::any_of(events_.begin() + static_cast<std::ptrdiff_t>(next_), events_.end(),
                     [&](const Event& e) { return gives_mission(e) && e.t_s <= until_s; });
}

}  // namespace whisker
