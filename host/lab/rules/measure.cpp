#include "host/lab/rules/measure.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::rules {
namespace {

struct Step {
  std::int32_t cell;
  std::int32_t offset;
};

std::vector<Step> steps_of(const GridAxis& axis, const Domain::Part& part) {
  std::vector<Step> steps;
  for (std::int32_t raw = part.from; raw <= part.to; ++raw) {
    const std::int32_t x = raw - axis.low;
    const std::int32_t cell = (x - (x > 0 ? 1 : 0)) >> axis.shift;
    steps.push_back({cell, x - (cell << axis.shift)});
  }
  return steps;
}

/// One output. The sums are those of look_up(), in another order: no step of them rounds.
class Pass {
 public:
  Pass(const Surface& surface, const Table& table, std::size_t output, double limit)
      : surface_(surface),
        table_(table),
        output_(output),
        limit_(limit),
        two_(table.axes.size() > 1),
        rows_(steps_of(table.axes[0], surface.domain.parts[0])) {
    if (two_) columns_ = steps_of(table.axes[1], surface.domain.parts[1]);
    nodes_ = two_ ? table.axes[1].nodes() : 1;
  }

  bool run(Error& out) {
    double squares = 0;
    const Domain& domain = surface_.domain;
    const auto width = static_cast<std::size_t>(domain.columns());
    std::vector<std::int32_t> blend(static_cast<std::size_t>(nodes_));
    const int bits = table_.axes[0].shift + (two_ ? table_.axes[1].shift : 0);
    const std::int32_t half = bits == 0 ? 0 : 1 << (bits - 1);
    const std::int32_t less = bits > 0 && table_.scales[output_].odd ? 1 : 0;
    const double unit = 1 / table_.scales[output_].per_unit;
    const double origin = table_.scales[output_].origin;
    for (std::int32_t row = 0; row < domain.rows(); ++row) {
      const Step a = rows_[static_cast<std::size_t>(row)];
      const std::int32_t whole = 1 << table_.axes[0].shift;
      for (std::int32_t n = 0; n < nodes_; ++n) {
        const std::int32_t far = a.offset == 0 ? 0 : a.offset * table_.node(a.cell + 1, n, output_);
        blend[static_cast<std::size_t>(n)] = (whole - a.offset) * table_.node(a.cell, n, output_) + far;
      }
      const double* exact = &surface_.values[output_][static_cast<std::size_t>(row) * width];
      double row_squares = 0;
      double greatest = 0;
      std::int32_t where = 0;
      for (std::int32_t c = 0; c < domain.columns(); ++c) {
        std::int32_t sum = blend[0];
        if (two_) {
          const Step b = columns_[static_cast<std::size_t>(c)];
          const std::int32_t* const near = &blend[static_cast<std::size_t>(b.cell)];
          sum = ((1 << table_.axes[1].shift) - b.offset) * near[0] + b.offset * near[1];
        }
        const std::int32_t raw = (sum + half - (sum >= 0 ? less : 0)) >> bits;
        const double error = std::abs(origin + raw * unit - exact[c]);
        if (error > greatest) greatest = error, where = c;
        double weight = 1;
        if (two_ && (c == 0 || c == domain.columns() - 1)) weight = domain.parts[1].multiplicity(c);
        row_squares += weight * error * error;
      }
      squares += row_squares * domain.parts[0].multiplicity(row);
      if (greatest > out.greatest) {
        out.greatest = greatest;
        out.at[0] = domain.parts[0].from + row;
        out.at[1] = two_ ? domain.parts[1].from + where : 0;
      }
      if (greatest > limit_) return false;
    }
    out.rms = std::sqrt(squares / surface_.inputs);
    return true;
  }

 private:
  const Surface& surface_;
  const Table& table_;
  std::size_t output_;
  double limit_;
  bool two_;
  std::vector<Step> rows_;
  std::vector<Step> columns_;
  std::int32_t nodes_ = 1;
};

}  // namespace

double span_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

bool measure(const Surface& surface, const Table& table, const std::vector<double>& spans, double share,
             std::vector<Error>& out) {
  out.assign(spans.size(), Error{});
  for (std::size_t o = 0; o < spans.size(); ++o)
    if (!Pass(surface, table, o, share * spans[o]).run(out[o])) return false;
  return true;
}

}  // namespace whisker::rules
