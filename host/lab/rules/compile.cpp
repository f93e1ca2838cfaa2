#include "host/lab/rules/compile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "host/lab/rules/findings.hpp"

namespace whisker::rules {
namespace {

/// Accuracy of inference, as a share of an output's range.
constexpr double kRounding = 1e-9;

double raw_count(const Domain::Part& part, std::int32_t i) { return part.multiplicity(i); }

/// False if some rule fires at every input.
bool find_gap(const Surface& surface, Gap& gap) {
  const Domain& domain = surface.domain;
  const std::vector<char>& silent = surface.silent[gap.output];
  double count = 0;
  const auto columns = static_cast<std::size_t>(domain.columns());
  for (std::size_t i = 0; i < silent.size(); ++i) {
    if (silent[i] == 0) continue;
    const std::int32_t at[2] = {static_cast<std::int32_t>(i / columns),
                                static_cast<std::int32_t>(i % columns)};
    double here = 1;
    for (std::size_t p = 0; p < domain.parts.size(); ++p) {
      const Domain::Part& part = domain.parts[p];
      here *= raw_count(part, at[p]);
      const std::int32_t low = at[p] == 0 ? part.axis.low : part.from + at[p];
      const std::int32_t high = at[p] == part.count() - 1 ? part.axis.high : part.from + at[p];
      gap.low[p] = count == 0 ? low : std::min(gap.low[p], low);
      gap.high[p] = count == 0 ? high : std::max(gap.high[p], high);
    }
    count += here;
    gap.answer = surface.values[gap.output][i];
  }
  gap.share = count / surface.inputs;
  return count > 0;
}

void find_gaps(Compiled& c) {
  for (std::size_t o = 0; o < c.base.outputs.size(); ++o) {
    Gap gap;
    gap.output = o;
    if (!find_gap(c.surface, gap)) continue;
    const Output& output = c.base.outputs[o];
    if (output.silent == Silent::undefined) {
      fail(c.base, output.place,
           fmt::format(
               "'{}' has no answer where no rule fires: {} ({:.3g} % of the inputs, from {} to {}); give it "
               "a default",
               output.name, output.silent_reason, 100 * gap.share, where(c, gap.low), where(c, gap.high)));
    }
    c.gaps.push_back(gap);
  }
}

std::vector<OutputScale> scales_of(const Compiled& c) {
  std::vector<OutputScale> scales;
  for (std::size_t o = 0; o < c.base.outputs.size(); ++o) {
    const Output& output = c.base.outputs[o];
    scales.push_back(make_scale(c.surface.values[o], output));
    for (const double value : c.surface.values[o]) {
      if (std::abs(value - scales[o].origin) * scales[o].per_unit <= INT16_MAX + 0.4) continue;
      fail(c.base, output.place, fmt::format("'{}' = {:.6g} does not fit in 16 bits", output.name, value));
    }
    for (const Symmetry& s : c.symmetries) {
      const bool exact = s.output == o && s.odd && s.broken_by == 0;
      if (exact && s.centre == 0 && scales[o].origin == 0) scales[o].odd = true;
    }
  }
  return scales;
}

[[noreturn]] void fail_search(const RuleBase& base, const Demand& demand) {
  if (!demand.nodes.empty()) fail(base, {}, "no spacing that is a power of two gives this number of nodes");
  if (demand.most_bytes) fail(base, {}, fmt::format("no table fits in {} bytes", *demand.most_bytes));
  fail(base, {}, fmt::format("no table is within {:g} %", 100 * demand.tolerance));
}

}  // namespace

Compiled compile(RuleBase base, const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  Compiled c;
  c.base = std::move(base);
  const Inference inference(c.base);
  c.surface =
      make_surface(c.base, inference, make_domain(c.base, inference, options.fixed, options.fewest_steps));
  for (std::size_t r = 0; r < c.surface.fired.size(); ++r)
    if (!c.surface.fired[r]) c.never.push_back(r);
  find_gaps(c);
  for (std::size_t o = 0; o < c.surface.values.size(); ++o) {
    const double span = span_of(c.surface.values[o]);
    // Less is rounding: the output never changes.
    const double least = kRounding * (c.base.outputs[o].high - c.base.outputs[o].low);
    c.spans.push_back(span > least ? span : 0);
  }
  c.symmetries = symmetries(c.surface, c.spans);
  // An output that never changes is right within a raw unit.
  std::vector<double> scales_span = c.spans;
  const std::vector<OutputScale> scales = scales_of(c);
  for (std::size_t o = 0; o < scales_span.size(); ++o)
    if (scales_span[o] == 0) scales_span[o] = 1 / (scales[o].per_unit * options.demand.tolerance);
  std::optional<Found> found = search(c.surface, scales, scales_span, c.symmetries, options.demand);
  if (!found) fail_search(c.base, options.demand);
  c.table = std::move(found->table);
  c.errors = std::move(found->errors);
  c.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return c;
}

}  // namespace whisker::rules
