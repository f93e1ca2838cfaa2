#include "host/harness/scenario/contact.hpp"

#include <fmt/format.h>

#include "host/harness/scenario/nearest.hpp"

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

std::string start_warning(const Scenario& s) {
  const Nearest nearest = nearest_obstacle(s, s.start.at);
  const double free_m = reach(s.robot).guard.raw() * 1e-6, radius_m = s.robot.body.radius.raw() * 1e-6;
  if (nearest.distance_m >= free_m || !start_is_free(s)) return {};
  return fmt::format(
      "the start is {:.4f} m from {}: the guard relies on {:.4f} m free around the body where it "
      "is put down",
      nearest.distance_m - radius_m, nearest.what, free_m - radius_m);
}

}  // namespace whisker
