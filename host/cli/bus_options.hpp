/// Options of the commands that use a CAN bus.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/can/node.hpp"
#include "firmware/can/rules_server.hpp"
#include "host/cli/cli11_forward.hpp"
#include "host/run/planners.hpp"

namespace whisker::cli {

struct BusChoice {
  std::string name;
  int robot = 1;
  std::string record;
  double drop_percent = 0;  ///< of the frames in each direction
  bool real_time = false;

  std::optional<std::uint32_t> rules;              ///< digest that the controller must name; none: any
  const can::RulesServer::Table* table = nullptr;  ///< of that digest, to send it
  can::Order order = can::Order::start;            ///< start, spin or straight

  /// The controller must drive with the table of this planner, which has one.
  void drive_with(PlannerKind planner);
  /// With a new boot number.
  can::Identity identity() const;
};

/// --can, --node, --record and --drop.
CLI::Option* add_bus(CLI::App& app, BusChoice& choice);

constexpr double kBitrate = 500000;  ///< bus for which the load is reported

}  // namespace whisker::cli
