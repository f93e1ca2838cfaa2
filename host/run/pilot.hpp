/// What drives a simulated robot: the core in this process, or one on a chip.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "firmware/robot.hpp"
#include "host/run/planners.hpp"
#include "host/scenario/scenario.hpp"
#include "host/sim/plant.hpp"

namespace whisker {

class Pilot {
 public:
  virtual ~Pilot() = default;
  /// One control tick: takes what the plant's sensors say now, and commands its wheels.
  virtual const Status& tick(Time now) = 0;
  /// What the planner was shown last; null before its first step, and on a chip.
  virtual const perception::LocalGrid* local_grid() const { return nullptr; }
  /// Likewise what the planner's map tells it; null without a map, too.
  virtual const ShownGuide* guide() const { return nullptr; }
  /// The status has all that the core knows; false: only what a bus carries.
  virtual bool sees_inside() const { return true; }
  /// Where the robot believes to be, for a pilot that does not see inside; none: that is not known.
  virtual std::optional<Pose> estimate() const { return std::nullopt; }
  /// Why the robot will not move any more although its core knows of no fault; nullptr: it will.
  virtual const char* trouble() const { return nullptr; }
};

/// A pilot that stands at the scenario's start and has its goal. Scenario and plant must outlive it.
using MakePilot = std::function<std::unique_ptr<Pilot>(const Scenario&, PlannerKind, sim::Plant&)>;

/// The core in this process.
std::unique_ptr<Pilot> core_pilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant);

/// The scenario's goal in the core's units.
planning::Goal fixed_goal(const Goal& goal);

}  // namespace whisker
