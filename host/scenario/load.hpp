/// Reads scenario and robot files, strictly: whatever is not in docs/scenario.md is an InputError.
#pragma once

#include <string>
#include <string_view>

#include "host/scenario/error.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker {

/// Files of at most 16 MiB, UTF-8.
Scenario load_scenario(const std::string& file);
/// `name` stands for the file in messages.
Scenario parse_scenario(std::string_view text, const std::string& name);

/// Sets the parameters that a robot file names (at its top level, or in [robot]) and leaves the others.
/// On an error the parameters are untouched.
void apply_robot_file(Params& params, const std::string& file);
/// The same for a scenario's robot; also throws if the new body is in contact at the start.
void apply_robot_file(Scenario& scenario, const std::string& file);

}  // namespace whisker
