#pragma once

#include <cstdint>

namespace whisker {

/// What the guide of a planner with a map says at a tick.
enum class Guidance : std::uint8_t {
  unknown,  ///< nobody knows, or there is no guide
  none,     ///< along edges, or it has nothing to say
  goal,     ///< straight at the goal
  place,    ///< to a place on the way
  wait,     ///< stand: the way is being thought over
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

/// It says where to go, or is about to.
constexpr bool guides(Guidance guidance) { return guidance > Guidance::none; }

/// It has a place to go to.
constexpr bool has_place(Guidance guidance) {
  return guidance == Guidance::goal || guidance == Guidance::place;
}

}  // namespace whisker
