#include "host/lab/rules/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/lab/rules/symmetry.hpp"

namespace whisker::rules {
namespace {

/// Changes below this share of the span are rounding.
constexpr double kLeastChange = 1e-9;
/// A direction is meant if at least this share of all changes follows it.
constexpr double kMeant = 0.9;
/// Neighbours that differ by more may be the two sides of a jump.
constexpr double kJump = 0.05;

const std::string& input_name(const Compiled& c, std::size_t part) {
  return c.base.inputs[c.surface.domain.parts[part].axis.input].name;
}

void add_rules(const Compiled& c, std::vector<Finding>& out) {
  for (const std::size_t r : c.never) {
    out.push_back(
        {Kind::never_fires, fmt::format("rule {} (line {}) never fires", r + 1, c.base.rules[r].place.line)});
  }
}

void add_gaps(const Compiled& c, std::vector<Finding>& out) {
  for (const Gap& gap : c.gaps) {
    out.push_back(
        {Kind::no_rule,
         fmt::format("no rule fires for '{}' at {:.3g} % of the inputs, within {} to {}; the answer there "
                     "is {:.6g}",
                     c.base.outputs[gap.output].name, 100 * gap.share, where(c, gap.low), where(c, gap.high),
                     gap.answer)});
  }
}

void add_symmetries(const Compiled& c, std::vector<Finding>& out) {
  for (const Symmetry& s : c.symmetries) {
    if (s.broken_by == 0) continue;
    out.push_back({Kind::broken_symmetry,
                   fmt::format("'{}' is nearly {} in '{}'; broken by {:.3g} % of the span at {}",
                               c.base.outputs[s.output].name, s.odd ? "antisymmetric" : "symmetric",
                               input_name(c, s.part), percent(c, s.output, s.broken_by), where(c, s.at))});
  }
}

void add_monotony(const Compiled& c, std::size_t o, std::size_t p, const Slopes& s,
                  std::vector<Finding>& out) {
  const double all = s.rises + s.falls;
  const bool rising = s.rises >= kMeant * all;
  if (!rising && s.falls < kMeant * all) return;
  const double against = rising ? s.greatest_fall : s.greatest_rise;
  if (against <= kLeastChange * c.spans[o]) return;
  out.push_back(
      {Kind::not_monotone,
       fmt::format("'{}' {} with '{}', but {} by up to {:.3g} % of the span, at {}", c.base.outputs[o].name,
                   rising ? "rises" : "falls", input_name(c, p), rising ? "falls" : "rises",
                   percent(c, o, against), where(c, rising ? s.fall_at : s.rise_at))});
}

/// The difference that remains of a step when the two inputs approach each other.
double remaining_jump(const Compiled& c, const Inference& inference, std::size_t o, std::size_t p,
                      const std::int32_t* raw) {
  const Domain& domain = c.surface.domain;
  std::vector<double> inputs = domain.inputs;
  for (std::size_t i = 0; i < domain.parts.size(); ++i)
    inputs[domain.parts[i].axis.input] = domain.parts[i].axis.value(raw[i]);
  const Axis& axis = domain.parts[p].axis;
  const auto at = [&](double x) {
    inputs[axis.input] = x;
    return inference(inputs)[o].value;
  };
  double a = axis.value(raw[p]);
  double b = axis.value(raw[p] + 1);
  double at_a = at(a);
  double at_b = at(b);
  for (int i = 0; i < 24; ++i) {
    const double x = (a + b) / 2;
    const double here = at(x);
    if (std::abs(here - at_a) > std::abs(at_b - here)) {
      b = x;
      at_b = here;
    } else {
      a = x;
      at_a = here;
    }
  }
  return std::abs(at_b - at_a);
}

void add_jump(const Compiled& c, const Inference& inference, std::size_t o, std::size_t p, const Slopes& s,
              std::vector<Finding>& out) {
  if (s.step <= kJump * c.spans[o]) return;
  const double jump = remaining_jump(c, inference, o, p, s.step_at);
  if (jump <= kJump * c.spans[o]) return;
  out.push_back({Kind::discontinuity,
                 fmt::format("'{}' jumps by {:.3g} % of the span along '{}', at {}", c.base.outputs[o].name,
                             percent(c, o, jump), input_name(c, p), where(c, s.step_at))});
}

}  // namespace

const char* name(Kind kind) {
  switch (kind) {
    case Kind::never_fires: return "never_fires";
    case Kind::no_rule: return "no_rule";
    case Kind::broken_symmetry: return "broken_symmetry";
    case Kind::not_monotone: return "not_monotone";
    case Kind::discontinuity: return "discontinuity";
  }
  return "?";
}

double percent(const Compiled& c, std::size_t output, double difference) {
  return c.spans[output] > 0 ? 100 * difference / c.spans[output] : 0;
}

std::string where(const Compiled& c, const std::int32_t* raw) {
  std::string text;
  for (std::size_t p = 0; p < c.surface.domain.parts.size(); ++p) {
    text += fmt::format("{}{} = {:.6g}", p == 0 ? "" : ", ", input_name(c, p),
                        c.surface.domain.parts[p].axis.value(raw[p]));
  }
  return text;
}

std::vector<Finding> findings(const Compiled& c) {
  std::vector<Finding> out;
  add_rules(c, out);
  add_gaps(c, out);
  add_symmetries(c, out);
  const Inference inference(c.base);
  for (std::size_t o = 0; o < c.base.outputs.size(); ++o) {
    for (std::size_t p = 0; c.spans[o] > 0 && p < c.surface.domain.parts.size(); ++p) {
      const Slopes s = slopes(c.surface, o, p);
      add_monotony(c, o, p, s, out);
      add_jump(c, inference, o, p, s, out);
    }
  }
  return out;
}

double rounding_effect(const Compiled& c, std::size_t output) {
  double sum = 0;
  for (std::size_t p = 0; p < c.surface.domain.parts.size(); ++p)
    sum += slopes(c.surface, output, p).step / 2;
  return sum;
}

}  // namespace whisker::rules
