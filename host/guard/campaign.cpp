#include "host/guard/campaign.hpp"

#include <cmath>

#include "host/worlds/generate.hpp"

namespace whisker::guard {
namespace {

constexpr double kToGoal_s = 120;
constexpr double kWandering_s = 20;

bool has_goal(Hand hand) { return hand != Hand::joystick && hand != Hand::hostile; }

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
  Options options;
  options.guarded = plan.mode.guarded;
  options.vouched_m = plan.mode.vouched_m;
  options.table = plan.table;
  options.until_goal = has_goal(plan.hand);
  options.time_s = options.until_goal ? kToGoal_s : kWandering_s;
  for (std::uint64_t i = 0; i < plan.count && next(i); ++i) {
    worlds::Options world;
    world.seed = plan.first_seed + i;
    world.discs = plan.ground.discs;
    world.box = plan.ground.box;
    world.noise = plan.noise;
    Scenario scenario = worlds::generate(worlds::Kind::discs, world);
    scenario.robot = plan.robot;
    scenario.robot.guard.nods = plan.mode.nods ? Fitted::yes : Fitted::no;
    scenario.robot.guard.assist = plan.mode.assists ? Fitted::yes : Fitted::no;
    const auto hand = make_operator(plan.hand, scenario, world.seed);
    if (hand) summary.add(drive(scenario, *hand, options));
  }
  return summary;
}

}  // namespace whisker::guard
