/// State diagrams as tables: the code that changes a phase and the pictures in the docs read the same rows.
#pragma once

#include <stddef.h>

#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// An arrow: after `on` in phase `from`, the machine is in phase `to`, and the decision tells mode and
/// reason.
template <class Phase, class Event>
struct Transition {
  Phase from;
  Event on;
  Phase to;
  Mode mode = Mode::idle;  ///< idle: as before
  Why why = Why::none;     ///< none: as before
};

/// Follows the arrow of `event` from `phase`. Where the table has none, the phase stays.
template <class Phase, class Event, size_t kRows>
void change(const Transition<Phase, Event> (&table)[kRows], Event event, Phase& phase,
            Decision& decision) noexcept {
  for (const Transition<Phase, Event>& row : table) {
    if (row.from != phase || row.on != event) continue;
    phase = row.to;
    if (row.mode != Mode::idle) decision.mode = row.mode;
    if (row.why != Why::none) decision.why = row.why;
    return;
  }
}

}  // namespace whisker::planning
