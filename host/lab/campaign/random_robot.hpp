/// Robots drawn at random over the accepted parameters. docs/campaign.md lists the distributions.
#pragma once

#include <array>
#include <cstdint>

#include "firmware/params.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker::campaign {

/// Refused draws, indexed by ParamFault: each counts for its first violated relation.
using Refusals = std::array<std::uint64_t, kParamFaults>;

struct RandomRobot {
  Params params;        ///< check() accepts them
  Refusals refusals{};  ///< of the draws before it
};

/// The same seed gives the same robot on every machine.
RandomRobot random_robot(std::uint64_t seed);

/// Radius of the body over that of the reference robot, for which the worlds are made.
double size_of(const Params& robot);

/// Gives the scenario this robot: scales every length of the world by size_of(robot), and the time limit by
/// the larger of size_of(robot) / (full speed / full speed of the reference robot) and (turn rate of the
/// reference robot / turn rate), because a robot that must sweep its beams spends most of its time in turns.
void fit_to(Scenario& scenario, const Params& robot);

}  // namespace whisker::campaign
