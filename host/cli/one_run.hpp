#pragma once

#include <functional>
#include <string>

#include "host/page/page.hpp"
#include "host/run/runner.hpp"

namespace whisker::cli {

struct RunOutputs {
  std::string trace;  ///< file, "" for none
  std::string svg;    ///< file, "" for none
  std::string html;   ///< file, "" for none
  bool json = false;  ///< on standard output, instead of words
  std::string robot_name = "reference";
  std::string record = "";  ///< where the frames of a bus go, "" for nowhere
  /// Set for a run on a bus: what it cost, as one JSON object, and as words for the progress line and the
  /// end.
  std::function<std::string()> bus_json = nullptr;
  std::function<std::string()> bus_words = nullptr;
  bool knows_planner = true;                              ///< false: whoever drives has not said which
  std::function<void(const RunResult&)> ended = nullptr;  ///< gets the verdict first of all

  bool on_bus() const { return bus_json != nullptr; }
};

/// What a page says of the run before its first tick.
page::Setting setting(const Scenario& scenario, const RunOptions& options, const RunOutputs& outputs);

/// Drives one scenario with a progress line, writes what is asked for and prints the result.
/// Returns the exit status that tells the verdict.
int drive_one(const Scenario& scenario, RunOptions options, const RunOutputs& outputs);

}  // namespace whisker::cli
