#include "host/rules/slopes.hpp"

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

}  // namespace

Slopes slopes(const Surface& surface, std::size_t output, std::size_t part) {
  Slopes s;
  const Walk walk(surface, output, part);
  const std::int32_t lines = part == 0 ? surface.domain.columns() : surface.domain.rows();
  for (std::int32_t other = 0; other < lines; ++other) walk.line(other, s);
  return s;
}

}  // namespace whisker::rules
