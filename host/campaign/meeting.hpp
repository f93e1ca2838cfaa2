/// Missions in which something moves, and whether the robot could have seen what it touched.
#pragma once

#include <cstdint>

#include "host/run/planners.hpp"
#include "host/run/record.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::campaign {

constexpr double kMoving = 0.02;  ///< m/s: a centre slower than this stands
/// s for which a beam must have shown the thing: three readings, their latency, and the way to rest.
constexpr double kInTime = 0.6;
constexpr double kSeenWithin = 0.7;  ///< m from a beam's apex: farther off nothing is judged

struct Meeting {
  Verdict verdict = Verdict::gave_up;
  double time_s = 0;
  double speed_mps = 0;  ///< of the body's centre in the tick that ended in a contact
  double shown_s = 0;    ///< until the contact, a beam has shown some part of the thing for so long
  double near_s = 0;     ///< the same of its nearest point, to 3 cm
  bool said = false;     ///< at some tick the reason was planning::Why::something_moves
};

/// Drives a scenario with one mover and nothing else; deterministic.
Meeting meet(const Scenario& scenario, PlannerKind planner);

struct MeetingCount {
  std::uint64_t missions = 0;
  std::uint64_t reached = 0;
  std::uint64_t said = 0;
  std::uint64_t contacts = 0;
  std::uint64_t moving = 0;  ///< contacts of a body faster than kMoving
  std::uint64_t shown = 0;   ///< of these, some part of the thing was shown for kInTime
  std::uint64_t seen = 0;    ///< of these, its nearest point was

  void add(const Meeting& meeting);
};

}  // namespace whisker::campaign
