/// Exact answers at every representable input.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/lab/rules/axis.hpp"
#include "host/lab/rules/inference.hpp"

namespace whisker::rules {

/// An input that the user holds at one value.
struct Fixed {
  std::size_t input;
  double value;
};

/// One or two axes. Beyond [from, to], the rules see no difference, so the surface covers only this part.
struct Domain {
  struct Part {
    Axis axis;
    std::int32_t from = 0;
    std::int32_t to = 0;
    std::int32_t count() const { return to - from + 1; }
    /// Number of raw inputs that give the same answers as the i-th of the part.
    double multiplicity(std::int32_t i) const;
  };
  std::vector<Part> parts;
  std::vector<double> inputs;  ///< value of every input; those of the axes are overwritten

  std::int32_t rows() const { return parts[0].count(); }
  std::int32_t columns() const { return parts.size() > 1 ? parts[1].count() : 1; }
};

struct Surface {
  Domain domain;
  std::vector<std::vector<double>> values;  ///< [output][row * columns + column]
  std::vector<std::vector<char>> silent;    ///< 1: no rule fires for the output
  std::vector<bool> fired;                  ///< by rule: somewhere
  double inputs = 0;                        ///< number of representable inputs
};

/// Throws InputError if the number of free inputs is neither one nor two, or a resolution does not fit.
Domain make_domain(const RuleBase& base, const Inference& inference, const std::vector<Fixed>& fixed,
                   int fewest_steps);

/// Evaluates on all processors.
Surface make_surface(const RuleBase& base, const Inference& inference, const Domain& domain);

}  // namespace whisker::rules
