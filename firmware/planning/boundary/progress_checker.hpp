/// Whether the body still gets on: it ends a mission that only costs time.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class ProgressChecker {
 public:
  /// A new goal is set.
  void start(const View& view) noexcept;
  /// Once a tick.
  void move(const View& view, const Params& params) noexcept;
  /// A phase is entered that may lead nowhere.
  void pause() noexcept { ++pauses_; }

  /// Driven since the goal was set.
  int32_t travel_mm() const noexcept { return travel_mm_; }
  /// Why the mission ends: Why::length_budget beyond `budget`, Why::no_exit after 1,000 phases without 30 mm
  /// of travel, Why::none while neither is so.
  Why exhausted(Length budget) const noexcept;

 private:
  uint32_t started_um_ = 0;  // View::travelled_um then
  int32_t travel_mm_ = 0;
  int32_t paused_mm_ = 0;  // travel at which the body last got on
  int16_t pauses_ = 0;     // since then
};

}  // namespace whisker::planning
