#include "host/guard/hostile_drive.hpp"

#include "host/guard/operators.hpp"
#include "host/scenario/contact.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/random.hpp"
#include "host/worlds/scale.hpp"

namespace whisker::guard {
namespace {

constexpr double kDrive_s = 20;

struct Class {
  worlds::Kind kind;
  int discs;
  bool box;
};
constexpr Class kClasses[] = {
    {worlds::Kind::discs, 30, false}, {worlds::Kind::discs, 50, false}, {worlds::Kind::discs, 75, true},
    {worlds::Kind::u_trap, 0, false}, {worlds::Kind::spiral, 0, false}, {worlds::Kind::maze, 0, false},
    {worlds::Kind::rooms, 0, false},  {worlds::Kind::poles, 0, false},  {worlds::Kind::enclosed, 0, false}};

}  // namespace

Scenario hostile_scenario(std::uint64_t seed, bool noise, const Params& robot) {
  worlds::Random random(seed);
  const Class& c = kClasses[random.index(9)];
  worlds::Options options;
  options.seed = random.bits() >> 2;
  options.noise = noise;
  options.box = c.box;
  if (c.discs != 0) options.discs = c.discs;
  Scenario s = worlds::generate(c.kind, options);
  const double size = robot.body.radius.raw() * 1e-6 / 0.09;
  worlds::scale_lengths(s, size);
  s.robot = robot;
  // The ground that rim_sweep() takes as free is free.
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

Result hostile_drive(std::uint64_t seed, bool noise, const Params& robot,
                     const fuzzy::Bilinear::Table* table) {
  const Scenario scenario = hostile_scenario(seed, noise, robot);
  worlds::Random random(~seed);
  const auto hand = make_operator(Hand::hostile, scenario, random.bits());
  Options options;
  options.time_s = kDrive_s;
  options.until_goal = false;
  options.table = table;
  if (random.chance(1.0 / 3)) {
    const int longest = static_cast<int>(longest_gap(robot).raw());
    options.gap_ms = [random, longest]() mutable { return 1 + random.index(longest); };
  }
  return drive(scenario, *hand, options);
}

}  // namespace whisker::guard
