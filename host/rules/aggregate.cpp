#include "host/rules/aggregate.hpp"

#include <algorithm>

#include "host/rules/maximum_pieces.hpp"

namespace whisker::rules {
namespace {

void add(const Piece& piece, Moments& m) {
  const double w = piece.cell->width;
  const double area = piece.p->area(piece.a, piece.b) * piece.factor * w;
  const double moment = piece.p->moment(piece.a, piece.b) * piece.factor * w;
  m.area += area;
  m.moment += piece.cell->start * area + w * moment;
}

void add_cell(const Cell& cell, double area, double moment, Moments& m) {
  m.area += area * cell.width;
  m.moment += (cell.start * area + cell.width * moment) * cell.width;
}

/// One set after the implication over the whole cell.
void add_whole(const Cell& cell, const Activated& a, Moments& m) {
  Shaped s;
  if (!shape(cell, a, s)) return;
  if (s.cut) {
    const double t = limit_root(s);
    const bool rises = s.set->p(0) < s.limit;
    add(Piece{&cell, rises ? 0 : t, rises ? t : 1, &s.set->p, 1}, m);
    add(Piece{&cell, rises ? t : 0, rises ? 1 : t, &kOnePolynomial, s.limit}, m);
  } else if (s.set->low >= s.limit) {
    add_cell(cell, s.limit, s.limit / 2, m);
  } else {
    add_cell(cell, s.factor * s.set->area, s.factor * s.set->moment, m);
  }
}

/// The maximum where one set is the greatest all over the cell; false, and nothing added, elsewhere. Most
/// cells of smooth sets are of this kind.
bool add_single(const Cell& cell, const std::vector<Activated>& activated, Moments& m) {
  const Activated* best = nullptr;
  double floor = -1;
  double ceiling = 0;
  for (const Activated& a : activated) {
    const CellSet& set = cell.sets[a.set];
    const double low = a.product ? a.strength * set.low : std::min(a.strength, set.low);
    if (low <= floor) continue;
    floor = low;
    best = &a;
  }
  for (const Activated& a : activated) {
    const CellSet& set = cell.sets[a.set];
    const double high = a.product ? a.strength * set.high : std::min(a.strength, set.high);
    if (&a != best) ceiling = std::max(ceiling, high);
  }
  if (ceiling > floor) return false;
  add_whole(cell, *best, m);
  return true;
}

/// The aggregated set is the sum of its parts all over the cell.
bool adds_up(const Cell& cell, Or aggregation, const std::vector<Activated>& activated) {
  if (aggregation == Or::sum) return true;
  double highest = 0;
  int count = 0;
  for (const Activated& a : activated) {
    const double high = cell.sets[a.set].high;
    highest += a.product ? a.strength * high : std::min(a.strength, high);
    if (high > 0) ++count;
  }
  return count < 2 || (aggregation == Or::bounded_sum && highest <= 1);
}

Polynomial clipped(const Shaped& s, double middle) {
  return s.factor * s.set->p(middle) > s.limit ? constant(s.limit) : scaled(s.set->p, s.factor);
}

constexpr double kFitError = 1e-13;
/// An error below this that no longer shrinks is rounding.
constexpr double kRoundingError = 1e-11;

/// f over [a, b] of the cell; it is not a polynomial there, so it is halved until a polynomial is within
/// kFitError. `before`: the error over the interval twice as long.
void visit_fitted(const Cell& cell, double a, double b, double before, const std::function<double(double)>& f,
                  const std::function<void(const Piece&)>& visit) {
  const Fit found = fit(f, a, b, Polynomial::kMostDegree);
  const bool shrinks = found.error > kRoundingError || found.error < before / 4;
  if (found.error > kFitError && shrinks && b - a > 1e-6) {
    visit_fitted(cell, a, (a + b) / 2, found.error, f, visit);
    visit_fitted(cell, (a + b) / 2, b, found.error, f, visit);
    return;
  }
  const Cell part{cell.start + a * cell.width, (b - a) * cell.width, {}};
  visit(Piece{&part, 0, 1, &found.polynomial, 1});
}

/// One part of a cell in which every shaped set is one polynomial.
void visit_part(const Cell& cell, double a, double b, Or aggregation, const std::vector<Polynomial>& parts,
                const std::function<void(const Piece&)>& visit) {
  int degrees = 0;
  for (const Polynomial& p : parts) degrees += p.degree;
  if (aggregation == Or::sum || aggregation == Or::bounded_sum) {
    Polynomial total;
    for (const Polynomial& p : parts) total = sum(total, p, 1);
    std::vector<double> cuts;
    if (aggregation == Or::bounded_sum) roots(sum(total, constant(1), -1), a, b, cuts);
    cuts.push_back(b);
    double from = a;
    for (const double to : cuts) {
      const bool full = aggregation == Or::bounded_sum && total((from + to) / 2) > 1;
      visit(Piece{&cell, from, to, full ? &kOnePolynomial : &total, 1});
      from = to;
    }
  } else if (aggregation == Or::probabilistic_sum && degrees <= Polynomial::kMostDegree) {
    Polynomial rest = constant(1);
    for (const Polynomial& p : parts) rest = product(rest, sum(constant(1), p, -1));
    const Polynomial total = sum(constant(1), rest, -1);
    visit(Piece{&cell, a, b, &total, 1});
  } else {
    const auto f = [&](double t) {
      double mu = 0;
      for (const Polynomial& p : parts) mu = join(aggregation, mu, p(t));
      return mu;
    };
    visit_fitted(cell, a, b, 1, f, visit);
  }
}

void visit_cell(const Cell& cell, Or aggregation, const std::vector<Activated>& activated,
                const std::function<void(const Piece&)>& visit) {
  std::vector<Shaped> all;
  std::vector<double> cuts;
  for (const Activated& a : activated) {
    Shaped s;
    if (!shape(cell, a, s)) continue;
    if (s.cut) cuts.push_back(limit_root(s));
    all.push_back(s);
  }
  if (all.empty()) return;
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(1);
  double from = 0;
  for (const double to : cuts) {
    if (to - from <= 1e-16) continue;
    std::vector<Polynomial> parts;
    for (const Shaped& s : all) parts.push_back(clipped(s, (from + to) / 2));
    visit_part(cell, from, to, aggregation, parts, visit);
    from = to;
  }
}

}  // namespace

Moments moments(const Canvas& canvas, Or aggregation, const std::vector<Activated>& activated) {
  thread_local Scratch scratch;
  Moments m;
  const auto count = [&m](const Piece& piece) { add(piece, m); };
  for (const Cell& cell : canvas.cells()) {
    if (aggregation == Or::maximum) {
      if (!add_single(cell, activated, m)) maximum_pieces(cell, activated, scratch, count);
    } else if (adds_up(cell, aggregation, activated)) {
      for (const Activated& a : activated) add_whole(cell, a, m);
    } else {
      visit_cell(cell, aggregation, activated, count);
    }
  }
  return m;
}

void visit_pieces(const Canvas& canvas, Or aggregation, const std::vector<Activated>& activated,
                  const std::function<void(const Piece&)>& visit) {
  Scratch scratch;
  for (const Cell& cell : canvas.cells()) {
    if (aggregation == Or::maximum) {
      maximum_pieces(cell, activated, scratch, visit);
    } else {
      visit_cell(cell, aggregation, activated, visit);
    }
  }
}

}  // namespace whisker::rules
