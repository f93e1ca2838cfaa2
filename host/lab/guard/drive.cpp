#include "host/lab/guard/drive.hpp"

#include <cmath>
#include <memory>

#include "host/harness/run/sim_world.hpp"
#include "host/lab/guard/guarded_body.hpp"

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
        next_s_(hand.first_s()),
        events_(scenario.events),
        goal_(scenario.goal) {}

  Result run() {
    for (;;) {
      if (!events_.empty()) play();
      if (plant_.time() >= options_.time_s || over()) break;
      ask();
      tick();
      body_.pass(options_.gap_ms ? options_.gap_ms() : period_ms_);
    }
    result_.end = ended();
    result_.time_s = plant_.in_contact() ? plant_.contact_time() : plant_.time();
    result_.path_m = plant_.path_length();
    if (!events_.empty()) result_.events = events_.counted();
    result_.min_clearance_m = plant_.min_clearance();
    result_.final_distance_m = distance();
    if (options_.guarded) result_.hash = body_.hash();
    if (asked_ > 0) result_.granted = granted_ / asked_;
    return result_;
  }

 private:
  double distance() const {
    const sim::Vec2 to = goal_.at - plant_.pose().at;
    return std::hypot(to.x, to.y);
  }
  bool at_goal() const { return options_.until_goal && distance() <= goal_.tolerance_m; }
  /// A fault ends the drive once the body stands, unless an event will end the fault; and the goal, unless
  /// there will be another one.
  bool over() const {
    const auto to_come = [&](std::initializer_list<EventKind> kinds) {
      return events_.to_come(kinds, options_.time_s);
    };
    return plant_.in_contact() || (options_.ended && options_.ended()) ||
           (at_goal() && !to_come({EventKind::goal})) ||
           (body_.faulted() && body_.stands() && body_.hears() &&
            !to_come({EventKind::reset, EventKind::restart}));
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

  void play() {
    while (body_.hears()) {
      const Event* const event = events_.next(plant_.time());
      if (event == nullptr) return;
      events_.count(body_.play(*event));
      if (event->kind == EventKind::goal) goal_ = event->goal;
    }
  }

  /// A command does not arrive while frames are lost.
  void ask() {
    if (plant_.time() < next_s_) return;
    const Twist twist = hand_.ask({plant_.pose(), plant_.time()});
    if (body_.hears()) body_.command(twist);
    next_s_ = plant_.time() + hand_.pause_s();
  }

  void tick() {
    const Moment moment = body_.tick();
    if (moment.status != nullptr && body_.hears()) count(*moment.status);
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
  EventPlayer events_;
  Goal goal_;
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
