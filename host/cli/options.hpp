/// Options with strict values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/cli/cli11_forward.hpp"
#include "host/harness/run/planners.hpp"

namespace whisker::cli {

/// "; did you mean 'known'?" if one of these is similar to the word, else empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& known);

/// Decimal digits only, at most `most`: no sign, no exponent, no 0x. For Option::transform.
CLI::Validator whole_number(std::uint64_t most = INT64_MAX);

/// A number from 0 to `most`, in decimal. For Option::transform.
CLI::Validator amount(double most);

/// Each checks the values of the option and names their type in the help. Returns the option.
CLI::Option* whole_number(CLI::Option* option, const char* type, std::uint64_t most = INT64_MAX);
CLI::Option* how_many(CLI::Option* option, const char* type, std::uint64_t most);  ///< 0: nothing to do
CLI::Option* amount(CLI::Option* option, const char* type, double most);
CLI::Option* within(CLI::Option* option, const char* type, int low, int high);
CLI::Option* within(CLI::Option* option, const char* type, double low, double high);

/// --wheel-scale-sigma S, for worlds with noise.
CLI::Option* add_wheel_scale_sigma(CLI::App& app, std::optional<double>& sigma, const std::string& help);

/// --width W, for worlds with a gap.
CLI::Option* add_gap_width(CLI::App& app, std::optional<double>& width, const std::string& help);

/// A name; an empty one, for example from an unset shell variable, is refused.
CLI::Option* add_name(CLI::App& app, const std::string& option, std::string& name, const std::string& help);

/// A path, with the check of add_name.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::string& path, const std::string& help);

/// --planner, by name, with --map-bytes; the default is the value of `kind`.
CLI::Option* add_planner_kind(CLI::App& app, PlannerKind& kind);

/// The same with --rules. Sets the callback that CLI11 calls after parsing.
CLI::Option* add_planner(CLI::App& app, PlannerKind& kind);

/// A flag that takes no value.
CLI::Option* add_switch(CLI::App& app, const std::string& name, bool& on, const std::string& help);

}  // namespace whisker::cli
