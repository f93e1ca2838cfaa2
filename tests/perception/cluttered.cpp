#include "tests/perception/cluttered.hpp"

#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/harness/sim/cone.hpp"

namespace whisker::test {

sim::WorldView Cluttered::view() const {
  sim::WorldView v;
  v.discs = discs.data();
  v.disc_count = discs.size();
  v.segments = segments.data();
  v.segment_count = segments.size();
  return v;
}

perception::ConeObservation look(const Params& p, const Cluttered& world, const Pose& pose, int beam) {
  const sim::BeamSpec mounted = sim::robot_spec(p).beams[beam];
  const sim::Vec2 ahead{std::cos(radians(pose.heading)), std::sin(radians(pose.heading))};
  const sim::Vec2 left{-ahead.y, ahead.x};
  const double axis = radians(pose.heading) + mounted.angle;
  const sim::Vec2 body{metres(pose.at.x), metres(pose.at.y)};
  const sim::Cone cone{body + ahead * mounted.x + left * mounted.y,
                       {std::cos(axis), std::sin(axis)},
                       std::cos(mounted.cone_half_width),
                       std::sin(mounted.cone_half_width)};
  const double d = sim::range(cone, world.view(), 0, mounted.max_range);
  perception::ConeObservation observation;
  observation.number = static_cast<int8_t>(beam);
  observation.beam = perception::beam_of(mount(p.rangefinders, beam), pose);
  observation.hit = d < mounted.max_range;
  observation.free =
      observation.hit ? millimetres(static_cast<int>(std::floor(d * 1000 + 0.5))) : p.rangefinders.max_range;
  return observation;
}

}  // namespace whisker::test
