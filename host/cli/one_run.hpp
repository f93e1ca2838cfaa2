#pragma once

#include <functional>
#include <string>

#include "host/run/runner.hpp"

namespace whisker::cli {

struct RunOutputs {
  std::string trace;  ///< file, "" for none
  std::string svg;    ///< file, "" for none
  std::string html;   ///< file, "" for none
  bool json = false;  ///< on standard output, instead of words
  /// Set for a run on a bus: what it cost, as one JSON object, and as words for the progress line and the
  /// end.
  std::function<std::string()> bus_json = nullptr;
  std::function<std::string()> bus_words = nullptr;
};

/// Drives one scenario with a progress line, writes what is asked for and prints the result.
/// Returns the exit status that tells the verdict.
int drive_one(const Scenario& scenario, RunOptions options, const RunOutputs& outputs);

}  // namespace whisker::cli
