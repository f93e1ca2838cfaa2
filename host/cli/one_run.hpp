#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>

#include "host/cli/cli11_forward.hpp"
#include "host/harness/run/runner.hpp"
#include "host/lab/page/page.hpp"

namespace whisker::cli {

struct RunOutputs {
  std::string trace;  ///< file, "" for none
  std::string svg;    ///< file, "" for none
  std::string html;   ///< file, "" for none
  bool json = false;  ///< on standard output, instead of text
  std::string robot_name = "reference";
  std::string record = "";  ///< output of the frames of a bus, "" for none
  /// Set for a run on a bus: its figures, as one JSON object, and as text for the progress line and the end.
  std::function<std::string()> bus_json = nullptr;
  std::function<std::string()> bus_words = nullptr;
  bool knows_planner = true;                              ///< false: unknown
  bool inside = true;                                     ///< of its log
  std::function<void(const RunResult&)> ended = nullptr;  ///< receives the verdict first
};

/// What the log of the run knows before its first tick.
RunSetting setting(const Scenario& scenario, const RunOptions& options, const RunOutputs& outputs);

/// Runs one scenario with a progress line, writes the requested outputs and prints the result. Returns the
/// exit status of the verdict.
int drive_one(const Scenario& scenario, RunOptions options, const RunOutputs& outputs);

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
