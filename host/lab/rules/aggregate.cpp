#include "host/lab/rules/aggregate.hpp"

#include <algorithm>
#include <cmath>

#include "host/lab/rules/maximum_pieces.hpp"

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
  std::vector<std::pair<Shaped, double>> all;
  std::vector<double> cuts;
  for (const Activated& a : activated) {
    Shaped s;
    if (!shape(cell, a, s)) continue;
    if (s.cut) cuts.push_back(limit_root(s));
    all.emplace_back(s, a.times);
  }
  if (all.empty()) return;
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(1);
  double from = 0;
  for (const double to : cuts) {
    if (to - from <= 1e-16) continue;
    std::vector<Polynomial> parts;
    for (const auto& [s, times] : all) parts.push_back(scaled(clipped(s, (from + to) / 2), times));
    visit_part(cell, from, to, aggregation, parts, visit);
    from = to;
  }
}

/// Maxima within this share of the greatest count as equal.
constexpr double kEqual = 1e-9;

struct Plateau {
  double from;
  double to;
  double value;
};

double place(const Piece& piece, double t) { return piece.cell->start + t * piece.cell->width; }

/// The place with half of the area on each side.
double bisector(const Canvas& canvas, Or aggregation, const std::vector<Activated>& activated, double area) {
  double left = area / 2;
  double at = 0;
  bool found = false;
  visit_pieces(canvas, aggregation, activated, [&](const Piece& piece) {
    if (found) return;
    const double unit = piece.factor * piece.cell->width;
    const double here = piece.p->area(piece.a, piece.b) * unit;
    if (here < left) {
      left -= here;
      return;
    }
    found = true;
    double a = piece.a;
    double b = piece.b;
    for (int i = 0; i < 60; ++i) {
      const double t = (a + b) / 2;
      (piece.p->area(piece.a, t) * unit < left ? a : b) = t;
    }
    at = place(piece, (a + b) / 2);
  });
  return at;
}

/// Every place where the set may be greatest.
std::vector<Plateau> candidates(const Canvas& canvas, Or aggregation,
                                const std::vector<Activated>& activated) {
  std::vector<Plateau> all;
  visit_pieces(canvas, aggregation, activated, [&](const Piece& piece) {
    if (piece.p->is_constant()) {
      all.push_back({place(piece, piece.a), place(piece, piece.b), piece.factor * (*piece.p)(piece.a)});
      return;
    }
    std::vector<double> at{piece.a};
    if (piece.p->degree > 1) roots(piece.p->derivative(), piece.a, piece.b, at);
    at.push_back(piece.b);
    for (const double t : at) all.push_back({place(piece, t), place(piece, t), piece.factor * (*piece.p)(t)});
  });
  return all;
}

/// The places of the maximum, ascending and joined where they touch.
std::vector<Plateau> maxima(std::vector<Plateau> all) {
  double most = 0;
  for (const Plateau& p : all) most = std::max(most, p.value);
  std::vector<Plateau> kept;
  for (const Plateau& p : all) {
    if (p.value < most * (1 - kEqual)) continue;
    const double near = 1e-9 * (1 + std::abs(p.from));
    if (!kept.empty() && p.from - kept.back().to <= near) {
      kept.back().to = std::max(kept.back().to, p.to);
    } else {
      kept.push_back(p);
    }
  }
  return kept;
}

double mean(const std::vector<Plateau>& plateaus) {
  double length = 0;
  double moment = 0;
  double points = 0;
  for (const Plateau& p : plateaus) {
    length += p.to - p.from;
    moment += (p.to - p.from) * (p.to + p.from) / 2;
    points += (p.from + p.to) / 2;
  }
  const double span = plateaus.back().to - plateaus.front().from;
  return length > 1e-9 * span ? moment / length : points / static_cast<double>(plateaus.size());
}

double least_size(const std::vector<Plateau>& plateaus) {
  double best = plateaus.front().from;
  for (const Plateau& p : plateaus) {
    const double nearest = std::min(std::max(0.0, p.from), p.to);
    if (std::abs(nearest) < std::abs(best)) best = nearest;
  }
  return best;
}

double greatest_size(const std::vector<Plateau>& plateaus) {
  double best = plateaus.front().from;
  for (const Plateau& p : plateaus)
    for (const double y : {p.from, p.to})
      if (std::abs(y) > std::abs(best)) best = y;
  return best;
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
      for (const Activated& a : activated) {
        Moments one;
        add_whole(cell, a, one);
        m.area += a.times * one.area;
        m.moment += a.times * one.moment;
      }
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

bool defuzzify(const Canvas& canvas, Or aggregation, Defuzzifier defuzzifier,
               const std::vector<Activated>& activated, double& out) {
  if (activated.empty()) return false;
  if (defuzzifier == Defuzzifier::centroid || defuzzifier == Defuzzifier::bisector) {
    const Moments m = moments(canvas, aggregation, activated);
    if (!(m.area > 0)) return false;
    out = defuzzifier == Defuzzifier::centroid ? m.moment / m.area
                                               : bisector(canvas, aggregation, activated, m.area);
    return true;
  }
  const std::vector<Plateau> top = maxima(candidates(canvas, aggregation, activated));
  if (top.empty()) return false;
  switch (defuzzifier) {
    case Defuzzifier::mean_of_maxima: out = mean(top); break;
    case Defuzzifier::middle_of_first_maximum: out = (top.front().from + top.front().to) / 2; break;
    case Defuzzifier::first_maximum: out = top.front().from; break;
    case Defuzzifier::last_maximum: out = top.back().to; break;
    case Defuzzifier::smallest_maximum: out = least_size(top); break;
    case Defuzzifier::largest_maximum: out = greatest_size(top); break;
    default: return false;
  }
  return true;
}

}  // namespace whisker::rules
