/// State diagrams as tables: the code that changes a phase and the pictures in the docs read the same rows.
#pragma once

#include <stddef.h>
#include <stdint.h>

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

/// The next phase, by rows of five bytes each: the members of a Transition. One function serves all machines.
uint8_t next_phase(const uint8_t* rows, size_t count, uint8_t phase, uint8_t event,
                   Decision& decision) noexcept;

/// Follows the arrow of `event` from `phase`. Where the table has none, tests stop and on a chip the phase
/// stays.
template <class Phase, class Event, size_t kRows>
void change(const Transition<Phase, Event> (&table)[kRows], Event event, Phase& phase,
            Decision& decision) noexcept {
  static_assert(sizeof(table[0]) == 5, "members of one byte each");
  phase = static_cast<Phase>(next_phase(reinterpret_cast<const uint8_t*>(table), kRows,
                                        static_cast<uint8_t>(phase), static_cast<uint8_t>(event), decision));
}

}  // namespace whisker::planning
