#include "host/harness/worlds/beside.hpp"

#include "host/harness/scenario/contact.hpp"
#include "host/harness/worlds/scale.hpp"

namespace whisker::worlds {

Scenario beside_obstacle(Random& random, Classes classes, bool noise, const Params& robot) {
  const Class& c = classes.first[random.index(classes.count)];
  Options options;
  options.seed = random.bits() >> 2;
  options.noise = noise;
  options.box = c.box;
  if (c.discs != 0) options.discs = c.discs;
  Scenario s = generate(c.kind, options);
  const double size = robot.body.radius.raw() * 1e-6 / 0.09;
  scale_lengths(s, size);
  s.robot = robot;
  const double placed_m = rim_sweep(robot).radius.raw() * 1e-6;
  for (int i = 0; i < 200; ++i) {
    const sim::Vec2 at{s.start.at.x + random.uniform(-0.5, 3) * size,
                       s.start.at.y + random.uniform(-0.5, 3) * size};
    const double gap = nearest_obstacle(s, at).distance_m - placed_m;
    if (gap < 0.001 * size || gap > 0.3 * size) continue;
    s.start.at = at;
    break;
  }
  s.start.heading = random.uniform(-3.14, 3.14);
  s.seed = random.bits();
  return s;
}

}  // namespace whisker::worlds
