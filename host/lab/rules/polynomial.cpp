#include "host/lab/rules/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::rules {

Polynomial Polynomial::derivative() const {
  Polynomial d;
  d.degree = std::max(0, degree - 1);
  for (int i = 1; i <= degree; ++i) d.c[i - 1] = i * c[i];
  return d;
}

Polynomial Polynomial::antiderivative() const {
  Polynomial a;
  a.degree = degree + 1;
  for (int i = 0; i <= degree; ++i) a.c[i + 1] = c[i] / (i + 1);
  return a;
}

double Polynomial::area(double a, double b) const {
  if (degree == 0) return c[0] * (b - a);
  if (degree == 1) return (b - a) * (c[0] + c[1] * (a + b) / 2);
  double at_a = 0;
  double at_b = 0;
  for (int i = degree; i >= 0; --i) {
    at_a = (at_a + c[i] / (i + 1)) * a;
    at_b = (at_b + c[i] / (i + 1)) * b;
  }
  return at_b - at_a;
}

double Polynomial::moment(double a, double b) const {
  if (degree == 0) return c[0] * (b - a) * (a + b) / 2;
  if (degree == 1) return (b - a) * (c[0] * (a + b) / 2 + c[1] * (a * a + a * b + b * b) / 3);
  double at_a = 0;
  double at_b = 0;
  for (int i = degree; i >= 0; --i) {
    at_a = (at_a + c[i] / (i + 2)) * a;
    at_b = (at_b + c[i] / (i + 2)) * b;
  }
  return at_b * b - at_a * a;
}

bool Polynomial::is_constant() const {
  for (int i = 1; i <= degree; ++i)
    if (std::abs(c[i]) > 1e-13) return false;
  return true;
}

Polynomial constant(double value) {
  Polynomial p;
  p.c[0] = value;
  return p;
}

Polynomial scaled(const Polynomial& p, double factor) {
  Polynomial s = p;
  for (int i = 0; i <= p.degree; ++i) s.c[i] *= factor;
  return s;
}

Polynomial sum(const Polynomial& a, const Polynomial& b, double factor_of_b) {
  Polynomial s = a;
  s.degree = std::max(a.degree, b.degree);
  for (int i = 0; i <= b.degree; ++i) s.c[i] += factor_of_b * b.c[i];
  return s;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial s;
  s.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i)
    for (int j = 0; j <= b.degree; ++j) s.c[i + j] += a.c[i] * b.c[j];
  return s;
}

double root_between(const Polynomial& p, double a, double b) {
  if (p.degree == 1) return std::min(std::max(-p.c[0] / p.c[1], a), b);
  double at_a = p(a);
  double at_b = p(b);
  if (at_a == 0) return a;
  if (at_b == 0) return b;
  // Pieces meet at a root: an error there changes their area by its square.
  const double zero = 1e-12 * std::max(std::abs(at_a), std::abs(at_b));
  // Illinois: a false position that halves the value of an end that stays.
  int side = 0;
  for (int i = 0; i < 100 && b - a > 1e-16; ++i) {
    const double t = std::min(std::max((a * at_b - b * at_a) / (at_b - at_a), a), b);
    const double at = p(t);
    if (std::abs(at) <= zero) return t;
    if ((at < 0) == (at_b < 0)) {
      b = t;
      at_b = at;
      if (side == -1) at_a /= 2;
      side = -1;
    } else {
      a = t;
      at_a = at;
      if (side == 1) at_b /= 2;
      side = 1;
    }
  }
  return (a + b) / 2;
}

void roots(const Polynomial& p, double a, double b, std::vector<double>& out) {
  int degree = p.degree;
  while (degree > 0 && p.c[degree] == 0) --degree;
  if (degree == 0) return;
  if (degree == 1) {
    const double t = -p.c[0] / p.c[1];
    if (t > a && t < b) out.push_back(t);
    return;
  }
  double others = 0;
  for (int i = 1; i <= degree; ++i) others += std::abs(p.c[i]);
  if (std::abs(p.c[0]) > others) return;
  Polynomial lower = p;
  lower.degree = degree;
  std::vector<double> ends{a};
  roots(lower.derivative(), a, b, ends);
  ends.push_back(b);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double from = p(ends[i - 1]);
    const double to = p(ends[i]);
    if ((from < 0) == (to < 0)) continue;
    const double t = root_between(lower, ends[i - 1], ends[i]);
    if (t > a && t < b) out.push_back(t);
  }
}

Fit fit(const std::function<double(double)>& f, double a, double b, int degree) {
  // Newton's divided differences at Chebyshev nodes, then powers of t.
  double node[Polynomial::kMostDegree + 1] = {};
  double d[Polynomial::kMostDegree + 1] = {};
  for (int i = 0; i <= degree; ++i) {
    node[i] = (1 - std::cos(M_PI * (2 * i + 1) / (2 * degree + 2))) / 2;
    d[i] = f(a + (b - a) * node[i]);
  }
  for (int j = 1; j <= degree; ++j)
    for (int i = degree; i >= j; --i) d[i] = (d[i] - d[i - 1]) / (node[i] - node[i - j]);
  Polynomial p;
  p.degree = degree;
  p.c[0] = d[degree];
  for (int i = degree - 1; i >= 0; --i) {
    for (int j = degree; j >= 1; --j) p.c[j] = p.c[j - 1] - node[i] * p.c[j];
    p.c[0] = d[i] - node[i] * p.c[0];
  }
  double error = 0;
  for (const double t : {0.003, 0.17, 0.41, 0.66, 0.87, 0.996})
    error = std::max(error, std::abs(p(t) - f(a + (b - a) * t)));
  return {p, error};
}

}  // namespace whisker::rules
