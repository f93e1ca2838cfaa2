/// Messages to a robot behind a byte stream; firmware/apps/pil_link/message.hpp defines their meaning.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "firmware/apps/pil_link/bytes.hpp"
#include "firmware/apps/pil_link/message.hpp"
#include "firmware/robot.hpp"
#include "host/run/planners.hpp"
#include "host/sim/plant.hpp"

namespace whisker::chip {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& to, link::Name name) { to.push_back(static_cast<std::uint8_t>(name)); }

template <class M>
void append(Bytes& to, link::Name name, const M& body) {
  append(to, name);
  to.resize(to.size() + link::size_of<M>());
  link::encode(body, to.data() + to.size() - link::size_of<M>());
}

/// The protocol does not support this planner, because only the host has it.
class NoSuchPlanner : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

void append_params(Bytes& to, const Params& params);
/// Throws NoSuchPlanner, and then appends nothing.
void append_begin(Bytes& to, PlannerKind planner, const Pose& pose);
void append_goal(Bytes& to, const planning::Goal& goal);
void append_place(Bytes& to, const Pose& pose);

void append_fix(Bytes& to, const localization::UncertainPose& fix);

/// A tick with the sensor data of the plant, and before it the gyro's if it answers.
void append_tick(Bytes& to, const sim::Plant& plant, Time now);

}  // namespace whisker::chip
