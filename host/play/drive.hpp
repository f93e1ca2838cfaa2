/// One robot of the playground: it drives, and its world may change under way.
#pragma once

#include <memory>
#include <vector>

#include "host/report/track.hpp"
#include "host/run/core_pilot.hpp"
#include "host/run/map_picture.hpp"
#include "host/run/sim_world.hpp"
#include "host/run/trip.hpp"

namespace whisker::play {

class Drive {
 public:
  /// From the scenario's start; the planner is one of the core's own. The table must outlive it; its changes
  /// take effect at once. Until the first change() its commands are those of run().
  Drive(const Scenario& scenario, PlannerKind planner, const fuzzy::Engine::Table& table);
  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;

  /// At most so many ticks; fewer when there is a verdict.
  void advance(int ticks);
  /// Obstacles and goal are now this scenario's; start, noise, seed and time limit stay. Who has arrived or
  /// given up sets out again.
  void change(const Scenario& scenario);

  const Trip& trip() const { return trip_; }
  /// As MapWatch takes pictures of it; nothing without a map.
  const std::optional<MapPicture>& map() const { return map_.last(); }
  std::int32_t map_bytes() const { return map_bytes_; }
  const sim::Plant& plant() const { return plant_; }
  const Scenario& scenario() const { return scenario_; }

  /// A place that the body passed, and what it did on the way to it.
  struct Passed {
    sim::Vec2 at;
    report::Doing doing;
  };
  /// The way so far: no two places in a row are nearer than 5 mm unless what it did changed.
  const std::vector<Passed>& way() const { return way_; }

 private:
  void note();

  Scenario scenario_;
  std::unique_ptr<SimWorld> world_;
  sim::WorldView view_;
  sim::Plant plant_;
  CorePilot pilot_;
  Trip trip_;
  MapWatch map_;
  std::int32_t map_bytes_;
  std::vector<Passed> way_;
};

}  // namespace whisker::play
