/// A robot of the playground that one of the core's planners drives.
#pragma once

#include <memory>

#include "host/harness/run/core_pilot.hpp"
#include "host/harness/run/mission_run.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/lab/play/simulated_robot.hpp"

namespace whisker::play {

class Drive final : public SimulatedRobot {
 public:
  /// Starts at the scenario's start with one of the core's own planners. The table must outlive it; its
  /// changes take effect at once. Until the first change(), its commands equal those of run().
  Drive(const Scenario& scenario, PlannerKind planner, const fuzzy::Engine::Table& table);

  void advance(int ticks) override;
  /// A robot that has arrived or given up starts again.
  void change(const Scenario& scenario) override;

  TickRecord record() const override { return run_.record(); }
  RunResult result() const override { return run_.result(); }
  bool over() const override { return run_.verdict().has_value(); }
  Fault fault() const override { return run_.status().health.fault; }
  const perception::LocalGrid* local_grid() const override { return run_.local_grid(); }
  Pose grid_pose() const override { return run_.status().pose; }
  const Params& params() const override { return scenario_.robot; }
  const std::optional<MapPicture>& map() const override { return map_.last(); }
  std::int32_t map_bytes() const override { return map_bytes_; }

  const MissionRun& mission() const { return run_; }
  const sim::Plant& plant() const { return plant_; }

 private:
  Scenario scenario_;
  std::unique_ptr<SimWorld> world_;
  sim::WorldView view_;
  sim::Plant plant_;
  CorePilot pilot_;
  MissionRun run_;
  MapWatch map_;
  std::int32_t map_bytes_;
};

}  // namespace whisker::play
