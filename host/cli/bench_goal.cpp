#include "host/cli/bench_goal.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "host/cli/exit_status.hpp"
#include "host/cli/provenance.hpp"
#include "host/hil/overheard.hpp"
#include "host/report/result.hpp"
#include "host/run/make_record.hpp"

namespace whisker::cli {
namespace {

void print(Verdict verdict, const std::string& detail, double time_s, bool json) {
  if (json) {
    const nlohmann::ordered_json result = {
        {"outcome", report::outcome(verdict)}, {"detail", detail}, {"time_s", time_s}};
    fmt::print("{}\n", with_provenance(result.dump(), {}));
  } else {
    fmt::print("{} ({}) by its own estimate, after {:.1f} s\n", report::outcome(verdict), detail, time_s);
  }
}

}  // namespace

int drive_through(BenchBus& bus, const planning::Goal& goal, double for_s, bool json) {
  const auto client = bus.third_party();
  client->drive_to(goal);
  fmt::print(stderr, "robot {} on {}: drives\n", bus.robot(), bus.name());
  std::optional<can::NavStatus> told;
  while (!(told = client->ended())) {
    const bool interrupted = bus.interrupt().noted();
    if (interrupted || client->time_s() >= for_s) {
      client->cancel();
      if (interrupted) throw bench::Interrupted("interrupted");
      print(Verdict::gave_up, "time_limit", client->time_s(), json);
      return exit_status(Verdict::gave_up);
    }
    bus.clock().wait_a_ms();
  }
  const Status status = hil::status_of(*told);
  if (status.health.fault != Fault::none) {
    print(Verdict::fault, name(status.health.fault), client->time_s(), json);
    return exit_status(Verdict::fault);
  }
  const auto verdict = verdict_of(status.decision.outcome);
  if (!verdict) throw bench::NoAnswer("the goal was cancelled");
  print(*verdict, planning::name(status.decision.why), client->time_s(), json);
  return exit_status(*verdict);
}

}  // namespace whisker::cli
