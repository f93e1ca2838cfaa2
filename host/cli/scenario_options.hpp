/// Options of the commands that run one scenario.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>

#include "host/cli/cli11_forward.hpp"
#include "host/cli/one_run.hpp"

namespace whisker::cli {

struct ScenarioChoice {
  std::string file;
  std::string robot;
  std::optional<std::uint64_t> seed;
  RunOutputs outputs;

  /// Checks all outputs, then reads the files. Throws UsageError and InputError.
  Scenario load(std::initializer_list<std::string> more_outputs = {}) const;
  RunOptions run_options() const;
  /// scenario: the result of load().
  RunOutputs run_outputs(const Scenario& scenario) const;
};

/// SCENARIO, --robot, --seed, --trace, --svg, --html and --json.
void add_scenario(CLI::App& app, ScenarioChoice& choice);

}  // namespace whisker::cli
