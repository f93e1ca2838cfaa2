/// What `whisker rules search` prints and writes.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/table_search.hpp"

namespace whisker::cli {

struct SearchNames {
  std::string base;                 ///< a file, or "default"
  std::vector<std::string> worlds;  ///< of the plan's classes: "discs --discs 75 --box"
  std::string drives;               ///< "planner map", or "sloppy operator with assist"
};

void print_generation(std::FILE* out, const Generation& g);
void print_validation(std::FILE* out, const SearchPlan& plan, const SearchNames& names, const Validation& v);

/// The best rules as a file; its first lines say how they were found.
std::string searched_file(const SearchPlan& plan, const SearchNames& names, const TableSearch& search,
                          const std::optional<Validation>& v);

/// One object, without provenance. No validation: no child was kept.
std::string search_json(const SearchPlan& plan, const SearchNames& names, const TableSearch& search,
                        const std::optional<Validation>& v);

}  // namespace whisker::cli
