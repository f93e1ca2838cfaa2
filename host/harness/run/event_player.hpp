#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "host/harness/scenario/event.hpp"

namespace whisker {

struct EventCount {
  std::uint64_t played = 0;
  std::uint64_t refused = 0;  ///< or without effect, see docs/scenario.md
};

/// Gives the events of a scenario in the order of time; at equal times, in the order of the file.
class EventPlayer {
 public:
  explicit EventPlayer(const std::vector<Event>& events);

  /// The next event that is due at this time; null: none.
  const Event* next(double now_s);
  /// An event of one of these kinds is to come until then.
  bool to_come(std::initializer_list<EventKind> kinds, double until_s) const;
  bool empty() const { return events_.empty(); }
  void count(bool played) { ++(played ? count_.played : count_.refused); }
  const EventCount& counted() const { return count_; }

 private:
  std::vector<Event> events_;
  std::size_t next_ = 0;
  EventCount count_;
};

}  // namespace whisker
