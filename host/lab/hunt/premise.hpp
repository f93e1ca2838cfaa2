/// The premise of docs/safety.md: within it, every contact is a fault of the core.
#pragma once

#include "host/harness/scenario/scenario.hpp"
#include "host/lab/hunt/case.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

/// No obstacle lies within this distance of the start, m: what the beams cannot clear, and a tenth of a
/// millimetre.
double free_at_start_m(const Params& params);

/// Sensors that see at least what the robot believes, and noise within what it declares.
void draw_truth(Dice& dice, Scenario& scenario);
/// Wheels that follow a command as soon as the robot believes, or sooner.
void draw_wheels(Dice& dice, Scenario& scenario);

/// No beam sees more than the robot believes; what a wider cone shows contradicts the other beams.
bool senses_as_declared(const Scenario& scenario);

/// A controller on the bus accepts the robot, also after its events, and knows the events (docs/scenario.md).
bool drives_alike_on_the_bus(const Scenario& scenario);

/// Drops lost frames, restarts and what needs one where ticks are uneven, because the base brakes by a clock
/// of its own, and lost frames where it holds a command for longer than the robot assumes.
void keep_base_in_time(Case& c);

/// The robot (also after its events), the sensors, the noise, the start and the world keep the premise; a
/// file can hold them.
bool holds_premise(const Scenario& scenario);

}  // namespace whisker::hunt
