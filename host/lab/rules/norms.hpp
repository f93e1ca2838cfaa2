/// Operators that join degrees of membership.
#pragma once

#include <algorithm>

namespace whisker::rules {

enum class And { minimum, product, bounded_difference, drastic, einstein, hamacher, nilpotent };
enum class Or { maximum, probabilistic_sum, bounded_sum, sum, drastic, einstein, hamacher, nilpotent };

inline double join(And norm, double a, double b) {
  switch (norm) {
    case And::minimum: return std::min(a, b);
    case And::product: return a * b;
    case And::bounded_difference: return std::max(0.0, a + b - 1);
    case And::drastic: return std::max(a, b) >= 1 ? std::min(a, b) : 0;
    case And::einstein: return a * b / (2 - (a + b - a * b));
    case And::hamacher: return a + b - a * b != 0 ? a * b / (a + b - a * b) : 0;
    case And::nilpotent: return a + b > 1 ? std::min(a, b) : 0;
  }
  return 0;
}

inline double join(Or norm, double a, double b) {
  switch (norm) {
    case Or::maximum: return std::max(a, b);
    case Or::probabilistic_sum: return a + b - a * b;
    case Or::bounded_sum: return std::min(1.0, a + b);
    case Or::sum: return a + b;
    case Or::drastic: return std::min(a, b) <= 0 ? std::max(a, b) : 1;
    case Or::einstein: return (a + b) / (1 + a * b);
    // As (a + b - 2ab) / (1 - ab), but stable where a and b approach 1.
    case Or::hamacher: return a * b < 1 ? 1 - (1 - a) * (1 - b) / (1 - a * b) : 1;
    case Or::nilpotent: return a + b < 1 ? std::max(a, b) : 1;
  }
  return 0;
}

}  // namespace whisker::rules
