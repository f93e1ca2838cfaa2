#include "tests/view/watched.hpp"

namespace whisker::view::testing {

Scenario short_run() {
  Scenario s;
  s.name = "short";
  s.goal.at = {1, 0.3};
  s.discs = {{{0.5, 0.2}, 0.05}};
  s.time_limit_s = 20;
  return s;
}

RunResult drive(const Scenario& scenario, Feed& feed, const std::function<void(const Moment&)>& each) {
  feed.begin(setting(scenario));
  RunOptions options;
  options.planner = *setting(scenario).planner;
  options.watch = [&](const Moment& moment) {
    feed.add(moment);
    if (each) each(moment);
  };
  const RunResult result = run(scenario, options);
  feed.end(result);
  return result;
}

}  // namespace whisker::view::testing
