#include "host/harness/worlds/meeting.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/sim/si.hpp"
#include "host/harness/worlds/direction.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::worlds {
namespace {

constexpr double kWay = 4;        // m
constexpr double kOut = 30;       // m, beyond the reach of any mission
constexpr double kLimit = 120;    // s
constexpr double kEarlier = 1.5;  // s, earlier or later

}  // namespace

const char* name(Course course) {
  switch (course) {
    case Course::oncoming: return "oncoming";
    case Course::crossing: return "crossing";
    case Course::overtaking: return "overtaking";
  }
  return "?";
}

Scenario meeting(Course course, double speed_mps, std::uint64_t seed, const Arrival& arrival,
                 const Params& robot) {
  const Params reference;
  const double wider = sim::si(robot.body.radius) - sim::si(reference.body.radius);
  Random random(seed);
  const double heading_deg = random.uniform(-180, 180);
  const sim::Vec2 ahead = direction(heading_deg);
  const auto place = [&](double along, double aside) {
    return sim::Vec2{along * ahead.x - aside * ahead.y, along * ahead.y + aside * ahead.x};
  };
  Scenario s;
  s.name = fmt::format("{}_{:.2f}_{}", name(course), speed_mps, seed);
  s.seed = seed;
  s.time_limit_s =
      kLimit * std::max(1.0, sim::si(reference.wheels.max_speed) / sim::si(robot.wheels.max_speed));
  s.goal.at = place(kWay + wider, 0);
  s.start = {{0, 0}, heading_deg * kRadPerDeg};
  s.robot = robot;
  Mover m;
  m.radius_m = random.uniform(0.03, 0.3);
  m.speed_mps = speed_mps;
  const double aside = random.uniform(-0.3 - wider, 0.3 + wider);
  switch (course) {
    case Course::oncoming:
      m.path = {place(wider + random.uniform(2, 3.5), aside), place(-kOut, aside)};
      break;
    case Course::crossing: {
      const double at = wider + random.uniform(0.8, 3);
      const double wait_s = arrival(s, at) + random.uniform(-kEarlier, kEarlier);
      const double side = random.chance(0.5) ? 1 : -1;
      const double slant = random.uniform(-3, 3);
      m.path = {place(at, side * (wait_s * speed_mps + m.radius_m)), place(at + slant, -kOut * side)};
      break;
    }
    case Course::overtaking:
      m.path = {place(-wider - random.uniform(0.5, 1), aside), place(kOut, aside)};
      break;
  }
  m.center = m.path[0];
  s.movers = {m};
  return s;
}

}  // namespace whisker::worlds
