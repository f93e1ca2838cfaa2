/// The worlds of a campaign: generated ones, or the scenario files of a folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/harness/scenario/scenario.hpp"
#include "host/harness/worlds/generate.hpp"

namespace whisker::campaign {

/// Mission i is `whisker world KIND --seed (first_seed + i)`, then `whisker run`.
struct Generated {
  worlds::Kind kind = worlds::Kind::discs;
  worlds::Options options;  ///< its seed is not used
  std::uint64_t first_seed = 1;
  bool random_robots = false;  ///< each seed has a robot of its own, in a world of its size
};

/// Mission i is file i modulo their number; the seed of its noise is first_seed + i, or the file's own.
struct Files {
  std::vector<std::string> names;
  std::vector<Scenario> scenarios;  ///< the same number
  std::optional<std::uint64_t> first_seed;
};

bool is_scenario_file(std::string_view name);  ///< it ends in .toml

bool has_control_characters(std::string_view text);  ///< a row holds none

/// The arguments of `whisker world` that generate these worlds, without the seed: "discs --discs 20 --noise".
std::string arguments(worlds::Kind kind, const worlds::Options& options);

/// Follows the arguments in the name of a world for random robots.
constexpr std::string_view kRandomRobots = " --robots random";
bool has_random_robots(std::string_view world);
/// Follows the arguments in the name of a world that is scaled to the robot of a file.
constexpr std::string_view kToSize = " --to-size";
/// "random 7": the robot that this seed draws, which `whisker campaign KIND --robots random --replay 7`
/// drives.
std::string random_robot_name(std::uint64_t seed);

/// Every *.toml of the folder in order of name, with the robot of load_scenario(). Throws InputError for an
/// invalid one, std::invalid_argument if there is none or a name contains control characters.
Files load_folder(const std::string& folder, const std::string& robot_file = {});

struct Mission {
  std::uint64_t seed = 0;
  std::string world;  ///< as in Row
  Scenario scenario;  ///< with this seed
};

/// Throws what worlds::generate throws.
Mission mission(const Generated& worlds, std::uint64_t index);
Mission mission(const Files& worlds, std::uint64_t index);

}  // namespace whisker::campaign
