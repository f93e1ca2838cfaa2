#include "host/harness/run/event_player.hpp"

#include <algorithm>

namespace whisker {
EventPlayer::EventPlayer(const std::vector<Event>& events) : events_(events) {
  std::stable_sort(events_.begin(), events_.end(),
                   [](const Event& a, const Event& b) { return a.t_s < b.t_s; });
}

const Event* EventPlayer::next(double now_s) {
  return next_ < events_.size() && events_[next_].t_s <= now_s ? &events_[next_++] : nullptr;
}

bool EventPlayer::to_come(std::initializer_list<EventKind> kinds, double until_s) const {
  return std::any_of(
      events_.begin() + static_cast<std::ptrdiff_t>(next_), events_.end(), [&](const Event& e) {
        return e.t_s <= until_s && std::find(kinds.begin(), kinds.end(), e.kind) != kinds.end();
      });
}

}  // namespace whisker
