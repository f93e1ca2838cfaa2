#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "host/campaign/row.hpp"
#include "host/cli/campaign_options.hpp"

namespace whisker::cli {

/// Makes `count` rows on `jobs` threads (0: one per core), with a progress line on a terminal. `take`
/// receives each row in order. See campaign::Work. False: interrupted before the end.
bool make_many(std::uint64_t count, int jobs,
               const std::function<campaign::Row(std::uint64_t piece, const std::atomic<bool>& stop)>& make,
               const std::function<void(const campaign::Row&)>& take);

/// Runs the missions on `jobs` threads (0: one per core), with a progress line. `take` receives each row in
/// order, with the names of robot and world. `drive` may be called on several threads at once; it may throw
/// campaign::Stopped once `stop` is true. False: interrupted before the end.
bool drive_many(const Missions& missions, int jobs,
                const std::function<campaign::Row(const Scenario&, const std::atomic<bool>& stop)>& drive,
                const std::function<void(const campaign::Row&)>& take);

}  // namespace whisker::cli
