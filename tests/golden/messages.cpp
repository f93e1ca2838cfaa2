#include "tests/golden/messages.hpp"

#include "firmware/params/words.hpp"

namespace whisker::golden {
namespace {

Stand stand(const Pose& pose) { return {pose.at.x.raw(), pose.at.y.raw(), pose.heading.raw()}; }

}  // namespace

void append_params(Bytes& to, const Params& params) {
  append(to, Name::params);
  for (int i = 0; i < kParams; ++i) append(to, Word{raw_param(params, i)});
}

void append_begin(Bytes& to, PlannerKind planner, const Pose& pose) {
  append(to, Name::begin,
         Begin{static_cast<std::uint8_t>(planner.number), static_cast<std::uint16_t>(planner.map_bytes),
               stand(pose)});
}

void append_goal(Bytes& to, const planning::Goal& goal) {
  append(to, Name::goal, Target{goal.at.x.raw(), goal.at.y.raw(), goal.tolerance.raw()});
}

void append_place(Bytes& to, const Pose& pose) { append(to, Name::place, stand(pose)); }

void append_fix(Bytes& to, const localization::UncertainPose& fix) {
  const localization::PoseSigma& sigma = fix.sigma;
  append(to, Name::fix, Fix{stand(fix.pose), sigma.along.raw(), sigma.across.raw(), sigma.heading.raw()});
}

void append_tick(Bytes& to, const sim::Plant& plant, Time now) {
  Tick tick;
  tick.now_ms = now.raw();
  tick.ranges = plant.ranges();
  tick.counts = plant.encoders();
  tick.bumps = plant.bumper();
  tick.gyro_given = plant.gyro_answers() ? 1 : 0;
  if (tick.gyro_given != 0) tick.gyro = plant.gyro();
  append(to, Name::tick, tick);
}

}  // namespace whisker::golden
