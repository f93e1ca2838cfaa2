#include "host/lab/rules/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::rules {
namespace {

constexpr double kCellError = 5e-14;
constexpr double kRelativeError = 1e-13;
constexpr double kNothing = 1e-200;
constexpr int kMostHalvings = 40;
constexpr std::size_t kMostCuts = 4096;

double value(const Canvas::Set& set, double y) {
  const double m = set.membership(y);
  return set.negated ? 1 - m : m;
}

/// Exact degrees; Polynomial::kMostDegree for a shape that is no polynomial.
int degree_of(const Membership& m) {
  switch (m.shape) {
    case Shape::polyline: return 1;
    case Shape::s_curve:
    case Shape::z_curve: return 2;
    case Shape::pi_curve: return 4;
    default: return Polynomial::kMostDegree;
  }
}

Fit fit_set(const Canvas::Set& set, double from, double to) {
  return fit([&](double y) { return value(set, y); }, from, to, degree_of(set.membership));
}

CellSet piece(Polynomial p, bool relative) {
  CellSet s;
  const double size = relative ? std::max(std::abs(p(0)), std::abs(p(1))) : 1;
  while (p.degree > 0 && std::abs(p.c[p.degree]) < 1e-17 * size) --p.degree;
  if (p.degree == 1 && std::abs(p.c[1]) < 1e-15 * size) p.degree = 0;
  s.p = p;
  s.low = std::max(0.0, std::min(p(0), p(1)));
  s.high = std::max(p(0), p(1));
  if (s.high < (relative ? kNothing : 1e-15)) s = CellSet{};
  s.area = s.p.area(0, 1);
  s.moment = s.p.moment(0, 1);
  return s;
}

void sort_out(std::vector<double>& cuts, double low, double high) {
  cuts.push_back(low);
  cuts.push_back(high);
  cuts.erase(std::remove_if(cuts.begin(), cuts.end(), [&](double y) { return !(y >= low && y <= high); }),
             cuts.end());
  std::sort(cuts.begin(), cuts.end());
  const double near = (high - low) * 1e-13;
  std::vector<double> kept;
  for (const double y : cuts)
    if (kept.empty() || y - kept.back() > near) kept.push_back(y);
  kept.back() = high;
  cuts = kept;
}

bool good(const Canvas::Set& set, double from, double to, bool relative) {
  if (degree_of(set.membership) < Polynomial::kMostDegree) return true;
  const double error = fit_set(set, from, to).error;
  if (!relative) return error <= kCellError;
  const double size = std::max(value(set, from), value(set, to));
  return size < kNothing || error <= kRelativeError * size;
}

/// Appends cuts within the interval until every set is one polynomial in each part.
void refine(const std::vector<Canvas::Set>& sets, double from, double to, bool relative, int halvings,
            std::vector<double>& cuts) {
  for (const Canvas::Set& set : sets) {
    if (halvings == 0 || cuts.size() > kMostCuts || good(set, from, to, relative)) continue;
    const double middle = from + (to - from) / 2;
    cuts.push_back(middle);
    refine(sets, from, middle, relative, halvings - 1, cuts);
    refine(sets, middle, to, relative, halvings - 1, cuts);
    return;
  }
}

}  // namespace

bool Canvas::exact(const std::vector<Set>& sets) {
  for (const Set& set : sets)
    if (degree_of(set.membership) == Polynomial::kMostDegree) return false;
  return true;
}

Canvas::Canvas(const std::vector<Set>& sets, double low, double high, bool crossings, bool relative) {
  std::vector<double> cuts;
  for (const Set& set : sets)
    for (const double y : set.membership.breaks()) cuts.push_back(y);
  sort_out(cuts, low, high);
  std::vector<double> finer = cuts;
  for (std::size_t i = 1; i < cuts.size(); ++i)
    refine(sets, cuts[i - 1], cuts[i], relative, kMostHalvings, finer);
  cuts = finer;
  sort_out(cuts, low, high);
  finer = cuts;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double width = cuts[i] - cuts[i - 1];
    std::vector<double> inner;
    std::vector<Polynomial> p;
    for (const Set& set : sets) {
      p.push_back(fit_set(set, cuts[i - 1], cuts[i]).polynomial);
      if (p.back().degree > 1) roots(p.back().derivative(), 0, 1, inner);
      for (std::size_t j = 0; crossings && j + 1 < p.size(); ++j) roots(sum(p.back(), p[j], -1), 0, 1, inner);
    }
    for (const double t : inner) finer.push_back(cuts[i - 1] + t * width);
  }
  cuts = finer;
  sort_out(cuts, low, high);
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    Cell cell{cuts[i - 1], cuts[i] - cuts[i - 1], {}};
    for (const Set& set : sets)
      cell.sets.push_back(piece(fit_set(set, cuts[i - 1], cuts[i]).polynomial, relative));
    cells_.push_back(std::move(cell));
  }
}

}  // namespace whisker::rules
