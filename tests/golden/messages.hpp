/// Writes the messages of a golden stream.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware/apps/golden/message.hpp"
#include "firmware/robot.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker::golden {

using Bytes = std::vector<std::uint8_t>;

template <class M>
void append(Bytes& to, const M& body) {
  to.resize(to.size() + size_of<M>());
  encode(body, to.data() + to.size() - size_of<M>());
}
inline void append(Bytes& to, Name name) { to.push_back(static_cast<std::uint8_t>(name)); }
template <class M>
void append(Bytes& to, Name name, const M& body) {
  append(to, name);
  append(to, body);
}

void append_params(Bytes& to, const Params& params);
/// A planner of the core.
void append_begin(Bytes& to, PlannerKind planner, const Pose& pose);
void append_goal(Bytes& to, const planning::Goal& goal);
void append_place(Bytes& to, const Pose& pose);
void append_fix(Bytes& to, const localization::UncertainPose& fix);
/// A tick with the sensor data of the plant.
void append_tick(Bytes& to, const sim::Plant& plant, Time now);

}  // namespace whisker::golden
