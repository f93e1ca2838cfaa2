/// Polynomials over [0, 1]: pieces of fuzzy sets.
#pragma once

#include <functional>
#include <vector>

namespace whisker::rules {

struct Polynomial {
  static constexpr int kMostDegree = 11;
  int degree = 0;
  double c[kMostDegree + 1] = {};  ///< by ascending power

  double operator()(double t) const {
    double sum = c[degree];
    for (int i = degree - 1; i >= 0; --i) sum = sum * t + c[i];
    return sum;
  }
  Polynomial derivative() const;
  Polynomial antiderivative() const;  ///< 0 at 0; of a degree below kMostDegree
  /// Integrals of p and t p from a to b.
  double area(double a, double b) const;
  double moment(double a, double b) const;
  /// No coefficient but the first exceeds 1e-13.
  bool is_constant() const;
};

Polynomial constant(double value);
Polynomial scaled(const Polynomial& p, double factor);
Polynomial sum(const Polynomial& a, const Polynomial& b, double factor_of_b);
/// The degrees together must not exceed kMostDegree.
Polynomial product(const Polynomial& a, const Polynomial& b);

/// The root of a polynomial with values of different sign, or zero, at a and b.
double root_between(const Polynomial& p, double a, double b);
/// Appends every root within (a, b), where the sign changes, ascending.
void roots(const Polynomial& p, double a, double b, std::vector<double>& out);

struct Fit {
  Polynomial polynomial;
  double error;  ///< largest difference found
};
/// Interpolates f over [a, b], mapped to [0, 1], inside the interval only.
Fit fit(const std::function<double(double)>& f, double a, double b, int degree);

}  // namespace whisker::rules
