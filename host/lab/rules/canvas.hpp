/// The sets of an output, cut into cells in which every set is one monotone polynomial.
#pragma once

#include <cstddef>
#include <vector>

#include "host/lab/rules/membership.hpp"
#include "host/lab/rules/polynomial.hpp"

namespace whisker::rules {

/// A set over one cell; t runs from 0 to 1.
struct CellSet {
  Polynomial p;
  double low = 0;  ///< least and greatest value
  double high = 0;
  double area = 0;  ///< integrals of p and t p over the cell
  double moment = 0;
};

struct Cell {
  double start = 0;
  double width = 0;
  std::vector<CellSet> sets;  ///< one for each set of the canvas
};

class Canvas {
 public:
  struct Set {
    Membership membership;
    bool negated = false;
  };

  /// Polylines and S, Z and pi curves are exact, others within 1e-13; `relative`: within 1e-13 of their own
  /// greatest value in the cell, for weak rules. `crossings`: also cut where two sets cross, so that within a
  /// cell the larger one stays the larger.
  Canvas(const std::vector<Set>& sets, double low, double high, bool crossings, bool relative);

  /// All sets are polynomials by definition.
  static bool exact(const std::vector<Set>& sets);

  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::vector<Cell> cells_;
};

}  // namespace whisker::rules
