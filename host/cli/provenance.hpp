/// Origin of a JSON object.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/params.hpp"

namespace whisker::cli {

/// "0.1.0 (1b98848)": the version and the built commit, with "-dirty" if files differ from it; "unknown" if
/// the sources are not in a git repository.
std::string version();

/// Version of the objects of --json: increases when a key changes its meaning, not for new keys.
constexpr int kSchema = 1;

/// Unknown values become null.
struct Provenance {
  std::optional<std::uint64_t> seed = std::nullopt;
  std::optional<std::string> planner = std::nullopt;
  std::optional<std::string> robot_name = std::nullopt;
  std::optional<std::string> robot_digest = std::nullopt;
  std::optional<std::string> rules_digest = std::nullopt;  ///< of the planner's response table
};

/// 16 hex digits: FNV-1a 64 over the key and raw value of each parameter. Equal for equal robots.
std::string robot_digest(const Params& params);
/// The robot file; without one, "reference" for the reference robot, else the scenario file.
std::string robot_name(const Params& params, const std::string& robot_file, const std::string& scenario_file);

/// The JSON object with the keys schema, version, seed, planner, robot_name, robot_digest and rules_digest
/// appended.
std::string with_provenance(const std::string& json_object, const Provenance& provenance);
/// Prints that as a line.
void print_object(const std::string& json_object, const Provenance& provenance = {});

}  // namespace whisker::cli
