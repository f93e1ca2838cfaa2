/// One robot of the playground; its world may change during the run.
#pragma once

#include <memory>
#include <vector>

#include "host/report/track.hpp"
#include "host/run/core_pilot.hpp"
#include "host/run/map_picture.hpp"
#include "host/run/mission_run.hpp"
#include "host/run/sim_world.hpp"

namespace whisker::play {

class Drive {
 public:
  /// Starts at the scenario's start with one of the core's own planners. The table must outlive it; its
  /// changes take effect at once. Until the first change(), its commands equal those of run().
  Drive(const Scenario& scenario, PlannerKind planner, const fuzzy::Engine::Table& table);
  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;

  /// Runs up to this number of ticks; fewer if there is a verdict.
  void advance(int ticks);
  /// Adopts obstacles and goal of this scenario; start, noise, seed and time limit stay. A robot that has
  /// arrived or given up starts again.
  void change(const Scenario& scenario);

  const MissionRun& mission() const { return run_; }
  /// The pictures of MapWatch; none without a map.
  const std::optional<MapPicture>& map() const { return map_.last(); }
  std::int32_t map_bytes() const { return map_bytes_; }
  const sim::Plant& plant() const { return plant_; }
  const Scenario& scenario() const { return scenario_; }

  /// A place on the path, and the class of the path up to it.
  struct Passed {
    sim::Vec2 at;
    report::Doing doing;
  };
  /// The path so far: consecutive places are at least 5 mm apart unless the class changed.
  const std::vector<Passed>& way() const { return way_; }

 private:
  void note();

  Scenario scenario_;
  std::unique_ptr<SimWorld> world_;
  sim::WorldView view_;
  sim::Plant plant_;
  CorePilot pilot_;
  MissionRun run_;
  MapWatch map_;
  std::int32_t map_bytes_;
  std::vector<Passed> way_;
};

}  // namespace whisker::play
