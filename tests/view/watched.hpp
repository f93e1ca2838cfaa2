/// Runs for the tests of the live view.
#pragma once

#include <functional>

#include "host/harness/run/runner.hpp"
#include "host/lab/page/page.hpp"
#include "host/lab/view/feed.hpp"

namespace whisker::view::testing {

/// Some seconds to the goal, around a disc.
Scenario short_run();

inline RunSetting setting(const Scenario& scenario) { return {scenario, PlannerKind::boundary, 7}; }

/// Begins, drives and ends a run; calls `each` after every tick.
RunResult drive(const Scenario& scenario, Feed& feed, const std::function<void(const Moment&)>& each = {});

}  // namespace whisker::view::testing
