#include "host/cli/bench_bus.hpp"

#include <sys/socket.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "firmware/can/codec.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/version.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/harness/hil/error_names.hpp"

namespace whisker::cli {
namespace {

constexpr int kMostPolls = 64;  // a bus that is never silent must not block the end

/// The kernel keeps what arrives while others have the processor: in lockstep, thousands of frames a second.
/// Without privileges, it grants as much as net.core.rmem_max; a tty has no such buffer.
void enlarge_buffer(int descriptor) {
  const int bytes = 4 << 20;
  if (setsockopt(descriptor, SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes) == 0) return;
  setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
}

constexpr double kFarewell_s = 0.5;  // the base hears that the mission is over

std::string state_words(const can::Node& node, bool started) {
  switch (node.state()) {
    case can::NodeState::off_bus: return "waits for the bus";
    case can::NodeState::waiting:
      return (node.errors() & can::Error::wrong_version) != 0 ? "the base speaks another protocol"
                                                              : "waits for the base";
    case can::NodeState::ready: return started ? "ready" : "waits for the base's order to start";
    case can::NodeState::running: return "drives";
    case can::NodeState::safe_stop: return "safe stop: " + hil::error_names(node.errors());
    case can::NodeState::e_stopped: return "E-stop";
  }
  return "";
}

}  // namespace

std::string version_text(std::uint32_t v) {
  return fmt::format("{}.{}.{}", v >> 16, v >> 8 & 0xFF, v & 0xFF);
}

std::string BenchChoice::bus_name() const {
  const int given = (can.empty() ? 0 : 1) + (tty.empty() ? 0 : 1) + (socket.empty() ? 0 : 1);
  if (given != 1) throw UsageError("bench: choose one of --can, --tty and --socket");
  if (!can.empty()) return can;
  return "slcan:" + (tty.empty() ? socket : baud ? fmt::format("{}@{}", tty, *baud) : tty);
}

void add_bench_line(CLI::App& app, BenchChoice& choice) {
  add_name(app, "--can", choice.can, "CAN interface, such as can0 or vcan0")->type_name("IFACE");
  add_name(app, "--tty", choice.tty, "Serial CAN adapter or board (SLCAN), such as /dev/ttyACM0")
      ->type_name("DEV");
  app.add_option("--baud", choice.baud, "Speed of the line of --tty; 115200 by default")
      ->type_name("N")
      ->check(CLI::Range(9600, 4000000))
      ->needs("--tty");
  add_name(app, "--socket", choice.socket, "The same behind a Unix socket, such as that of an emulator")
      ->type_name("PATH");
  amount(app.add_option("--timeout", choice.timeout_s, "Wait so long for each answer, s; 3 by default"), "S",
         600);
  amount(app.add_option("--drop", choice.bus.drop_percent,
                        "Lose so many of the frames that are sent and received, at random"),
         "PERCENT", 100);
}

void add_bench_bus(CLI::App& app, BenchChoice& choice) {
  add_bench_line(app, choice);
  within(app.add_option("--node", choice.bus.robot, "Number of the robot, 1 to 7; 1 by default"), "N", 1,
         static_cast<int>(can::kRobots));
}

BenchBus::BenchBus(const BenchChoice& choice)
    : choice_(choice),
      name_(choice.bus_name()),
      line_(hil::open_line(name_)),
      clock_([this] { return line_->descriptor(); }),
      lossy_(lossy(line_->port(), choice.bus)),
      port_(lossy_, survey_, clock_) {}

std::pair<int, int> BenchBus::stopped_of_all() const {
  int stopped = 0, all = 0;
  for (const can::Party party : {can::Party::controller, can::Party::base}) {
    if (!alive(party)) continue;
    ++all;
    if (survey_.find(robot(), party)->beat.state == can::NodeState::e_stopped) ++stopped;
  }
  return {stopped, all};
}

void BenchBus::order(std::uint8_t command) {
  can::EStop what;
  what.command = command;
  send(can::encode(what, static_cast<std::uint8_t>(robot()), 0));
}

void BenchBus::join() {
  const std::uint64_t end_us = clock_.now_us() + static_cast<std::uint64_t>(choice_.timeout_s * 1e6);
  for (;;) {
    port_.poll(clock_.now_ms());
    guard_.watch(port_, clock_.now_ms());
    if (guard_.on_bus()) return enlarge_buffer(line_->descriptor());
    if (interrupt_.noted()) throw bench::Interrupted("interrupted");
    if (clock_.now_us() >= end_us) {
      const std::string what = line_->waits_for();
      throw bench::NoAnswer(fmt::format("{}: not on the bus after {} s{}", name_, choice_.timeout_s,
                                        what.empty() ? "" : ": waits for " + what));
    }
    clock_.wait_a_ms();
  }
}

/// All that has come: a poll takes what fits into the queue of the port.
void BenchBus::take(const std::function<void(const hal::CanFrame&)>& each) {
  hal::CanFrame frame{};
  bool received = true;
  for (int i = 0; received && i < kMostPolls; ++i) {
    received = false;
    port_.poll(clock_.now_ms());
    for (; port_.receive(frame); received = true) {
      if (each) each(frame);
    }
  }
}

/// Looks at the clock before it takes what has come: whoever is held up longer than the time misses nothing.
bool BenchBus::listen(double seconds, const std::function<bool()>& done,
                      const std::function<void(const hal::CanFrame&)>& each) {
  join();
  const std::uint64_t end_us = clock_.now_us() + static_cast<std::uint64_t>(seconds * 1e6);
  for (;;) {
    const bool over = clock_.now_us() >= end_us, interrupted = interrupt_.noted();
    take(each);
    guard_.watch(port_, clock_.now_ms());
    if (done && done()) return true;
    if (interrupted) throw bench::Interrupted("interrupted");
    if (over) return false;
    clock_.wait_a_ms();
  }
}

void BenchBus::meet(const std::function<void(const hal::CanFrame&)>& each) {
  const auto met = [this] { return !survey_.misses_one(robot()); };
  listen(kListen_s, nullptr, each);
  listen(choice_.timeout_s, met, each);
}

void BenchBus::find_controller() {
  meet();
  const auto found = [&] { return has(can::Party::controller); };
  if (!found() && !listen(choice_.timeout_s, found)) {
    throw bench::NoAnswer(
        fmt::format("{}: no controller of robot {} in {} s", name_, robot(), choice_.timeout_s));
  }
}

bench::Patience BenchBus::patience() {
  return {static_cast<std::uint32_t>(choice_.timeout_s * 1e3), [this] { return interrupt_.noted(); }};
}

template <class Client>
std::unique_ptr<Client> BenchBus::ready(std::unique_ptr<Client> client) {
  client->connect();
  const bench::SeenNode* const node = survey_.find(robot(), can::Party::controller);
  if (node != nullptr && node->version && *node->version != kVersionNumber) {
    throw bench::NoAnswer(
        fmt::format("{}: the controller runs firmware {}, and this is whisker {}: the "
                    "numbers of their parameters may differ",
                    name_, version_text(*node->version), version_text(kVersionNumber)));
  }
  return client;
}

std::unique_ptr<bench::BaseClient> BenchBus::base() {
  find_controller();
  if (has(can::Party::base)) {
    throw bench::NoAnswer(fmt::format(
        "{}: robot {} has a base (node {}), and its controller takes this from its base only: take "
        "it off the bus first",
        name_, robot(), robot() + can::kBaseOffset));
  }
  return in_its_place();
}

std::unique_ptr<bench::BaseClient> BenchBus::in_its_place() {
  return ready(std::make_unique<bench::BaseClient>(port_, clock_, choice_.bus.identity(), patience()));
}

std::unique_ptr<bench::OperatorClient> BenchBus::third_party() {
  const auto number = static_cast<std::uint8_t>(choice_.bus.identity().boot);
  return ready(std::make_unique<bench::OperatorClient>(port_, clock_, survey_, robot(), number, patience()));
}

std::unique_ptr<bench::ParamClient> BenchBus::client() {
  find_controller();
  if (has(can::Party::base)) return third_party();
  return in_its_place();
}

void check_place(BenchBus& bus, const BenchChoice& choice) {
  const auto found = [&] {
    if (bus.has(can::Party::controller)) {
      throw bench::NoAnswer(fmt::format("{}: robot {} has a controller (node {}): take it off the bus first",
                                        bus.name(), bus.robot(), bus.robot()));
    }
    return bus.has(can::Party::base);
  };
  if (found() || bus.listen(choice.timeout_s, found)) return;
  throw bench::NoAnswer(
      fmt::format("{}: no base of robot {} in {} s", bus.name(), bus.robot(), choice.timeout_s));
}

void sit(BenchBus& bus, const BenchChoice& choice, bench::Seat& seat, double for_s,
         const std::function<bool()>& over, const std::function<bool()>& interrupted) {
  std::string said;
  const std::uint64_t start_us = bus.clock().now_us();
  std::uint64_t alive_us = start_us, over_us = 0;
  for (;;) {
    const bool stepped = seat.poll(bus.clock().now_ms());
    const std::uint64_t now_us = bus.clock().now_us();
    const std::string words = state_words(seat.node(), seat.started());
    if (words != said) fmt::print(stderr, "controller {} on {}: {}\n", bus.robot(), bus.name(), words);
    said = words;
    if (stepped || !seat.started()) alive_us = now_us;
    const bool is_over = seat.started() && over();
    if (is_over && over_us == 0) over_us = now_us;
    if (is_over && static_cast<double>(now_us - over_us) * 1e-6 >= kFarewell_s) return;
    if (interrupted()) throw bench::Interrupted("interrupted");
    if (!is_over && static_cast<double>(now_us - alive_us) * 1e-6 >= choice.timeout_s) {
      throw bench::NoAnswer(fmt::format("{}: {} for {} s", bus.name(), words, choice.timeout_s));
    }
    if (!is_over && static_cast<double>(now_us - start_us) * 1e-6 >= for_s) {
      if (!seat.started()) throw bench::NoAnswer(fmt::format("{}: {} for {} s", bus.name(), words, for_s));
      return;
    }
    seat.node().lockstep() ? bus.clock().wait(hil::Clock::kNap_us) : bus.clock().wait_a_ms();
  }
}

}  // namespace whisker::cli
