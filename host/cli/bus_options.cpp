#include "host/cli/bus_options.hpp"

#include <ctime>

#include <unistd.h>

#include <CLI/CLI.hpp>

#include "firmware/can/ids.hpp"
#include "host/cli/options.hpp"
#include "host/hil/host_rules.hpp"

namespace whisker::cli {
namespace {

/// "1.2.3" as the bytes of one number.
std::uint32_t version_number() {
  std::uint32_t number = 0, part = 0;
  for (const char* c = WHISKER_VERSION; *c != 0; ++c) {
    if (*c == '.') {
      number = (number | part) << 8;
      part = 0;
    } else {
      part = part * 10 + static_cast<std::uint32_t>(*c - '0');
    }
  }
  return number | part;
}

}  // namespace

void BusChoice::drive_with(PlannerKind planner) {
  rules = rules_digest(planner);
  table = hil::table_to_send(planner);
}

can::Identity BusChoice::identity() const {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const auto mixed = static_cast<std::uint32_t>(now.tv_nsec) ^ static_cast<std::uint32_t>(getpid()) * 40503U;
  return {static_cast<std::uint8_t>(robot), static_cast<std::uint16_t>(mixed ^ mixed >> 16),
          version_number()};
}

CLI::Option* add_bus(CLI::App& app, BusChoice& choice) {
  app.add_option("--node", choice.robot, "Number of the robot, 1 to 7: two robots on one bus need two")
      ->check(CLI::Range(1, static_cast<int>(can::kRobots)))
      ->type_name("N");
  add_file(app, "--record", choice.record, "Write all frames as a candump log");
  app.add_option("--drop", choice.drop_percent,
                 "Lose so many of the frames that are sent and received, at random")
      ->transform(amount(100))
      ->type_name("PERCENT");
  return app
      .add_option("--can", choice.name,
                  "CAN interface, such as vcan0, or slcan:PATH for a serial\nline; it need not be there yet")
      ->type_name("IFACE");
}

}  // namespace whisker::cli
