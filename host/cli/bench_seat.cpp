#include "host/cli/bench_seat.hpp"

#include <fmt/core.h>

#include "host/hil/error_names.hpp"

namespace whisker::cli {
namespace {

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
