/// The smallest table for a tolerance, or the best within a size.
#pragma once

#include <optional>
#include <vector>

#include "host/lab/rules/measure.hpp"
#include "host/lab/rules/symmetry.hpp"

namespace whisker::rules {

struct Demand {
  double tolerance = 0.01;                ///< share of each output's span
  std::optional<std::size_t> most_bytes;  ///< then the best table within it, whatever the tolerance
  std::vector<std::int32_t> nodes;        ///< then the table with exactly these nodes
};

struct Found {
  Table table;
  std::vector<Error> errors;
};

/// None if no grid satisfies the demand. Where an output is exactly symmetric in an input, only grids that
/// keep the symmetry are considered.
std::optional<Found> search(const Surface& surface, const std::vector<OutputScale>& scales,
                            const std::vector<double>& spans, const std::vector<Symmetry>& symmetries,
                            const Demand& demand);

}  // namespace whisker::rules
