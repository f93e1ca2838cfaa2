/// Pieces of the maximum of several cut sets within one cell.
#pragma once

#include <algorithm>
#include <vector>

#include "host/lab/rules/aggregate.hpp"

namespace whisker::rules {

/// A set over one cell after the implication: factor * p, limited to `limit`.
struct Shaped {
  const CellSet* set;
  double factor;
  double limit;
  double low;  ///< least and greatest value
  double high;
  bool cut;  ///< p crosses the limit within the cell
};

/// Buffers that one thread reuses.
struct Scratch {
  std::vector<Shaped> shaped;
  std::vector<double> cuts;
};

inline const Polynomial kOnePolynomial = constant(1);

/// False if it is zero all over the cell.
inline bool shape(const Cell& cell, const Activated& a, Shaped& out) {
  const CellSet& set = cell.sets[a.set];
  if (set.high <= 0) return false;
  if (a.product) {
    out = {&set, a.strength, 2, a.strength * set.low, a.strength * set.high, false};
  } else {
    out = {&set, 1, a.strength, std::min(a.strength, set.low), std::min(a.strength, set.high), false};
    out.cut = set.low < a.strength && a.strength < set.high;
  }
  return true;
}

/// Where its limit is reached; only if cut.
inline double limit_root(const Shaped& s) {
  if (s.set->p.degree == 1) return std::min(std::max((s.limit - s.set->p.c[0]) / s.set->p.c[1], 0.0), 1.0);
  Polynomial p = s.set->p;
  p.c[0] -= s.limit;
  return root_between(p, 0, 1);
}

namespace detail {

/// Appends where two shaped sets may cross.
inline void add_crossings(const Shaped& a, const Shaped& b, std::vector<double>& cuts) {
  // Sets that are not scaled cross only at the borders of cells.
  if (a.factor != 1 || b.factor != 1) roots(sum(scaled(a.set->p, a.factor), b.set->p, -b.factor), 0, 1, cuts);
  const auto level = [&](const Shaped& s, double limit) {
    if (limit >= s.high || limit <= s.low) return;
    Polynomial p = scaled(s.set->p, s.factor);
    p.c[0] -= limit;
    cuts.push_back(root_between(p, 0, 1));
  };
  level(a, b.limit);
  level(b, a.limit);
}

inline double value(const Shaped& s, double t) { return std::min(s.limit, s.factor * s.set->p(t)); }

template <class Visit>
void emit(const Cell& cell, const Shaped& s, double a, double b, Visit&& visit) {
  const double middle = (a + b) / 2;
  if (s.factor * s.set->p(middle) > s.limit) {
    visit(Piece{&cell, a, b, &kOnePolynomial, s.limit});
  } else {
    visit(Piece{&cell, a, b, &s.set->p, s.factor});
  }
}

}  // namespace detail

/// Calls visit(Piece) for each piece of the maximum.
template <class Visit>
void maximum_pieces(const Cell& cell, const std::vector<Activated>& activated, Scratch& scratch,
                    Visit&& visit) {
  std::vector<Shaped>& all = scratch.shaped;
  all.clear();
  double floor = 0;
  for (const Activated& a : activated) {
    Shaped s;
    if (!shape(cell, a, s)) continue;
    all.push_back(s);
    floor = std::max(floor, s.low);
  }
  if (all.size() > 1) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      bool dominated = all[i].high <= floor && all[i].low < floor;
      // Of several constants at the floor, the first stands for all.
      for (std::size_t j = 0; !dominated && j < kept; ++j) dominated = all[i].high <= all[j].low;
      if (!dominated) all[kept++] = all[i];
    }
    all.resize(kept);
  }
  if (all.empty()) return;
  std::vector<double>& cuts = scratch.cuts;
  cuts.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].cut) cuts.push_back(limit_root(all[i]));
    for (std::size_t j = 0; j < i; ++j) detail::add_crossings(all[i], all[j], cuts);
  }
  if (cuts.size() > 1) std::sort(cuts.begin(), cuts.end());
  cuts.push_back(1);
  double from = 0;
  for (const double to : cuts) {
    if (to - from <= 1e-16) continue;
    const Shaped* best = &all[0];
    if (all.size() > 1) {
      const double middle = (from + to) / 2;
      double most = detail::value(*best, middle);
      for (std::size_t i = 1; i < all.size(); ++i) {
        const double here = detail::value(all[i], middle);
        if (here > most) most = here, best = &all[i];
      }
    }
    detail::emit(cell, *best, from, to, visit);
    from = to;
  }
}

}  // namespace whisker::rules
