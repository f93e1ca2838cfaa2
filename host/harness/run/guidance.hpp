#pragma once

#include <cstdint>

namespace whisker {

/// Advice of the global planner at a tick.
enum class Guidance : std::uint8_t {
  unknown,  ///< unknown, or there is no global planner
  none,     ///< boundary following, or no advice
  goal,     ///< straight to the goal
  place,    ///< to a way point
  wait,     ///< stand: planning in progress
};
constexpr int kGuidances = 5;

/// As in the trace: "place"; "" for unknown.
constexpr const char* name(Guidance guidance) {
  switch (guidance) {
    case Guidance::unknown: return "";
    case Guidance::none: return "none";
    case Guidance::goal: return "goal";
    case Guidance::place: return "place";
    case Guidance::wait: return "wait";
  }
  return "?";
}

/// It leads, or is about to.
constexpr bool guides(Guidance guidance) { return guidance > Guidance::none; }

/// It has a way point.
constexpr bool has_place(Guidance guidance) {
  return guidance == Guidance::goal || guidance == Guidance::place;
}

}  // namespace whisker
