/// Drives a case and judges it.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "host/lab/hunt/case.hpp"

namespace whisker::hunt {

struct Outcome {
  std::string end;      ///< "reached", "contact", "fault clock_jump", ...
  std::string finding;  ///< what broke the promise; empty: nothing
  double time_s = 0;
  double path_m = 0;
  double gap_m = 0;      ///< smallest gap between body and obstacle
  double closeness = 0;  ///< see Judge
  int work = 0;          ///< the most of a tick, in units of Work; of the guard alone: not measured
  std::uint64_t hash = 0;
  std::set<std::string> states;  ///< that the robot was in: modes with reasons, reasons of the guard
};

/// Deterministic. Case::commands becomes what an Attacker commanded. The findings:
///   contact          the body touched an obstacle
///   judges_disagree  the simulator sees a contact and the judge none, or the other way round
///   fault NAME       the robot stopped with a fault, and sensors and drive are as declared
///   stuck            a mission neither ends nor moves
///   off_goal         the robot says reached and is not there
///   unreachable      it says so although a way exists that is as wide as the planners promise to pass
///   gave_up WHY      the same, of a planner that gives up
///   work             a tick did more than Work::kMost
///   part NAME WHAT   a part of the core does not do what a plain model of it does
///   other_hash       a second drive of the same mission, over a bus or from its frames, gave other commands
Outcome attempt(Case& c);

}  // namespace whisker::hunt
