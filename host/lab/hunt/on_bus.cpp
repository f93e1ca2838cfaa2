#include "host/lab/hunt/on_bus.hpp"

#include <atomic>
#include <exception>
#include <sstream>
#include <thread>

#include "host/harness/hil/bus_pilot.hpp"
#include "host/harness/hil/candump.hpp"
#include "host/harness/hil/controller_loop.hpp"
#include "host/harness/hil/figures.hpp"
#include "host/harness/hil/host_rules.hpp"
#include "host/harness/hil/line.hpp"
#include "host/harness/hil/replay.hpp"
#include "host/harness/hil/tap.hpp"
#include "host/harness/hil/wall_clock.hpp"
#include "host/harness/run/runner.hpp"

namespace whisker::hunt {
namespace {

class ControllerThread {
 public:
  ControllerThread(hil::Line& line, PlannerKind planner)
      : thread_([this, &line, planner] {
          hil::ControllerOptions how;
          how.planner = planner;
          how.interrupted = [this] { return over_.load(); };
          hil::control(line.port(), line, how);
        }) {}
  ~ControllerThread() {
    over_ = true;
    thread_.join();
  }
  ControllerThread(const ControllerThread&) = delete;
  ControllerThread& operator=(const ControllerThread&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::thread thread_;
};

/// The hash of a drive whose frames go into the log.
std::uint64_t driven(const Scenario& scenario, PlannerKind planner, std::ostream& log) {
  const auto [base, far_end] = hil::private_lines();
  const ControllerThread controller(*far_end, planner);
  hil::Tap tap(base->port(), [&log](const hal::CanFrame& frame) {
    log << hil::log_line({0, "bus", frame}) << '\n';
  });
  hil::WallClock clock([&line = *base] { return line.descriptor(); });
  hil::Figures figures;
  hil::BusOptions how;
  how.rules = rules_digest(planner);
  how.table = hil::table_to_send(planner);
  RunOptions options;
  options.planner = planner;
  options.pilot = hil::bus_pilot(tap, clock, how, figures);
  return run(scenario, options).hash;
}

}  // namespace

std::string differs_on_bus(const Scenario& scenario, PlannerKind planner, std::uint64_t hash) {
  std::stringstream log;
  try {
    if (driven(scenario, planner, log) != hash) return "other_hash bus";
    hil::ReplayOptions options;
    options.planner = planner;
    const hil::ReplayResult again = hil::replay(log, "the log of the bus", options);
    // What the base commands without a controller is not replayed.
    const bool alike = !scenario.events.empty() || again.hash == hash;
    return again.difference.empty() && alike ? "" : "other_hash replay";
  } catch (const std::exception& e) {
    return std::string("no drive over a bus: ") + e.what();
  }
}

}  // namespace whisker::hunt
