/// What may happen during a drive.
#pragma once

#include <vector>

#include "host/harness/scenario/scenario.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

/// Up to six events in order of time, early and late in the drive.
void draw_events(Dice& dice, Scenario& scenario);

/// The robot as it may start anew after the events of kind param, each in turn.
std::vector<Params> robots_of(const Scenario& scenario);

}  // namespace whisker::hunt
