/// The error of a table at every representable input.
#pragma once

#include <cstdint>
#include <vector>

#include "host/lab/rules/table.hpp"

namespace whisker::rules {

/// Of one output, in its units; the reference is the exact answer in double precision.
struct Error {
  double greatest = 0;
  std::int32_t at[2] = {0, 0};  ///< raw inputs where it is attained
  double rms = 0;               ///< over every representable input
};

/// Greatest less least exact answer of an output.
double span_of(const std::vector<double>& values);

/// Stops, with false, at an error above share * span of its output.
bool measure(const Surface& surface, const Table& table, const std::vector<double>& spans, double share,
             std::vector<Error>& out);

}  // namespace whisker::rules
