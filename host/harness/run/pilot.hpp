/// Drives a simulated robot: the core in this process, or one on a bus.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "firmware/robot.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker {

class Pilot {
 public:
  virtual ~Pilot() = default;
  /// One control tick: reads the sensors of the plant and commands its wheels.
  virtual const Status& tick(Time now) = 0;
  /// An event between two ticks. False: it is refused, or means nothing to this pilot.
  virtual bool play(const Event&) { return false; }
  /// False: it has no controller, and events wait.
  virtual bool hears() const { return true; }
  /// The local grid last passed to the planner; null before its first step, and on a bus.
  virtual const perception::LocalGrid* local_grid() const { return nullptr; }
  /// The advice of the planner's global planner; null without a map, too.
  virtual const RecordingGuide* guide() const { return nullptr; }
  /// True if the status contains everything that the core knows; false: only what a bus carries.
  virtual bool sees_inside() const { return true; }
  /// The estimated pose, for a pilot without access to the core; none: unknown.
  virtual std::optional<Pose> estimate() const { return std::nullopt; }
  /// What the robot measures of its rangefinders; none: unknown.
  virtual std::optional<RangeTrust> ranges() const { return std::nullopt; }
  /// The standard deviations of the estimated pose; none: unknown.
  virtual std::optional<localization::PoseSigma> sigma() const { return std::nullopt; }
  /// Why the robot will not move any more although its core has no fault; nullptr: it will.
  virtual const char* trouble() const { return nullptr; }
};

/// A pilot at the start of the scenario, with its goal set. Scenario and plant must outlive it.
using MakePilot = std::function<std::unique_ptr<Pilot>(const Scenario&, PlannerKind, sim::Plant&)>;

/// The core in this process.
std::unique_ptr<Pilot> core_pilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant);

/// The goal of the scenario in the core's units.
planning::Goal fixed_goal(const Goal& goal);

}  // namespace whisker
