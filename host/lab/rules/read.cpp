#include "host/lab/rules/read.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/reader.hpp"

namespace whisker::rules {
namespace {

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

bool is_weighted(const Output& output) {
  return output.defuzzifier == Defuzzifier::weighted_average ||
         output.defuzzifier == Defuzzifier::weighted_sum;
}

template <class Variable>
void check_range(const Source& source, const Variable& v) {
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
    if (term.crisp == is_weighted(output)) continue;
    source.fail(term.place,
                fmt::format("'{}' of '{}': {}", term.name, output.name,
                            term.crisp ? "a constant or linear term needs a weighted average or sum"
                                       : "a weighted average or sum needs constant or linear terms"));
  }
}

}  // namespace

void check(const Source& source, const RuleBase& base) {
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
}

RuleBase parse_rules(std::string_view text, const std::string& name) {
  const Source source(text, name);
  const std::string low = lower(name);
  if (ends_with(low, ".fis")) return read_fis(source);
  if (ends_with(low, ".fll")) return read_fll(source);
  if (ends_with(low, ".fcl")) return read_fcl(source);
  if (ends_with(low, ".toml")) return read_toml(source);

  source.fail(Place{}, "the name of a rule file ends in .fis, .fll, .fcl or .toml");
}

RuleBase read_rules(const std::string& file) { return parse_rules(read_file(file), file); }

}  // namespace whisker::rules
