#include "host/lab/hunt/shrink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "host/harness/scenario/param_list.hpp"
#include "host/lab/hunt/crew.hpp"
#include "host/lab/hunt/premise.hpp"
#include "host/lab/hunt/trial.hpp"
#include "host/lab/hunt/worlds.hpp"

namespace whisker::hunt {
namespace {

using Clock = std::chrono::steady_clock;

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

class Shrinker {
 public:
  Shrinker(const Case& c, const Fails& fails, const Effort& effort)
      : best_(c), fails_(fails), drives_(effort.drives), until_(Clock::now() + seconds(effort.seconds)) {}

  Case run() {
    std::size_t before = 0;
    do {
      before = successes_;
      simplify();
      drop_some(&Scenario::events);
      drop_some(&Scenario::discs);
      drop_some(&Scenario::walls);
      drop_some(&Scenario::polygons);
      drop_commands();
      reset_keys();
    } while (successes_ > before && may_try());
    return best_;
  }

 private:
  bool may_try() const { return drives_ > 0 && Clock::now() < until_; }

  /// Keeps the change if the case still fails.
  template <class Change>
  bool attempt(const Change& change) {
    if (!may_try()) return false;
    Case other = best_;
    change(other);
    if (!holds_premise(other.scenario)) return false;
    --drives_;
    if (!fails_(other)) return false;
    best_ = std::move(other);
    ++successes_;
    return true;
  }

  void simplify() {
    if (best_.gaps != 0) attempt([](Case& c) { c.gaps = 0; });
    if (best_.scenario.bounds) attempt([](Case& c) { c.scenario.bounds.reset(); });
    const Noise& n = best_.scenario.noise;
    if (n.range_dropout != 0 || n.fix_every_m != 0 || n.motor_lag_shorter != 0) {
      attempt([](Case& c) { c.scenario.noise = {}; });
    }
    if (n.motor_lag_shorter != 0) attempt([](Case& c) { c.scenario.noise.motor_lag_shorter = 0; });
    if (n.fix_sigma_m != 0) attempt([](Case& c) { c.scenario.noise.fix_sigma_m = 0; });
    if (n.fix_sigma_deg != 0) attempt([](Case& c) { c.scenario.noise.fix_sigma_deg = 0; });
    const sim::Vec2 at = best_.scenario.start.at;
    if (at.x != 0 || at.y != 0) attempt([at](Case& c) { shift(c.scenario, {-at.x, -at.y}); });
    const Sensor& sensor = best_.scenario.sensor;
    if (sensor.cone_deg || sensor.min_range_m || sensor.max_range_m) {
      attempt([](Case& c) {
        c.scenario.sensor.cone_deg.reset();
        c.scenario.sensor.min_range_m.reset();
        c.scenario.sensor.max_range_m.reset();
        c.scenario.sensor.far_is = Far::clear;
      });
    }
  }

  /// Removes blocks of a list, from all of it down to single items.
  template <class Items>
  void drop_blocks(const Items& items) {
    for (std::size_t block = items(best_).size(); block > 0; block /= 2) {
      for (std::size_t first = 0; first < items(best_).size() && may_try();) {
        const bool dropped = attempt([&](Case& c) {
          auto& list = items(c);
          const std::size_t last = std::min(list.size(), first + block);
          list.erase(list.begin() + static_cast<std::ptrdiff_t>(first),
                     list.begin() + static_cast<std::ptrdiff_t>(last));
        });
        if (!dropped) first += block;
      }
    }
  }

  template <class Shapes>
  void drop_some(Shapes Scenario::*shapes) {
    drop_blocks([shapes](auto& c) -> auto& { return c.scenario.*shapes; });
  }

  /// An empty list would stand for another operator.
  void drop_commands() {
    if (best_.planner || best_.commands.empty()) return;
    for (std::size_t block = best_.commands.size() / 2; block > 0; block /= 2) {
      for (std::size_t first = 0; first < best_.commands.size() && may_try();) {
        const bool dropped =
            best_.commands.size() > block && attempt([&](Case& c) {
              const auto from = c.commands.begin() + static_cast<std::ptrdiff_t>(first);
              const auto left = static_cast<std::size_t>(c.commands.end() - from);
              c.commands.erase(from, from + static_cast<std::ptrdiff_t>(std::min(block, left)));
            });
        if (!dropped) first += block;
      }
    }
  }

  void reset_keys() {
    const std::vector<ParamEntry> usual = param_list(Params{});
    for (std::size_t i = 0; i < usual.size() && may_try(); ++i) {
      const std::int64_t raw = param_list(best_.scenario.robot)[i].raw;
      if (raw == usual[i].raw) continue;
      attempt([&](Case& c) { set_param(c.scenario.robot, i, usual[i].raw); });
    }
  }

  Case best_;
  const Fails& fails_;
  int drives_;
  Clock::time_point until_;
  std::size_t successes_ = 0;
};

}  // namespace

std::string finding_of(Case& c) {
  const Ended ended = isolated([&c](const Say& say) {
    const Outcome outcome = attempt(c);
    say(fmt::format("{}\n", outcome.finding));
    if (!c.planner) say(commands_csv(c.commands));
  });
  if (!ended.death.empty()) return fmt::format("crash {}", ended.death);
  const std::size_t end = ended.text.find('\n');
  if (!c.planner && c.commands.empty()) c.commands = parse_commands(ended.text.substr(end + 1));
  return ended.text.substr(0, end);
}

Case shrunk(const Case& c, const Fails& fails, const Effort& effort) {
  return Shrinker(c, fails, effort).run();
}

}  // namespace whisker::hunt
