/// The fuzzy set that the fired rules make of an output.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "host/lab/rules/canvas.hpp"
#include "host/lab/rules/norms.hpp"
#include "host/lab/rules/rule_base.hpp"

namespace whisker::rules {

/// A set of the canvas cut at, or multiplied by, the strength of a rule.
struct Activated {
  std::size_t set = 0;
  bool product = false;  ///< of the implication; else minimum
  double strength = 0;   ///< above zero
  double times = 1;      ///< equal ones that a sum counts
};

/// factor * p from t = a to t = b of a cell.
struct Piece {
  const Cell* cell;
  double a;
  double b;
  const Polynomial* p;
  double factor;
};

struct Moments {
  double area = 0;
  double moment = 0;
};

/// Area and first moment of the aggregated set.
Moments moments(const Canvas& canvas, Or aggregation, const std::vector<Activated>& activated);

/// The aggregated set, piece by piece in ascending order.
void visit_pieces(const Canvas& canvas, Or aggregation, const std::vector<Activated>& activated,
                  const std::function<void(const Piece&)>& visit);

/// Every defuzzifier of a set. False, and `out` unchanged, if the set is empty.
bool defuzzify(const Canvas& canvas, Or aggregation, Defuzzifier defuzzifier,
               const std::vector<Activated>& activated, double& out);

}  // namespace whisker::rules
