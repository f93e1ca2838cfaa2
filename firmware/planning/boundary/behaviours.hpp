/// Shared by the boundary planner's state machines; only one of them drives at a time.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/boundary/progress_checker.hpp"
#include "firmware/planning/boundary/stuck_detector.hpp"
#include "firmware/planning/scan_behaviour.hpp"
#include "firmware/planning/steering.hpp"
#include "firmware/planning/transition.hpp"

namespace whisker::planning {

struct Behaviours {
  /// The parameters must outlive it.
  explicit Behaviours(const Params& p) noexcept : params(p) {}

  /// Once per tick while the body shall drive: whether the guard holds it back.
  bool stalled(const View& view) noexcept;
  /// Scales a length from the reference body, in millimetres.
  int32_t mm(Length reference) const noexcept;
  /// Drives towards this heading.
  Manoeuvre drive(const View& view, Angle heading) const noexcept;
  /// Call on entry into a phase: counts it as an attempt, and restarts the patience.
  void enter() noexcept {
    progress.pause();
    stuck.reset();
  }
  /// Follows a transition of a machine's table into its next phase.
  template <class Phase, class Event, size_t kRows>
  void change(const Transition<Phase, Event> (&table)[kRows], Event event, Phase& phase,
              Decision& decision) noexcept {
    enter();
    planning::change(table, event, phase, decision);
  }

  const Params& params;
  ProgressChecker progress;
  ScanBehaviour scan;
  StuckDetector stuck;
};

}  // namespace whisker::planning
