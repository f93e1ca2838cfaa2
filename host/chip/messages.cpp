#include "host/chip/messages.hpp"

#include <string>

#include "firmware/apps/pil_link/params.hpp"

namespace whisker::chip {
namespace {

link::Stand stand(const Pose& pose) { return {pose.at.x.raw(), pose.at.y.raw(), pose.heading.raw()}; }

}  // namespace

void append_params(Bytes& to, const Params& params) {
  append(to, link::Name::params);
  to.resize(to.size() + link::kParamsSize);
  link::encode_params(params, to.data() + to.size() - link::kParamsSize);
}

void append_begin(Bytes& to, PlannerKind planner, const Pose& pose) {
  if (is_baseline(planner)) throw NoSuchPlanner(name(planner) + ": no chip has this planner");
  const auto number = static_cast<std::uint8_t>(planner.number);
  const auto bytes = static_cast<std::uint16_t>(planner.map_bytes);
  append(to, link::Name::begin, link::Begin{number, bytes, stand(pose)});
}

void append_goal(Bytes& to, const planning::Goal& goal) {
  append(to, link::Name::goal, link::Target{goal.at.x.raw(), goal.at.y.raw(), goal.tolerance.raw()});
}

void append_place(Bytes& to, const Pose& pose) { append(to, link::Name::place, stand(pose)); }

void append_fix(Bytes& to, const localization::UncertainPose& fix) {
  const localization::PoseSigma& sigma = fix.sigma;
  append(to, link::Name::fix,
         link::Fix{stand(fix.pose), sigma.along.raw(), sigma.across.raw(), sigma.heading.raw()});
}

void append_tick(Bytes& to, const sim::Plant& plant, Time now) {
  if (plant.gyro_answers()) append(to, link::Name::gyro, link::GyroSums{plant.gyro()});
  link::Tick tick;
  tick.now_ms = now.raw();
  tick.ranges = plant.ranges();
  tick.counts = plant.encoders();
  tick.bumps = plant.bumper();
  append(to, link::Name::tick, tick);
}

}  // namespace whisker::chip
