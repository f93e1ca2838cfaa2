#include <memory>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/can/codec.hpp"
#include "host/cli/bench_bus.hpp"
#include "host/cli/bench_commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/hil/error_names.hpp"

namespace whisker::cli {
namespace {

struct OrderOptions {
  BenchChoice bus;
};

constexpr double kAgain_s = 0.1;  // period of heartbeats

/// Of the nodes of the robot that live, those in the state e_stopped, and all.
std::pair<int, int> stopped_of_all(BenchBus& bus) {
  int stopped = 0, all = 0;
  for (const can::Party party : {can::Party::controller, can::Party::base}) {
    if (!bus.alive(party)) continue;
    ++all;
    if (bus.survey().find(bus.robot(), party)->beat.state == can::NodeState::e_stopped) ++stopped;
  }
  return {stopped, all};
}

/// Repeats the frame until all nodes of the robot are e_stopped, or none. It is on the identifier of the
/// controller, which both nodes obey, whoever sends it.
int press(const OrderOptions& o, std::uint8_t command) {
  BenchBus bus(o.bus);
  const bool stop = command == can::kStopCommand;
  can::EStop what;
  what.command = command;
  const hal::CanFrame frame = can::encode(what, static_cast<std::uint8_t>(bus.robot()), 0);
  // A stop must not wait for anything.
  bus.listen(stop ? 0.001 : BenchBus::kListen_s, nullptr);
  for (double waited = 0; waited < o.bus.timeout_s; waited += kAgain_s) {
    bus.send(frame);
    bus.listen(kAgain_s, nullptr);
    const auto [stopped, all] = stopped_of_all(bus);
    if (all == 0 || stopped != (stop ? all : 0)) continue;
    // Their heartbeats from before have passed.
    bus.listen(kAgain_s, nullptr);
    if (stopped_of_all(bus) != std::pair(stopped, all)) continue;
    fmt::print("robot {}: {}\n", bus.robot(), stop ? "E-stop" : "the E-stop is cleared; it starts nothing");
    return 0;
  }
  const auto [stopped, all] = stopped_of_all(bus);
  if (all == 0) {
    throw bench::NoAnswer(fmt::format("{}: {}robot {} was silent for {} s", bus.name(),
                                      stop ? "the E-stop was sent, but " : "", bus.robot(), o.bus.timeout_s));
  }
  throw bench::NoAnswer(fmt::format("{}: {} of {} nodes of robot {} {} after {} s{}", bus.name(),
                                    stop ? all - stopped : stopped, all, bus.robot(),
                                    stop ? "did not stop" : "stay stopped", o.bus.timeout_s,
                                    stop ? "" : ": the wheels must stand"));
}

int stop(const OrderOptions& o) { return press(o, can::kStopCommand); }
int reset(const OrderOptions& o) { return press(o, can::kClearCommand); }

int cancel(const OrderOptions& o) {
  BenchBus bus(o.bus);
  bus.client()->cancel();
  fmt::print("robot {}: cancelled\n", bus.robot());
  return 0;
}

}  // namespace

void add_bench_orders(CLI::App& bench, int& status) {
  const auto add = [&](const char* name, const char* about, int (*execute)(const OrderOptions&)) {
    const auto o = std::make_shared<OrderOptions>();
    CLI::App* cmd = bench.add_subcommand(name, about);
    add_bench_bus(*cmd, o->bus);
    cmd->callback([o, execute, &status] { status = bench_status([&] { return execute(*o); }); });
  };
  add("stop", "E-stop of the robot: the wheels brake and stand until reset", stop);
  add("reset", "Clear the E-stop, once the wheels stand; starts nothing", reset);
  add("cancel", "Stop the robot and clear its goal; its base may be on the bus", cancel);
}

}  // namespace whisker::cli
