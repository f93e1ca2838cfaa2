/// Open ground with one moving object near the robot's path.
#pragma once

#include <cstdint>

#include "host/harness/scenario/scenario.hpp"

namespace whisker::worlds {

/// Direction of approach.
enum class Course {
  oncoming,    ///< from ahead, past the robot or into it
  crossing,    ///< from a side, timed so that both come near one point
  overtaking,  ///< from behind
};
constexpr Course kCourses[] = {Course::oncoming, Course::crossing, Course::overtaking};
const char* name(Course course);

/// 4 m straight to the goal in any direction, and one disc of radius 0.03 to 0.3 m at this speed, above 0 to
/// 10 m/s, whose path lies within 0.3 m of the robot's or crosses it. All this is for the reference body: a
/// larger radius widens the distances by the difference, and a slower robot, which crosses later, has more
/// time. The same seed, below 2^63, gives the same scenario on every machine, and the same disc and meeting
/// point at every speed.
Scenario meeting(Course course, double speed_mps, std::uint64_t seed, const Params& robot = {});

}  // namespace whisker::worlds
