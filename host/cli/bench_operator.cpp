#include "host/cli/bench_operator.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "firmware/can/table_hash.hpp"
#include "host/bench/operator_link.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/hil/error_names.hpp"

namespace whisker::cli {
namespace {

class Drive {
 public:
  Drive(BenchBus& bus, const BenchChoice& choice, const HandDrive& drive)
      : bus_(bus),
        choice_(choice),
        drive_(drive),
        link_(bus.port(), bus.robot(), drive.hand, drive.vouched_m,
              static_cast<std::uint8_t>(choice.bus.identity().boot)) {}

  int run() {
    start_us_ = alive_us_ = bus_.clock().now_us();
    while (!poll()) bus_.clock().wait_a_ms();
    line_.show("");
    print();
    return failed() ? kFault : bus_.interrupt().noted() ? kInterrupted : 0;
  }

 private:
  const bench::SeenNode* node() const { return bus_.survey().find(bus_.robot(), can::Party::controller); }
  double since_s(std::uint64_t then_us) {
    return static_cast<double>(bus_.clock().now_us() - then_us) * 1e-6;
  }
  Fault fault() const {
    const auto& status = link_.seen().status;
    return status && status->fault < kFaults ? static_cast<Fault>(status->fault) : Fault::none;
  }
  bool failed() const { return link_.started() && fault() != Fault::none; }

  /// True: it is over.
  bool poll() {
    link_.poll(bus_.clock().now_us());
    check_table();
    if (link_.disturbed()) {
      throw bench::NoAnswer(fmt::format("{}: another operator drives robot {}", bus_.name(), bus_.robot()));
    }
    tell();
    const bool interrupted = bus_.interrupt().noted();
    if (interrupted && !link_.started()) throw bench::Interrupted("interrupted");
    const bool ends =
        interrupted || (link_.started() && drive_.done(link_.time_s())) || link_.time_s() >= drive_.for_s;
    if (ends) link_.end();
    if (failed() || (ends && link_.stands())) return true;
    check_patience();
    return false;
  }

  void check_table() {
    if (!node()->table_hash) return;
    if (*node()->table_hash != can::kTableHash) {
      throw bench::NoAnswer(fmt::format("{}: the guard node speaks with the table {:08x}, not {:08x}",
                                        bus_.name(), *node()->table_hash, can::kTableHash));
    }
    link_.trust_table();
  }

  std::string words() {
    if (!bus_.alive(can::Party::controller)) return "not heard";
    const can::Heartbeat& beat = node()->beat;
    switch (beat.state) {
      case can::NodeState::off_bus:
      case can::NodeState::waiting: return "waits for the base";
      case can::NodeState::ready: return "waits for the base's order";
      case can::NodeState::running: break;
      case can::NodeState::safe_stop: return "safe stop: " + hil::error_names(beat.errors);
      case can::NodeState::e_stopped: return "E-stop";
    }
    const auto& guard = link_.seen().guard;
    return guard && guard->armed != 0 ? "drives" : "waits until nothing is asked of it";
  }

  void tell() {
    std::string now = words();
    if (now != said_) fmt::print(stderr, "guard {} on {}: {}\n", bus_.robot(), bus_.name(), now);
    said_ = std::move(now);
    const auto& guard = link_.seen().guard;
    if (!drive_.shown || !link_.started() || !guard) return;
    line_.show(fmt::format("granted {:3} % {:3} %, {:<16}", guard->granted_forward, guard->granted_turning,
                           can::kGuardReasonWords[guard->reason]));
  }

  void check_patience() {
    const bool drove = link_.driven() != driven_;
    driven_ = link_.driven();
    const bool there = bus_.alive(can::Party::controller);
    // Who is held up sends no heartbeat in time, but what it drives is heard.
    const bool drives = said_ == "drives" || said_ == "not heard";
    if (drives ? drove : there && !link_.started()) alive_us_ = bus_.clock().now_us();
    double waited_s = since_s(alive_us_);
    if (!link_.started() && since_s(start_us_) >= drive_.for_s) waited_s = drive_.for_s;
    if (waited_s < choice_.timeout_s && waited_s < drive_.for_s) return;
    throw bench::NoAnswer(fmt::format("{}: the guard node of robot {}: {} for {:.3g} s", bus_.name(),
                                      bus_.robot(), said_, waited_s));
  }

  void print() const {
    if (drive_.json) {
      const nlohmann::ordered_json json = {{"outcome", failed() ? "fault" : "ended"},
                                           {"fault", name(fault())},
                                           {"time_s", link_.time_s()},
                                           {"pose", nullptr}};
      fmt::print("{}\n", with_provenance(json.dump(), {}));
      return;
    }
    fmt::print("{} after {:.2f} s, through the guard node\n",
               failed() ? fmt::format("fault {}", name(fault())) : "ended", link_.time_s());
  }

  BenchBus& bus_;
  const BenchChoice& choice_;
  const HandDrive& drive_;
  bench::OperatorLink link_;
  ProgressLine line_;
  std::string said_;
  std::uint64_t start_us_ = 0, alive_us_ = 0, driven_ = 0;
};

}  // namespace

int operate(BenchBus& bus, const BenchChoice& choice, const HandDrive& drive) {
  return Drive(bus, choice, drive).run();
}

}  // namespace whisker::cli
