#include "host/rules/defuzzify.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::rules {
namespace {

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
