/// The operators that docs/guard.md measures.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "host/harness/scenario/scenario.hpp"
#include "host/lab/guard/operator.hpp"

namespace whisker::guard {

enum class Hand {
  perfect,   ///< follows the shortest path with a margin of 0.1 m
  sloppy,    ///< the same with a margin of 0.03 m, and a hand that errs by 6 cm
  blind,     ///< a smooth path from start to goal that ignores all obstacles
  joystick,  ///< full speed ahead, with turns at random
  hostile,   ///< random and malicious commands, rates and gaps
};
constexpr Hand kHands[] = {Hand::perfect, Hand::sloppy, Hand::blind, Hand::joystick, Hand::hostile};
const char* name(Hand hand);
std::optional<Hand> hand_named(std::string_view name);

/// It follows a path to the goal.
constexpr bool arrives(Hand hand) { return hand == Hand::perfect || hand == Hand::sloppy; }

/// Null if the scenario has no path with the margin that it needs.
std::unique_ptr<Operator> make_operator(Hand hand, const Scenario& scenario, std::uint64_t seed);

}  // namespace whisker::guard
