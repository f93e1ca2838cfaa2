/// Open ground with one thing that moves near the robot's way.
#pragma once

#include <cstdint>

#include "host/scenario/scenario.hpp"

namespace whisker::worlds {

/// Where it comes from.
enum class Course {
  oncoming,    ///< from ahead, past the robot or into it
  crossing,    ///< from a side, timed so that both come near one place
  overtaking,  ///< from behind
};
constexpr Course kCourses[] = {Course::oncoming, Course::crossing, Course::overtaking};
const char* name(Course course);

/// 4 m straight to the goal in any direction, and one disc of radius 0.03 to 0.3 m at this speed, above 0 to
/// 10 m/s, whose way lies within 0.3 m of the robot's or crosses it. The same seed, below 2^63, gives the
/// same scenario on every machine, and at every speed the same disc and the same place to meet.
Scenario meeting(Course course, double speed_mps, std::uint64_t seed);

}  // namespace whisker::worlds
