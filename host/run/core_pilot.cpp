#include "host/run/core_pilot.hpp"

#include <memory>
#include <type_traits>
#include <utility>

#include "host/run/spec.hpp"

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

/// By template, because only an engine with this table compiles it. Null: it is not loaded, or the engine
/// takes none.
template <class Table>
const Table* engine_table_of(const Event& event) {
  if (event.file.empty()) return &fuzzy::kDefaultTable;
  if constexpr (std::is_same_v<Table, fuzzy::Bilinear::Table>) {
    return event.table;
  } else {
    return nullptr;
  }
}

}  // namespace

CorePilot::CorePilot(const Scenario& scenario, RecordedPlanner planner, sim::Plant& plant)
    : plant_(plant),
      fixes_(scenario),
      board_(plant),
      wheels_(board_),
      loss_(scenario.robot),
      goal_(fixed_goal(scenario.goal)),
      next_params_(scenario.robot),
      planner_(std::move(planner)) {
  make_robot(scenario.robot, fixed_pose(scenario.start));
}

void CorePilot::make_robot(const Params& params, const Pose& start) {
  shown_.emplace(*planner_.planner);
  robot_.emplace(board_, wheels_, *shown_, params, &board_, &board_);
  robot_->place(start);
  robot_->set_goal(goal_);
}

const Status& CorePilot::tick(Time now) {
  auto fix = fixes_.take(plant_);
  switch (loss_.step(away_.command, plant_)) {
    case LinkLoss::Step::up: break;
    case LinkLoss::Step::hold: return stay(false);
    case LinkLoss::Step::brake: return stay(true);
    case LinkLoss::Step::back:
      if (loss_.held()) note_braked();
      break;
    case LinkLoss::Step::resume:
      robot_->reset();
      robot_->set_goal(goal_);
      note_braked();
      break;
    case LinkLoss::Step::restart: start_anew(); break;
  }
  if (fix_) fix = fix_;
  fix_.reset();
  if (fix) robot_->correct(fix->pose, fix->sigma);
  return robot_->tick(now);
}

/// A tick without the robot.
const Status& CorePilot::stay(bool brakes) {
  if (brakes) away_.command = loss_.slowed(away_.command);
  board_.command(away_.command);
  return away_;
}

void CorePilot::note_braked() {
  wheels_.refuse();
  robot_->braked_elsewhere();
}

void CorePilot::start_anew() {
  robot_.reset();
  params_ = std::make_unique<Params>(next_params_);
  planner_ = make_recorded_planner(*kind_, *params_);
  changed_ = false;
  make_robot(*params_, fixed_pose(plant_.pose()));
}

bool CorePilot::start_with(const planning::Goal& goal) {
  if (!kind_) return false;
  goal_ = goal;
  away_ = robot_->status();
  away_.decision.outcome = planning::Outcome::running;
  away_.health = {};
  loss_.restart();
  return true;
}

bool CorePilot::aim(const planning::Goal& goal) {
  if (changed_) return start_with(goal);
  if (robot_->status().health.fault != Fault::none) return false;
  goal_ = goal;
  robot_->set_goal(goal);
  return true;
}

bool CorePilot::choose_table(const Event& event) {
  if (!kind_ || is_baseline(*kind_)) return false;
  const fuzzy::Engine::Table* const table = engine_table_of<fuzzy::Engine::Table>(event);
  if (table == nullptr) return false;
  kind_->table = table;
  return changed_ = true;
}

bool CorePilot::play(const Event& e) {
  switch (e.kind) {
    case EventKind::goal: return aim(fixed_goal(e.goal));
    case EventKind::cancel:
      if (robot_->status().health.fault != Fault::none) return false;
      robot_->cancel();
      return true;
    case EventKind::correct: fix_ = fix_of(e, plant_.pose()); return true;
    case EventKind::place: return robot_->place(pose_of(e, plant_.pose()));
    case EventKind::reset: robot_->reset(); return true;
    case EventKind::param: return kind_ && apply_param(e, next_params_) && (changed_ = true);
    case EventKind::table: return choose_table(e);
    case EventKind::frames_lost:
      away_ = robot_->status();
      loss_.lose(e.for_s);
      return true;
    case EventKind::restart: return start_with(goal_);
  }
  return false;
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
