/// What a JSON object says of how it came about.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/params.hpp"

namespace whisker::cli {

/// Of the objects that --json prints: grows when a key changes its meaning. New keys leave it.
constexpr int kSchema = 1;

/// What is not known becomes null.
struct Provenance {
  std::optional<std::uint64_t> seed;
  std::optional<std::string> planner;
  std::optional<std::string> robot_name;
  std::optional<std::string> robot_digest;
};

/// 16 hex digits: FNV-1a 64 over each parameter's key and raw value. Equal for equal robots.
std::string robot_digest(const Params& params);
/// The robot file; without one "reference" for the reference robot, else the scenario's file.
std::string robot_name(const Params& params, const std::string& robot_file, const std::string& scenario_file);

/// The JSON object with the keys schema, version, seed, planner, robot_name and robot_digest behind its own.
std::string with_provenance(const std::string& json_object, const Provenance& provenance);

}  // namespace whisker::cli
