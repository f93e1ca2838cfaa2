#pragma once

#include <functional>
#include <string>

#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/can/node.hpp"
#include "host/harness/hil/line.hpp"
#include "host/harness/run/planners.hpp"

namespace whisker::hil {

struct ControllerOptions {
  can::Identity identity{1, 1, 0};
  PlannerKind planner = kDefaultPlanner;
  hal::Storage* storage = nullptr;             ///< keeps the response table of a base; null: none
  planning::Calibrator* calibrator = nullptr;  ///< null: orders to calibrate are refused
  can_app::PlannerMaker* planners = nullptr;   ///< instead of planners of that kind
  bool guard = false;                          ///< a guard node instead
  Duration longest_command = milliseconds(can::kVelocityLate_ms);  ///< of a guard node
  const fuzzy::Bilinear::Table* assist = nullptr;  ///< response table of its assist; null: the core's own
  std::function<void(const std::string&)> say;     ///< receives each activity or awaited item once
  std::function<bool()> interrupted;               ///< true: end
};

/// Runs the firmware core as a node of the bus until it is interrupted. port: that of the line, or a wrapper
/// around it.
void control(hal::CanPort& port, Line& line, const ControllerOptions& options);

}  // namespace whisker::hil
