/// The figures of docs/, and a response table for the playground.
#pragma once

#include <string>
#include <vector>

namespace whisker::cli {

struct FiguresOptions {
  std::string scenarios;  ///< empty: the built-in scenarios
  std::string out;        ///< a folder
};
/// Draws all of them and prints their names. Returns the exit status.
int draw_figures(const FiguresOptions& options);

/// Writes the core's response table of a rule base as JSON; out empty: to standard output. Returns the exit
/// status.
int write_table(const std::string& rules_file, const std::vector<std::string>& names, const std::string& out);

}  // namespace whisker::cli
