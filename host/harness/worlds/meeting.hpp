/// Open ground with one moving object near the robot's path.
#pragma once

#include <cstdint>
#include <functional>

#include "host/harness/scenario/scenario.hpp"

namespace whisker::worlds {

/// Direction of approach.
enum class Course {
  oncoming,    ///< from ahead, past the robot or into it
  crossing,    ///< from a side, timed so that both come near one point, whatever the robot's pace
  overtaking,  ///< from behind
};
constexpr Course kCourses[] = {Course::oncoming, Course::crossing, Course::overtaking};
const char* name(Course course);

/// When the robot of a scenario without movers has come so far on its way straight to the goal; m, s.
using Arrival = std::function<double(const Scenario& alone, double along_m)>;

/// 4 m straight to the goal in any direction, and one disc of radius 0.03 to 0.3 m at this speed, above 0 to
/// 10 m/s, whose path lies within 0.3 m of the robot's or crosses it, there at most 1.5 s before or after the
/// robot's arrival. All this is for the reference body: a larger radius widens the distances by the
/// difference, and a slower robot has more time. The same seed, below 2^63, gives the same scenario on every
/// machine, and the same disc and meeting point at every speed and for every arrival.
Scenario meeting(Course course, double speed_mps, std::uint64_t seed, const Arrival& arrival,
                 const Params& robot = {});

}  // namespace whisker::worlds
