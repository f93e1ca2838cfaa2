#include "host/lab/rules/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace whisker::rules {
namespace {

/// Degrees of the propositions of one input, for every raw value from `from` to `to`.
using Degrees = std::vector<std::vector<double>>;

Degrees degrees_of(const RuleBase& base, const Inference& inference, const Axis& axis, std::int32_t from,
                   std::int32_t to) {
  Degrees all;
  for (std::int32_t raw = from; raw <= to; ++raw) {
    std::vector<double>& row = all.emplace_back();
    for (const Inference::Proposition& p : inference.propositions())
      row.push_back(p.input == axis.input ? p(base, axis.value(raw)) : 0);
  }
  return all;
}

/// True if an output depends on the input other than through its terms.
bool enters_linear_term(const RuleBase& base, std::size_t input) {
  for (const Output& output : base.outputs)
    for (const Term& term : output.terms)
      if (input < term.coefficients.size() && term.coefficients[input] != 0) return true;
  return false;
}

Domain::Part make_part(const RuleBase& base, const Inference& inference, std::size_t input, int fewest) {
  Domain::Part part;
  if (!make_axis(base, input, fewest, part.axis)) {
    fail(base, base.inputs[input].place,
         fmt::format("'{}': the range must be a whole number of raw units, at most 32768, and fit in 16 bits",
                     base.inputs[input].name));
  }
  const Axis& axis = part.axis;
  part.from = axis.low;
  part.to = axis.high;
  if (!enters_linear_term(base, input)) {
    const Degrees degrees = degrees_of(base, inference, axis, axis.low, axis.high);
    const auto at = [&](std::int32_t raw) -> const std::vector<double>& {
      return degrees[static_cast<std::size_t>(raw - axis.low)];
    };
    while (part.from < part.to && at(part.from + 1) == at(axis.low)) ++part.from;
    while (part.to > part.from && at(part.to - 1) == at(axis.high)) --part.to;
  }
  // A table has at least two nodes on each axis.
  if (part.from == part.to) part.to < axis.high ? ++part.to : --part.from;
  return part;
}

/// The rules that can fire if the propositions of one axis have these degrees.
std::vector<std::size_t> possible(const Inference& inference, const std::vector<std::size_t>& rules,
                                  const std::vector<std::size_t>& propositions, const double* degrees) {
  std::vector<std::size_t> kept;
  for (const std::size_t r : rules) {
    bool zero = false;
    for (const std::size_t p : propositions) zero = zero || (degrees[p] == 0 && inference.needs(r, p));
    if (!zero) kept.push_back(r);
  }
  return kept;
}

class Evaluation {
 public:
  Evaluation(const RuleBase& base, const Inference& inference, Surface& out)
      : base_(base), inference_(inference), out_(out), fixed_(inference.propositions().size(), 0.0) {
    for (const Domain::Part& part : out.domain.parts)
      degrees_.push_back(degrees_of(base, inference, part.axis, part.from, part.to));
    const std::size_t count = inference.propositions().size();
    of_axis_.resize(out.domain.parts.size());
    for (std::size_t p = 0; p < count; ++p) {
      const Inference::Proposition& proposition = inference.propositions()[p];
      bool free = false;
      for (std::size_t a = 0; a < of_axis_.size(); ++a) {
        if (out.domain.parts[a].axis.input != proposition.input) continue;
        of_axis_[a].push_back(p);
        free = true;
      }
      if (!free) fixed_[p] = proposition(base, out.domain.inputs[proposition.input]);
    }
    std::vector<std::size_t> others;
    for (std::size_t p = 0; p < count; ++p) {
      bool free = false;
      for (const auto& axis : of_axis_) free = free || std::find(axis.begin(), axis.end(), p) != axis.end();
      if (!free) others.push_back(p);
    }
    std::vector<std::size_t> rules;
    for (std::size_t r = 0; r < base.rules.size(); ++r)
      if (inference.same_as(r) == r) rules.push_back(r);
    rules_ = possible(inference, rules, others, fixed_.data());
  }

  void row(std::int32_t row, std::vector<char>& fired) const {
    const Domain& domain = out_.domain;
    std::vector<double> degrees = fixed_;
    std::vector<double> strengths(base_.rules.size(), 0.0);
    std::vector<double> inputs = domain.inputs;
    const auto r = static_cast<std::size_t>(row);
    for (const std::size_t p : of_axis_[0]) degrees[p] = degrees_[0][r][p];
    inputs[domain.parts[0].axis.input] = domain.parts[0].axis.value(domain.parts[0].from + row);
    const std::vector<std::size_t> rules = possible(inference_, rules_, of_axis_[0], degrees.data());
    const auto columns = static_cast<std::size_t>(domain.columns());
    for (std::size_t c = 0; c < columns; ++c) {
      if (domain.parts.size() > 1) {
        for (const std::size_t p : of_axis_[1]) degrees[p] = degrees_[1][c][p];
        inputs[domain.parts[1].axis.input] =
            domain.parts[1].axis.value(domain.parts[1].from + static_cast<std::int32_t>(c));
      }
      for (const std::size_t rule : rules) {
        strengths[rule] = inference_.strength(rule, degrees.data());
        if (strengths[rule] > 0) fired[rule] = 1;
      }
      for (std::size_t o = 0; o < base_.outputs.size(); ++o) {
        const Answer answer = inference_.answer(o, strengths.data(), inputs.data());
        out_.values[o][r * columns + c] = answer.value;
        if (!answer.fired) out_.silent[o][r * columns + c] = 1;
      }
    }
  }

 private:
  const RuleBase& base_;
  const Inference& inference_;
  Surface& out_;
  std::vector<Degrees> degrees_;
  std::vector<double> fixed_;
  std::vector<std::vector<std::size_t>> of_axis_;
  std::vector<std::size_t> rules_;
};

}  // namespace

double Domain::Part::multiplicity(std::int32_t i) const {
  double n = 1;
  if (i == 0) n += from - axis.low;
  if (i == count() - 1) n += axis.high - to;
  return n;
}

Domain make_domain(const RuleBase& base, const Inference& inference, const std::vector<Fixed>& fixed,
                   int fewest_steps) {
  Domain domain;
  for (std::size_t i = 0; i < base.inputs.size(); ++i) {
    const auto same = [i](const Fixed& f) { return f.input == i; };
    const auto held = std::find_if(fixed.begin(), fixed.end(), same);
    domain.inputs.push_back(held == fixed.end() ? 0 : held->value);
    if (held == fixed.end()) domain.parts.push_back(make_part(base, inference, i, fewest_steps));
    if (domain.parts.size() > 2) {
      fail(base, base.inputs[i].place,
           fmt::format("a table has at most two inputs; fix one of the {} with --fix {}=VALUE",
                       base.inputs.size(), base.inputs[i].name));
    }
  }
  if (domain.parts.empty()) fail(base, {}, "every input is fixed; a table needs one or two free inputs");
  return domain;
}

Surface make_surface(const RuleBase& base, const Inference& inference, const Domain& domain) {
  Surface s;
  s.domain = domain;
  const auto points = static_cast<std::size_t>(domain.rows()) * static_cast<std::size_t>(domain.columns());
  s.values.assign(base.outputs.size(), std::vector<double>(points, 0.0));
  s.inputs = 1;
  for (const Domain::Part& part : domain.parts) s.inputs *= part.axis.count();
  s.fired.assign(base.rules.size(), false);
  s.silent.assign(base.outputs.size(), std::vector<char>(points, 0));
  const Evaluation evaluation(base, inference, s);
  std::atomic<std::int32_t> next{0};
  std::mutex mutex;
  const auto work = [&] {
    std::vector<char> fired(base.rules.size(), 0);
    for (std::int32_t row = next++; row < domain.rows(); row = next++) evaluation.row(row, fired);
    const std::lock_guard lock(mutex);
    for (std::size_t r = 0; r < fired.size(); ++r)
      if (fired[inference.same_as(r)] != 0) s.fired[r] = true;
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::max(1U, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
  return s;
}

}  // namespace whisker::rules
