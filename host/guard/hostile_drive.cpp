#include "host/guard/hostile_drive.hpp"

#include "host/guard/operators.hpp"
#include "host/worlds/beside.hpp"

namespace whisker::guard {
namespace {

constexpr double kDrive_s = 20;

}  // namespace

Result hostile_drive(std::uint64_t seed, bool noise, const Params& robot,
                     const fuzzy::Bilinear::Table* table) {
  worlds::Random place(seed);
  const Scenario scenario = worlds::beside_obstacle(place, worlds::kCrowdedClasses, noise, robot);
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
