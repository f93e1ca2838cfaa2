/// The bus of the bench commands: options, and an open port that knows who is on it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "firmware/can/bus_guard.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/output.hpp"
#include "host/harness/bus/fault_port.hpp"
#include "host/harness/hil/line.hpp"
#include "host/harness/hil/wall_clock.hpp"
#include "host/lab/bench/operator_client.hpp"
#include "host/lab/bench/param_client.hpp"
#include "host/lab/bench/seat.hpp"
#include "host/lab/bench/survey.hpp"

namespace whisker::cli {

/// "1.2.3"; v: major << 16 | minor << 8 | patch.
std::string version_text(std::uint32_t v);

struct BenchChoice {
  std::string can, tty, socket;
  std::optional<int> baud;
  BusChoice bus;  ///< without a name; see bus_name
  double timeout_s = 3;

  /// For open_line. Throws UsageError unless exactly one of the three is given.
  std::string bus_name() const;
};

/// --can, --tty, --socket, --timeout and --drop.
void add_bench_line(CLI::App& app, BenchChoice& choice);
/// The same with --node.
void add_bench_bus(CLI::App& app, BenchChoice& choice);

/// The status of `run`. Throws Interrupted for bench::Interrupted.
int bench_status(const std::function<int()>& run);

/// All parameters. Throws bench::NoAnswer.
Params read_all(bench::ParamClient& client);

/// Prints the nodes that are heard in this time, s. Returns the exit status: 1 if there is none.
int list_nodes(const BenchChoice& choice, double for_s, bool json);

/// Opened by the constructor. Waits throw bench::NoAnswer and bench::Interrupted.
class BenchBus {
 public:
  static constexpr double kListen_s = 0.4;  ///< longer than the time after which a node counts as lost
  static constexpr double kMost_s = 86400;  ///< of --for
  static constexpr double kAgain_s = 0.1;   ///< period of heartbeats; an order is repeated so often

  explicit BenchBus(const BenchChoice& choice);

  /// Receives for this time, or until `done`, once the port is on the bus. each: receives every frame; may be
  /// empty. False: the time is over, and all that had come by then was received.
  bool listen(double seconds, const std::function<bool()>& done,
              const std::function<void(const hal::CanFrame&)>& each = nullptr);
  void send(const hal::CanFrame& frame) { port_.send(frame, can::kEventLife_ms); }

  /// Listens until it is known who is there.
  void meet(const std::function<void(const hal::CanFrame&)>& each = nullptr);
  /// It has sent a heartbeat. A node that is silent for a moment keeps its place: a second one there would
  /// stop the robot.
  bool has(can::Party party) const { return survey_.find(robot(), party) != nullptr; }
  /// It is not silent.
  bool alive(can::Party party) const { return survey_.alive(robot(), party, port_.polled_us()); }
  /// Of the nodes of the robot that live, those in the state e_stopped, and all.
  std::pair<int, int> stopped_of_all() const;
  /// An E-stop, or its end. It is on the identifier of the controller, which both nodes obey, whoever sends
  /// it.
  void order(std::uint8_t command);
  /// The robot's base. Throws bench::NoAnswer if the robot has one, or no controller.
  std::unique_ptr<bench::BaseClient> base();
  /// An operator, if the robot has a base, or else its base. Throws bench::NoAnswer if the robot has no
  /// controller, or another operator.
  std::unique_ptr<bench::ParamClient> client();
  /// Only if the robot has controller and base.
  std::unique_ptr<bench::OperatorClient> third_party();

  const bench::Survey& survey() const { return survey_; }
  hil::WallClock& clock() { return clock_; }
  hal::CanPort& port() { return port_; }
  hil::Line& line() { return *line_; }
  const std::string& name() const { return name_; }
  int robot() const { return choice_.bus.robot; }
  const Interrupt& interrupt() const { return interrupt_; }

 private:
  void join();
  void take(const std::function<void(const hal::CanFrame&)>& each);
  void find_controller();
  bench::Patience patience();
  std::unique_ptr<bench::BaseClient> in_its_place();
  /// Connects it, and compares the versions. Returns it.
  template <class Client>
  std::unique_ptr<Client> ready(std::unique_ptr<Client> client);

  const BenchChoice choice_;
  const std::string name_;
  Interrupt interrupt_;
  std::unique_ptr<hil::Line> line_;
  hil::WallClock clock_;
  bus::FaultPort lossy_;
  bench::Survey survey_;
  bench::SurveyPort port_;
  can::BusGuard guard_;
};

/// After listening for a while: the controller's place is free. Throws bench::NoAnswer if the robot has a
/// controller, or no base.
void check_place(BenchBus& bus, const BenchChoice& choice);

/// Until `over` for half a second, or the time is over. Throws bench::NoAnswer if the base gives no order, or
/// stops for longer than the time-out, and bench::Interrupted. Prints what it waits for on standard error.
void sit(BenchBus& bus, const BenchChoice& choice, bench::Seat& seat, double for_s,
         const std::function<bool()>& over, const std::function<bool()>& interrupted);

}  // namespace whisker::cli
