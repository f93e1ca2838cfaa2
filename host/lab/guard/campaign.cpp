#include "host/lab/guard/campaign.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "host/harness/worlds/beside.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/guard/operators.hpp"

namespace whisker::guard {
namespace {

constexpr double kWandering_s = 20;
constexpr double kToGoal_s = 120;

bool has_goal(Hand hand) { return hand != Hand::joystick && hand != Hand::hostile; }

constexpr double kDrive_s = 20;

/// With the operator, mode and table of the plan. None: the world has no path for this operator.
std::optional<Result> drive_one(const Plan& plan, Scenario world) {
  Options options;
  options.guarded = plan.mode.guarded;
  options.vouched_m = plan.mode.vouched_m;
  options.table = plan.table;
  options.until_goal = has_goal(plan.hand);
  options.time_s = options.until_goal ? kToGoal_s : kWandering_s;
  world.robot.guard.nods = plan.mode.nods ? Fitted::yes : Fitted::no;
  world.robot.guard.assist = plan.mode.assists ? Fitted::yes : Fitted::no;
  const auto hand = make_operator(plan.hand, world, world.seed);
  if (!hand) return std::nullopt;
  return drive(world, *hand, options);
}

}  // namespace

void Summary::add(const Result& r) {
  ++drives;
  arrived += r.end == End::arrived ? 1U : 0U;
  contacts += r.end == End::contact ? 1U : 0U;
  faults += r.end == End::fault ? 1U : 0U;
  stops += r.stops;
  path_m += r.path_m;
  time_s += r.time_s;
  granted += r.granted;
  min_clearance_m = std::fmin(min_clearance_m, r.min_clearance_m);
}

Summary drive_many(const Plan& plan, const std::function<bool(std::uint64_t)>& next) {
  Summary summary;
  for (std::uint64_t i = 0; i < plan.count && next(i); ++i) {
    worlds::Options options;
    options.seed = plan.first_seed + i;
    options.discs = plan.ground.discs;
    options.box = plan.ground.box;
    options.noise = plan.noise;
    Scenario world = worlds::generate(worlds::Kind::discs, options);
    world.robot = plan.robot;
    if (const auto result = drive_one(plan, std::move(world))) summary.add(*result);
  }
  return summary;
}

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
