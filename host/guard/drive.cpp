#include "host/guard/drive.hpp"

#include <cmath>
#include <memory>

#include "host/guard/guarded_body.hpp"
#include "host/run/sim_world.hpp"

namespace whisker::guard {
namespace {

Wiring wiring_of(const Scenario& scenario, const Options& options) {
  return {options.guarded, scenario.robot.guard, options.vouched_m, options.table};
}

class Drive {
 public:
  Drive(const Scenario& scenario, Operator& hand, const Options& options)
      : scenario_(scenario),
        hand_(hand),
        options_(options),
        period_ms_(static_cast<int>(scenario.robot.safety.period.raw())),
        world_(scenario_),
        body_(scenario_, world_.view(), wiring_of(scenario, options), options.gap_ms != nullptr),
        next_s_(hand.first_s()) {}

  Result run() {
    while (plant_.time() < options_.time_s && !over()) {
      ask();
      tick();
      body_.pass(options_.gap_ms ? options_.gap_ms() : period_ms_);
    }
    result_.end = ended();
    result_.time_s = plant_.in_contact() ? plant_.contact_time() : plant_.time();
    result_.path_m = plant_.path_length();
    result_.min_clearance_m = plant_.min_clearance();
    result_.final_distance_m = distance();
    if (options_.guarded) result_.hash = body_.hash();
    if (asked_ > 0) result_.granted = granted_ / asked_;
    return result_;
  }

 private:
  double distance() const {
    const sim::Vec2 to = scenario_.goal.at - plant_.pose().at;
    return std::hypot(to.x, to.y);
  }
  bool at_goal() const { return options_.until_goal && distance() <= scenario_.goal.tolerance_m; }
  /// A fault ends the drive once the body stands.
  bool over() const {
    return plant_.in_contact() || at_goal() || (options_.ended && options_.ended()) ||
           (body_.faulted() && body_.stands());
  }
  End ended() {
    if (plant_.in_contact()) return End::contact;
    if (body_.faulted()) {
      result_.fault = body_.status().health.fault;
      return End::fault;
    }
    if (at_goal()) return End::arrived;
    return options_.ended && options_.ended() ? End::ended : End::time;
  }

  void ask() {
    if (plant_.time() < next_s_) return;
    body_.command(hand_.ask({plant_.pose(), plant_.time()}));
    next_s_ = plant_.time() + hand_.pause_s();
  }

  void tick() {
    const Moment moment = body_.tick();
    if (moment.status != nullptr) count(*moment.status);
    ++result_.ticks;
    if (options_.watch) options_.watch(moment);
  }

  void count(const GuardStatus& status) {
    ++result_.reasons[static_cast<std::size_t>(status.reason)];
    if (status.asked.forward == Speed{}) return;
    asked_ += 1;
    granted_ += status.forward.raw() / 16384.0;
    const bool held = status.forward == Q14{};
    if (held && !held_) ++result_.stops;
    held_ = held;
  }

  const Scenario& scenario_;
  Operator& hand_;
  const Options& options_;
  int period_ms_;
  SimWorld world_;
  GuardedBody body_;
  const sim::Plant& plant_ = body_.plant();
  Result result_;
  double next_s_ = 0;
  double asked_ = 0, granted_ = 0;
  bool held_ = false;
};

}  // namespace

const char* name(End end) {
  switch (end) {
    case End::arrived: return "arrived";
    case End::contact: return "contact";
    case End::fault: return "fault";
    case End::time: return "time";
    case End::ended: return "ended";
  }
  return "?";
}

Result drive(const Scenario& scenario, Operator& hand, const Options& options) {
  const auto drive = std::make_unique<Drive>(scenario, hand, options);
  return drive->run();
}

}  // namespace whisker::guard
