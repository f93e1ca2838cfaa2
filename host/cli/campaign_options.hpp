#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "host/cli/cli11_forward.hpp"
#include "host/harness/run/planners.hpp"
#include "host/lab/campaign/row.hpp"
#include "host/lab/campaign/worlds.hpp"

namespace whisker::cli {

struct CampaignOptions {
  bool scanner = false;
  std::string worlds;  ///< KIND or DIR
  std::optional<std::uint64_t> count;
  std::optional<std::uint64_t> seed;
  worlds::Options world;
  PlannerKind planner = kDefaultPlanner;
  std::string robot;
  std::string robots;    ///< "random", or empty
  bool to_size = false;  ///< the worlds are scaled to the robot
  int jobs = 0;          ///< 0: one per core
  std::string shard;
  std::string csv;
  bool overwrite = false;     ///< the file of csv
  bool incomplete = false;    ///< merge
  std::string save_failures;  ///< folder
  bool json = false;
  std::vector<std::string> merge;
  std::optional<std::uint64_t> replay;
  std::string svg;
  std::string html;
  std::string trace;
};

/// Range of missions: from first up to, but not including, last.
struct Missions {
  std::variant<campaign::Generated, campaign::Files> worlds;
  PlannerKind planner = kDefaultPlanner;
  std::string robot;
  bool to_size = false;  ///< each world is scaled to the robot
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t all = 0;  ///< of the whole campaign
};

/// The worlds under this name, --count, --seed, --discs, --width and --box; `each` names the counted items in
/// the help. Returns the first option.
CLI::Option* add_worlds(CLI::App& app, CampaignOptions& options, const std::string& each,
                        const std::string& name = "KIND|DIR");
/// --jobs.
void add_jobs(CLI::App& app, CampaignOptions& options);

/// Throws UsageError if the options do not fit together, InputError for an invalid scenario file.
Missions missions(const CampaignOptions& options);

/// Every mission has a random robot.
bool has_random_robots(const Missions& missions);
/// Every world is scaled to its robot.
bool has_worlds_of_size(const Missions& missions);

/// The mission's scenario with the robot's parameters. Throws InputError if they do not fit.
campaign::Mission mission(const Missions& missions, std::uint64_t index);

/// Calls `work` with each number below `count`, on `jobs` threads (0: one per core), with a progress line. It
/// must not throw. Returns how many of them are done, the first ones: fewer than `count` if interrupted.
std::uint64_t in_parallel(std::uint64_t count, int jobs, const std::function<void(std::uint64_t)>& work);

/// Seeds from `seed` on, one for each of `count`. Throws UsageError for none, or if one does not fit 63 bits.
void check_seeds(std::uint64_t count, std::uint64_t seed);

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
