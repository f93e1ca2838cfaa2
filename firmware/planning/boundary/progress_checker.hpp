/// Ends a mission that makes no progress.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class ProgressChecker {
 public:
  /// A new goal is set.
  void start(const View& view) noexcept;
  /// Once per tick.
  void move(const View& view, const Params& params) noexcept;
  /// Call on entry into a phase that may fail.
  void pause() noexcept { ++pauses_; }

  /// Many phases without having left a place of 30 mm. With coarse encoders, turns on the spot are travel.
  bool rests() const noexcept;

  /// Travel since the goal was set.
  int32_t travel_mm() const noexcept { return travel_mm_; }
  /// Reason to end the mission: Why::length_budget beyond `budget`, Why::no_exit after 1,000 phases in
  /// one place, otherwise Why::none.
  Why exhausted(Length budget) const noexcept;

 private:
  uint32_t started_um_ = 0;  // View::travelled_um at the start
  int32_t travel_mm_ = 0;
  Vec place_;           // where the body was at the last progress
  int16_t pauses_ = 0;  // phases since then
};

}  // namespace whisker::planning
