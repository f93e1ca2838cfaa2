/// The premise of docs/safety.md: within it, every contact is a fault of the core.
#pragma once

#include "host/hunt/dice.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::hunt {

/// No obstacle lies within this distance of the start, m: what the beams cannot clear, and a tenth of a
/// millimetre.
double free_at_start_m(const Params& params);

/// Sensors that see at least what the robot believes, and noise within what it declares.
void draw_truth(Dice& dice, Scenario& scenario);

/// The robot (also after its events), the sensors, the noise, the start and the world keep the premise; a
/// file can hold them.
bool holds_premise(const Scenario& scenario);

}  // namespace whisker::hunt
