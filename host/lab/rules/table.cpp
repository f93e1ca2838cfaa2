#include "host/lab/rules/table.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::rules {
namespace {

struct Place1 {
  std::int32_t cell;
  std::int32_t offset;
};

Place1 place(const GridAxis& axis, std::int32_t raw) {
  const std::int32_t x = std::min(std::max(raw, axis.low), axis.high) - axis.low;
  const std::int32_t cell = (x - (x > 0 ? 1 : 0)) >> axis.shift;
  return {cell, x - (cell << axis.shift)};
}

/// Values along one axis, with a last node beyond the end extrapolated through the value at the end.
class Line {
 public:
  Line(const GridAxis& axis, std::int32_t from) : axis_(axis), from_(from) {}
  template <class At>
  double operator()(std::int32_t node, At&& at) const {
    const std::int32_t raw = axis_.low + (node << axis_.shift);
    if (raw <= axis_.high) return at(raw - from_);
    const std::int32_t before = raw - (1 << axis_.shift);
    const double last = at(before - from_);
    const double share = static_cast<double>(axis_.high - before) / (1 << axis_.shift);
    return last + (at(axis_.high - from_) - last) / share;
  }

 private:
  GridAxis axis_;
  std::int32_t from_;
};

}  // namespace

std::int16_t nearest_raw(double raw) {
  const double up = std::floor(std::abs(raw) + 0.5 + 1e-7);
  const double limited = std::min(up, double{INT16_MAX});
  return static_cast<std::int16_t>(raw < 0 ? -limited : limited);
}

std::int16_t Table::node(std::int32_t row, std::int32_t column, std::size_t output) const {
  const std::int32_t columns = axes.size() > 1 ? axes[1].nodes() : 1;
  return nodes[static_cast<std::size_t>(row * columns + column) * scales.size() + output];
}

std::int16_t look_up(const Table& table, std::size_t output, const std::int32_t* raw) {
  const Place1 a = place(table.axes[0], raw[0]);
  const int rows = table.axes[0].shift;
  int bits = rows;
  std::int32_t sum = 0;
  if (table.axes.size() == 1) {
    sum = ((1 << rows) - a.offset) * table.node(a.cell, 0, output) +
          a.offset * table.node(a.cell + 1, 0, output);
  } else {
    const Place1 b = place(table.axes[1], raw[1]);
    const int columns = table.axes[1].shift;
    bits += columns;
    const std::int32_t w3 = a.offset * b.offset;
    const std::int32_t w2 = (a.offset << columns) - w3;
    const std::int32_t w1 = (b.offset << rows) - w3;
    const std::int32_t w0 = (1 << bits) - w1 - w2 - w3;
    sum = w0 * table.node(a.cell, b.cell, output) + w1 * table.node(a.cell, b.cell + 1, output) +
          w2 * table.node(a.cell + 1, b.cell, output) + w3 * table.node(a.cell + 1, b.cell + 1, output);
  }
  if (bits == 0) return static_cast<std::int16_t>(sum);
  const std::int32_t half = 1 << (bits - 1);
  const std::int32_t up = table.scales[output].odd && sum >= 0 ? half - 1 : half;
  return static_cast<std::int16_t>((sum + up) >> bits);
}

Table make_table(const Surface& surface, const std::vector<GridAxis>& axes,
                 const std::vector<OutputScale>& scales) {
  Table table{axes, scales, {}};
  const Domain& domain = surface.domain;
  const Line rows(axes[0], domain.parts[0].from);
  const bool two = axes.size() > 1;
  const Line columns(two ? axes[1] : GridAxis{}, two ? domain.parts[1].from : 0);
  const auto width = static_cast<std::size_t>(domain.columns());
  for (std::int32_t i = 0; i < axes[0].nodes(); ++i) {
    for (std::int32_t j = 0; j < (two ? axes[1].nodes() : 1); ++j) {
      for (std::size_t o = 0; o < scales.size(); ++o) {
        const std::vector<double>& values = surface.values[o];
        const auto at_row = [&](std::int32_t r) {
          const auto at = [&](std::int32_t c) {
            return values[static_cast<std::size_t>(r) * width + static_cast<std::size_t>(c)];
          };
          return two ? columns(j, at) : at(0);
        };
        table.nodes.push_back(nearest_raw((rows(i, at_row) - scales[o].origin) * scales[o].per_unit));
      }
    }
  }
  return table;
}

OutputScale make_scale(const std::vector<double>& values, const Output& output) {
  OutputScale scale;
  if (output.raw_per_unit) {
    scale.per_unit = *output.raw_per_unit;
    return scale;
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const auto fit = [](double most) {
    return most > 0 ? std::exp2(std::min(30.0, std::floor(std::log2(INT16_MAX / most)))) : 16384;
  };
  scale.per_unit = fit(std::max(std::abs(*low), std::abs(*high)));
  if ((*high - *low) * scale.per_unit >= 4096 || *high == *low) return scale;
  scale.origin = (*low + *high) / 2;
  scale.per_unit = fit((*high - *low) / 2);
  return scale;
}

}  // namespace whisker::rules
