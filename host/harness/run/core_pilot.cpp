#include "host/harness/run/core_pilot.hpp"

#include <utility>

#include "host/harness/run/spec.hpp"

namespace whisker {
namespace {

/// The same as planning::TableMap, with a recording guide.
template <int kBytes>
struct RecordingMap {
  RecordingMap(const Params& params, const fuzzy::Engine::Table& table)
      : law(table), map(params), guide(map.guide), planner(params, law, &guide) {}
  planning::TableDeflection law;
  planning::MapOf<kBytes> map;
  RecordingGuide guide;
  planning::BoundaryPlanner planner;
};

}  // namespace

CorePilot::CorePilot(const Scenario& scenario, RecordedPlanner planner, sim::Plant& plant)
    : plant_(plant),
      fixes_(scenario),
      board_(plant),
      wheels_(board_),
      planner_(std::move(planner)),
      shown_(*planner_.planner),
      robot_(board_, wheels_, shown_, scenario.robot, &board_, &board_) {
  robot_.place(fixed_pose(scenario.start));
  robot_.set_goal(fixed_goal(scenario.goal));
}

const Status& CorePilot::tick(Time now) {
  const Status& status = robot_.tick(now);
  if (const auto fix = fixes_.take(plant_)) robot_.correct(fix->pose, fix->sigma);
  return status;
}

planning::Goal fixed_goal(const Goal& goal) {
  return {fixed_pose({goal.at, 0}).at, fixed_pose({{goal.tolerance_m, 0}, 0}).at.x};
}

RecordedPlanner make_core_planner(PlannerKind kind, const Params& params, const fuzzy::Engine::Table& table) {
  return planning::with_planner<RecordedPlanner>(
      kind.number, kind.map_bytes, [&](auto type) -> RecordedPlanner {
        if constexpr (type.kMapBytes != 0) {
          const auto map = std::make_shared<RecordingMap<type.kMapBytes>>(params, table);
          return {{map, &map->planner}, &map->guide};
        } else {
          const auto made = std::make_shared<typename decltype(type)::Type>(params, table);
          return {{made, &planning::planner_in(*made)}};
        }
      });
}

}  // namespace whisker
