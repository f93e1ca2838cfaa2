/// Missions with a moving object, and whether the robot could have detected the object that it touched.
#pragma once

#include <cstdint>

#include "host/harness/run/planners.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/worlds/meeting.hpp"

namespace whisker::campaign {

constexpr double kMoving = 0.02;  ///< m/s: a centre slower than this counts as standing
/// s for which a beam must have shown the object: three readings, their latency, and the braking time.
constexpr double kInTime = 0.6;
constexpr double kSeenWithin = 0.7;  ///< m from the apex of a beam: objects farther away are ignored

struct Meeting {
  Verdict verdict = Verdict::gave_up;
  double time_s = 0;
  double speed_mps = 0;  ///< of the body's centre in the tick that ended in a contact
  double shown_s = 0;    ///< time before the contact during which a beam showed some part of the object
  double near_s = 0;     ///< the same for its nearest point, to 3 cm
  bool said = false;     ///< the reason was planning::Why::something_moves in some tick
};

/// worlds::meeting with the robot, sensors and noise of `own`, timed to the drive of this planner without a
/// mover: a robot with another pace meets the same disc at the same place.
Scenario timed_meeting(worlds::Course course, double speed_mps, std::uint64_t seed, const Scenario& own,
                       PlannerKind planner);

/// Runs a scenario with one mover and nothing else; deterministic.
Meeting meet(const Scenario& scenario, PlannerKind planner);

struct MeetingCount {
  std::uint64_t missions = 0;
  std::uint64_t reached = 0;
  std::uint64_t said = 0;
  std::uint64_t contacts = 0;
  std::uint64_t moving = 0;  ///< contacts of a body faster than kMoving
  std::uint64_t shown = 0;   ///< of these: some part of the object was shown for kInTime
  std::uint64_t seen = 0;    ///< of these: its nearest point was shown

  void add(const Meeting& meeting);
};

}  // namespace whisker::campaign
