#include "host/lab/rules/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/reader.hpp"
#include "host/lab/rules/canvas.hpp"

namespace whisker::rules {
namespace {

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

template <class Variable>
void check_range(const Source& source, const Variable& v) {
  if (std::isnan(v.low)) source.fail(v.place, fmt::format("'{}' has no range", v.name));
  if (!std::isfinite(v.low) || !std::isfinite(v.high) || !(v.low < v.high))
    source.fail(v.place, fmt::format("'{}': the range must be finite and not empty", v.name));
}

/// They are printed.
void check_names(const Source& source, const RuleBase& base) {
  const auto check = [&](const Place& place, const std::string& name) {
    if (one_line(name) != name) source.fail(place, fmt::format("'{}': a control character in a name", name));
  };
  const auto check_all = [&](const auto& variables) {
    for (const auto& v : variables) {
      check(v.place, v.name);
      for (const Term& term : v.terms) check(term.place, term.name);
    }
  };
  check(Place{}, base.name);
  check_all(base.inputs);
  check_all(base.outputs);
}

void check_output(const Source& source, const Output& output) {
  check_range(source, output);
  for (const Term& term : output.terms) {
    if (term.crisp == is_weighted(output.defuzzifier)) continue;
    source.fail(term.place,
                fmt::format("'{}' of '{}': {}", term.name, output.name,
                            term.crisp ? "a constant or linear term needs a weighted average or sum"
                                       : "a weighted average or sum needs constant or linear terms"));
  }
}

bool has_area(const Output& output, const Term& term) {
  const Canvas canvas({{term.set, false}}, output.low, output.high, false, true);
  return std::any_of(canvas.cells().begin(), canvas.cells().end(),
                     [](const Cell& cell) { return cell.sets[0].area > 0; });
}

/// All of the set is one place with the degree 1.
bool is_point(const Output& output, const Term& term) {
  const Membership& m = term.set;
  return m.linear_pieces() && m.left == 0 && m.right == 0 && !m.vertices.empty() &&
         m.vertices.front().x == m.vertices.back().x && m(m.vertices.front().x) == 1 &&
         m.vertices.front().x >= output.low && m.vertices.front().x <= output.high;
}

/// Sets without area: no integral sees them. Points alone are singletons, as a sampled centroid takes them.
void check_areas(const Source& source, RuleBase& base, std::size_t o) {
  Output& output = base.outputs[o];
  if (is_weighted(output.defuzzifier)) return;
  bool points = output.defuzzifier == Defuzzifier::centroid &&
                std::all_of(output.terms.begin(), output.terms.end(),
                            [&](const Term& term) { return is_point(output, term); });
  std::vector<bool> concluded(output.terms.size(), false);
  for (const Rule& rule : base.rules) {
    for (const Conclusion& c : rule.conclusions) {
      if (c.output != o) continue;
      points = points && !c.negated;
      if (!c.negated) concluded[c.term] = true;
    }
  }
  if (points) {
    source.warn(output.place,
                fmt::format("'{}': the terms are points without area; the answer is their average "
                            "weighted by the strengths",
                            output.name));
    for (Term& term : output.terms) term.crisp = true, term.constant = term.set.vertices.front().x;
    output.defuzzifier = Defuzzifier::weighted_average;
    output.merge_terms = true;
    return;
  }
  for (std::size_t t = 0; t < output.terms.size(); ++t) {
    const Term& term = output.terms[t];
    if (concluded[t] && !has_area(output, term))
      source.fail(term.place,
                  fmt::format("'{}' of '{}' has no area from {:g} to {:g}, so it changes no answer",
                              term.name, output.name, output.low, output.high));
  }
}

}  // namespace

void check(const Source& source, RuleBase& base) {
  check_names(source, base);
  if (base.inputs.empty()) source.fail(Place{}, "the file has no input");
  if (base.outputs.empty()) source.fail(Place{}, "the file has no output");
  if (base.rules.empty()) source.fail(Place{}, "the file has no rule");
  for (const Input& input : base.inputs) {
    check_range(source, input);
    for (const Output& output : base.outputs)
      if (input.name == output.name)
        source.fail(output.place, fmt::format("'{}' is an input and an output", output.name));
  }
  for (const Output& output : base.outputs) check_output(source, output);
  for (const Rule& rule : base.rules) {
    if (rule.antecedent.empty()) source.fail(rule.place, "the rule has no condition");
    if (rule.conclusions.empty()) source.fail(rule.place, "the rule has no conclusion");
  }
  for (std::size_t o = 0; o < base.outputs.size(); ++o) check_areas(source, base, o);
  base.warnings = source.warnings();
}

RuleBase parse_rules(std::string_view text, const std::string& name) {
  const Source source(text, name);
  const std::string low = lower_case(name);
  if (ends_with(low, ".fis")) return read_fis(source);
  if (ends_with(low, ".fll")) return read_fll(source);
  if (ends_with(low, ".fcl")) return read_fcl(source);
  if (ends_with(low, ".toml")) return read_toml(source);

  source.fail(Place{}, "the name of a rule file ends in .fis, .fll, .fcl or .toml");
}

RuleBase read_rules(const std::string& file) { return parse_rules(read_file(file), file); }

}  // namespace whisker::rules
