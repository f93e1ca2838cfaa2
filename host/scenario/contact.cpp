#include "host/scenario/contact.hpp"

#include <fmt/format.h>

#include "host/scenario/nearest.hpp"

namespace whisker {

Nearest nearest_obstacle(const Scenario& s, sim::Vec2 p) {
  const NearThing thing = near_thing(s, p);
  return {thing.distance_m,
          thing.number > 0 ? fmt::format("{} {}", thing.kind, thing.number) : std::string(thing.kind)};
}

std::string start_fault(const Scenario& s) {
  if (start_is_free(s)) return {};
  const Nearest nearest = nearest_obstacle(s, s.start.at);
  return fmt::format("the start is in contact with {}: it is {:.4f} m away, and the body's radius is {} m",
                     nearest.what, nearest.distance_m, s.robot.body.radius.raw() / 1e6);
}

}  // namespace whisker
