#include "host/lab/rules/symmetry.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::rules {
namespace {

class Walk {
 public:
  Walk(const Surface& surface, std::size_t output, std::size_t part)
      : values_(surface.values[output]), domain_(surface.domain), part_(part) {}

  void line(std::int32_t other, Slopes& s) const {
    const std::int32_t count = domain_.parts[part_].count();
    double least = at(0, other);
    double most = least;
    for (std::int32_t i = 1; i < count; ++i) {
      const double here = at(i, other);
      const double change = here - at(i - 1, other);
      (change > 0 ? s.rises : s.falls) += std::abs(change);
      if (std::abs(change) > s.step) s.step = std::abs(change), place(i - 1, other, s.step_at);
      if (here - least > s.greatest_rise) s.greatest_rise = here - least, place(i, other, s.rise_at);
      if (most - here > s.greatest_fall) s.greatest_fall = most - here, place(i, other, s.fall_at);
      least = std::min(least, here);
      most = std::max(most, here);
    }
  }

 private:
  double at(std::int32_t i, std::int32_t other) const {
    const std::int32_t row = part_ == 0 ? i : other;
    const std::int32_t column = part_ == 0 ? other : i;
    return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(domain_.columns()) +
                   static_cast<std::size_t>(column)];
  }
  void place(std::int32_t i, std::int32_t other, std::int32_t* raw) const {
    raw[part_] = domain_.parts[part_].from + i;
    if (domain_.parts.size() > 1) raw[1 - part_] = domain_.parts[1 - part_].from + other;
  }

  const std::vector<double>& values_;
  const Domain& domain_;
  std::size_t part_;
};

class Mirror {
 public:
  Mirror(const Surface& surface, std::size_t output, std::size_t part)
      : values_(surface.values[output]), domain_(surface.domain), part_(part) {}

  /// Calls f(value, mirrored value, row, column) for each pair once.
  template <class F>
  void each(F&& f) const {
    const std::int32_t rows = domain_.rows();
    const std::int32_t columns = domain_.columns();
    for (std::int32_t r = 0; r < (part_ == 0 ? (rows + 1) / 2 : rows); ++r)
      for (std::int32_t c = 0; c < (part_ == 1 ? (columns + 1) / 2 : columns); ++c)
        f(at(r, c), part_ == 0 ? at(rows - 1 - r, c) : at(r, columns - 1 - c), r, c);
  }

 private:
  double at(std::int32_t r, std::int32_t c) const {
    return values_[static_cast<std::size_t>(r) * static_cast<std::size_t>(domain_.columns()) +
                   static_cast<std::size_t>(c)];
  }
  const std::vector<double>& values_;
  const Domain& domain_;
  std::size_t part_;
};

double median_sum(const Mirror& mirror) {
  std::vector<double> sums;
  mirror.each([&](double a, double b, std::int32_t, std::int32_t) { sums.push_back(a + b); });
  const auto middle = sums.begin() + static_cast<std::ptrdiff_t>(sums.size() / 2);
  std::nth_element(sums.begin(), middle, sums.end());
  return *middle;
}

/// False if there is no such symmetry.
bool find(const Surface& surface, double span, Symmetry& s) {
  const Mirror mirror(surface, s.output, s.part);
  const double twice = s.odd ? median_sum(mirror) : 0;
  s.centre = twice / 2;
  if (std::abs(s.centre) < 1e-9 * span) s.centre = 0;
  double pairs = 0;
  double close = 0;
  mirror.each([&](double a, double b, std::int32_t r, std::int32_t c) {
    const double difference = s.odd ? std::abs(a + b - twice) : std::abs(a - b);
    ++pairs;
    if (difference <= 0.01 * span) ++close;
    if (difference <= s.broken_by) return;
    s.broken_by = difference;
    s.at[0] = surface.domain.parts[0].from + r;
    s.at[1] = surface.domain.parts.size() > 1 ? surface.domain.parts[1].from + c : 0;
  });
  if (s.broken_by <= 1e-9 * span) s.broken_by = 0;
  return close >= 0.75 * pairs;
}

}  // namespace

Slopes slopes(const Surface& surface, std::size_t output, std::size_t part) {
  Slopes s;
  const Walk walk(surface, output, part);
  const std::int32_t lines = part == 0 ? surface.domain.columns() : surface.domain.rows();
  for (std::int32_t other = 0; other < lines; ++other) walk.line(other, s);
  return s;
}

std::vector<Symmetry> symmetries(const Surface& surface, const std::vector<double>& spans) {
  std::vector<Symmetry> all;
  for (std::size_t o = 0; o < spans.size(); ++o) {
    for (std::size_t p = 0; spans[o] > 0 && p < surface.domain.parts.size(); ++p) {
      const Domain::Part& part = surface.domain.parts[p];
      if (part.from - part.axis.low != part.axis.high - part.to) continue;
      Symmetry even{o, p, false, 0, 0, {0, 0}};
      Symmetry odd{o, p, true, 0, 0, {0, 0}};
      const bool is_even = find(surface, spans[o], even);
      const bool is_odd = find(surface, spans[o], odd);
      // An output that hardly depends on the input is both; the closer one is meant.
      if (is_even && (!is_odd || even.broken_by <= odd.broken_by))
        all.push_back(even);
      else if (is_odd)
        all.push_back(odd);
    }
  }
  return all;
}

}  // namespace whisker::rules
