// A check list for a robot on the floor. Each step does one thing, says what it read, and is passed or not.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <poll.h>
#include <unistd.h>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/version.hpp"
#include "host/cli/bench_bus.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/lab/bench/ear.hpp"

namespace whisker::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWheels[] = {"left", "right"};
constexpr std::uint32_t kLook_ticks = 300, kGlance_ticks = 20, kHeld_ticks = 10;
constexpr double kSlowest = 10;       ///< a tick may take so many periods
constexpr double kTurned_m = 0.02;    ///< of a wheel by hand
constexpr double kSpeeds_up_m = 0.1;  ///< of both wheels together
constexpr double kStands_s = 1;       ///< after an E-stop at full speed
constexpr int kRestCounts = 2;        ///< a wheel that stands on an edge of its encoder
constexpr double kRestRate_dps = 5;   ///< bias of a gyro
constexpr double kGoal_m = 0.4, kFar_m = 1.2;

struct SelftestOptions {
  BenchChoice bus;
  std::string file = "selftest.json";
  double wait_s = 30;
  bool yes = false;
};

/// A line has come on standard input; eof: none will.
bool line_came(bool& eof) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (poll(&input, 1, 0) <= 0) return false;
  std::string line;
  eof = !std::getline(std::cin, line);
  return true;
}

class Selftest {
 public:
  explicit Selftest(const SelftestOptions& o) : o_(o), told_(words_beside({o.file})), bus_(o.bus) {}

  int run() {
    bus_.meet();
    for (const can::Party party : {can::Party::controller, can::Party::base}) {
      if (!bus_.has(party)) {
        throw bench::NoAnswer(
            fmt::format("{}: robot {} needs its controller and its base", bus_.name(), bus_.robot()));
      }
    }
    try {
      go_through();
    } catch (const bench::NoAnswer& e) {
      note("answer", "the robot does as it is told", e.what(), false);
    } catch (const bench::Interrupted&) {
      if (client_) client_->cancel();
      throw;
    }
    write();
    return failed_ == 0 ? 0 : kFailure;
  }

 private:
  void go_through() {
    client_ = bus_.third_party();
    params_ = read_all(*client_);
    const bench::Ear ear = heard(kLook_ticks);
    nodes();
    look(ear);
    for (int i = 0; i < hal::kBeams; ++i) hand(i);
    for (std::size_t i = 0; i < 2; ++i) wheel(i);
    rest();
    if (!agreed()) return;
    drive();
    stop();
  }

  void note(const std::string& name, const std::string& does, const std::string& read, bool passed) {
    steps_.push_back({{"step", name}, {"does", does}, {"read", read}, {"passed", passed}});
    if (!passed) ++failed_;
    fmt::print(told_, "{:<6} {:<13} {}: {}\n", passed ? "passed" : "FAILED", name, does, read);
    std::fflush(told_);
  }
  static void ask(const std::string& what) { fmt::print(stderr, "{}\n", what); }

  /// Until done, or for so long. Throws bench::NoAnswer if the robot is silent.
  bool hear(bench::Ear& ear, double seconds, const std::function<bool()>& done) {
    const bool came = bus_.listen(seconds, done, [&](const hal::CanFrame& frame) { ear.on_frame(frame); });
    if (ear.ticks() == 0) throw bench::NoAnswer(fmt::format("{}: no tick of the robot", bus_.name()));
    return came;
  }
  bench::Ear heard(std::uint32_t ticks) {
    bench::Ear ear(bus_.robot());
    const double tick_s = params_.safety.period.raw() * 1e-3;
    hear(ear, kSlowest * ticks * tick_s, [&] { return ear.ticks() >= ticks; });
    return ear;
  }
  double metres(std::int32_t counts) const {
    return static_cast<double>(counts) / params_.wheels.counts_per_metre;
  }
  std::string way(const bench::Ear& ear) const {
    return fmt::format("wheels {:.3f} m and {:.3f} m", metres(ear.turned()[0]), metres(ear.turned()[1]));
  }

  void nodes() {
    std::string read;
    bool well = true;
    for (const can::Party party : {can::Party::controller, can::Party::base}) {
      const bench::SeenNode& n = *bus_.survey().find(bus_.robot(), party);
      const std::string errors = hil::error_names(n.beat.errors);
      read += fmt::format("{} {}{}, ", party == can::Party::base ? "base" : "controller",
                          can::word_in<can::kNodeStateWords>(static_cast<int>(n.beat.state)),
                          errors.empty() ? "" : " (" + errors + ")");
      well = well && n.beat.state == can::NodeState::running && errors.empty();
    }
    const bench::SeenNode& n = *bus_.survey().find(bus_.robot(), can::Party::controller);
    read += fmt::format("firmware {}, boot {:04x}", version_text(n.version.value_or(0)), n.beat.boot);
    note("nodes", "both run, without an error", read, well);
  }

  void look(const bench::Ear& ear) {
    note("ticks", "none is missed", fmt::format("{} came, {} missed", ear.ticks(), ear.missed()),
         ear.missed() * 100 <= ear.ticks());
    const double expected = 0.75 * params_.rangefinders.rate_hz * ear.time_s();
    for (int i = 0; i < hal::kBeams; ++i) {
      note(fmt::format("range {}", bench::kSides[i]), fmt::format("measures {:.1f} s long", ear.time_s()),
           ear.measured(i), ear.without_proof(i) == 0 && ear.measurements(i) >= expected);
    }
  }

  void hand(int beam) {
    ask(fmt::format("hold a hand 5 to 20 cm before the {} sensor, then take it away", bench::kSides[beam]));
    bench::Ear ear(bus_.robot());
    bool away = false;
    const bool seen = hear(ear, o_.wait_s, [&] {
      away = away || ear.nearest(beam) <= -static_cast<int>(kHeld_ticks);
      return away && ear.nearest(beam) >= static_cast<int>(kHeld_ticks);
    });
    note(fmt::format("hand {}", bench::kSides[beam]), "is nearest before this sensor", ear.ranges(), seen);
  }

  void wheel(std::size_t wheel) {
    ask(fmt::format("turn the {} wheel forward by hand, a quarter turn", kWheels[wheel]));
    const double enough = kTurned_m * params_.wheels.counts_per_metre;
    bench::Ear ear(bus_.robot());
    hear(ear, o_.wait_s, [&] {
      const bool turned = std::abs(ear.turned()[0]) >= enough || std::abs(ear.turned()[1]) >= enough;
      return turned && ear.stood() >= kGlance_ticks;
    });
    const bool right = ear.turned()[wheel] >= enough && std::abs(ear.turned()[1 - wheel]) < enough / 4;
    note(fmt::format("wheel {}", kWheels[wheel]), "alone counts, and upwards",
         fmt::format("left {}, right {}", ear.turned()[0], ear.turned()[1]), right);
  }

  void rest() {
    ask("leave the robot alone");
    heard(kLook_ticks / 3);
    const bench::Ear ear = heard(kLook_ticks);
    const bool still = std::abs(ear.turned()[0]) <= kRestCounts && std::abs(ear.turned()[1]) <= kRestCounts;
    note("rest", "no wheel turns", fmt::format("left {}, right {}", ear.turned()[0], ear.turned()[1]), still);
    if (params_.gyro.fitted != Fitted::yes) return;
    const double unit = params_.gyro.range.raw() * 1e-6 / 32768 * 57.29578;
    const auto mean = ear.gyro_mean();
    note("gyro", "no turn", mean ? fmt::format("{:.2f} degrees a second", *mean * unit) : "no samples",
         mean && std::fabs(*mean * unit) <= kRestRate_dps);
  }

  bool agreed() {
    if (o_.yes) return true;
    ask(fmt::format(
        "now it turns on the spot and drives, to {} m ahead and on to {} m; it needs 2 m of free floor. "
        "Press Enter",
        kGoal_m, kFar_m));
    bool eof = false;
    const bool came = bus_.listen(BenchBus::kMost_s, [&] { return line_came(eof); });
    if (came && !eof) return true;
    note("drive", "is agreed to", "no", false);
    return false;
  }

  /// Where it stands is its origin again.
  void place() {
    client_->commit();
    heard(kLook_ticks);
  }

  static planning::Goal ahead(double metres) {
    return {{Length::from_raw(static_cast<std::int32_t>(metres * 1e6)), Length{}}, 100_mm};
  }

  void drive() {
    place();
    client_->drive_to(ahead(kGoal_m));
    std::optional<can::NavStatus> ended;
    while (!(ended = client_->ended()) && client_->time_s() < o_.wait_s) {
      if (bus_.interrupt().noted()) throw bench::Interrupted("interrupted");
      bus_.clock().wait_a_ms();
    }
    if (!ended) client_->cancel();
    const Fault fault = ended && ended->fault < kFaults ? static_cast<Fault>(ended->fault) : Fault::none;
    const bool reached = ended && ended->outcome == planning::Outcome::reached && fault == Fault::none;
    note("drive", fmt::format("to {} m ahead", kGoal_m),
         fmt::format("{} after {:.1f} s",
                     !ended ? "not there"
                     : fault != Fault::none
                         ? name(fault)
                         : can::word_in<can::kOutcomeWords>(static_cast<int>(ended->outcome)),
                     client_->time_s()),
         reached);
  }

  /// Repeats the order until the nodes have obeyed, and `over`.
  bool order(std::uint8_t command, bench::Ear& ear, const std::function<bool()>& over) {
    const std::pair<int, int> wanted{command == can::kStopCommand ? 2 : 0, 2};
    for (double waited = 0; waited < o_.bus.timeout_s; waited += BenchBus::kAgain_s) {
      bus_.order(command);
      if (hear(ear, BenchBus::kAgain_s, [&] { return bus_.stopped_of_all() == wanted && over(); }))
        return true;
    }
    return false;
  }

  void stop() {
    client_->drive_to(ahead(kFar_m));
    bench::Ear start(bus_.robot());
    const bool moves =
        hear(start, o_.wait_s, [&] { return metres(start.turned()[0] + start.turned()[1]) >= kSpeeds_up_m; });
    bench::Ear ear(bus_.robot());
    const bool stood = order(can::kStopCommand, ear, [&] { return ear.stood() >= kGlance_ticks; });
    const double time_s = ear.time_s() * (1 - static_cast<double>(ear.stood()) / ear.ticks());
    note("E-stop", "while it drives, ends in standstill",
         fmt::format("{}, {} after {:.2f} s, {}", moves ? "drove" : "did not drive",
                     stood ? "stands" : "does not stand", time_s, way(ear)),
         moves && stood && time_s <= kStands_s);
    bench::Ear after(bus_.robot());
    const bool cleared = order(can::kClearCommand, after, [&] { return after.ticks() >= kGlance_ticks; });
    note("clear", "ends the E-stop, and starts nothing",
         fmt::format("{}, {}", cleared ? "cleared" : "not cleared", way(after)),
         cleared && after.stood() + 1 >= after.ticks());
  }

  void write() {
    Json parameters = Json::object();
    for (const ParamEntry& e : param_list(params_)) parameters[e.key] = e.text();
    const Json json = {{"bus", bus_.name()},
                       {"passed", steps_.size() - static_cast<std::size_t>(failed_)},
                       {"failed", failed_},
                       {"steps", steps_},
                       {"parameters", parameters}};
    files::write(o_.file, with_provenance(json.dump(2), {}));
    fmt::print(told_, "{} of {} passed: {}\n", steps_.size() - static_cast<std::size_t>(failed_),
               steps_.size(), o_.file);
  }

  const SelftestOptions& o_;
  std::FILE* const told_;
  BenchBus bus_;
  std::unique_ptr<bench::OperatorClient> client_;
  Params params_;
  Json steps_ = Json::array();
  int failed_ = 0;
};

}  // namespace

void add_bench_selftest(CLI::App& bench, int& status) {
  CLI::App* cmd = bench.add_subcommand(
      "selftest", "Go through a check list with a robot on the floor, and write what it read into a file");
  const auto o = std::make_shared<SelftestOptions>();
  add_bench_bus(*cmd, o->bus);
  add_file(*cmd, "--out", o->file, "This file (JSON); selftest.json by default");
  amount(cmd->add_option("--wait", o->wait_s, "Wait so long for a hand and for a drive, s; 30 by default"),
         "S", 600);
  add_switch(*cmd, "--yes", o->yes, "Drive without asking");
  cmd->callback([o, &status] {
    status = bench_status([&] {
      check_outputs({o->file});
      return Selftest(*o).run();
    });
  });
}

}  // namespace whisker::cli
