#include "host/rules/rule_words.hpp"

#include <fmt/format.h>

#include <vector>

namespace whisker::rules {
namespace {

const char* word(Hedge hedge) {
  switch (hedge) {
    case Hedge::negation: return "not ";
    case Hedge::very: return "very ";
    case Hedge::very_very: return "very very ";
    case Hedge::somewhat: return "somewhat ";
    case Hedge::extremely: return "extremely ";
    case Hedge::seldom: return "seldom ";
  }
  return "";
}

/// A part of a condition; `joint`: the operator that joins its parts, or none.
struct Part {
  std::string text;
  const char* joint = nullptr;
};

Part proposition(const RuleBase& base, const Step& step) {
  const Input& input = base.inputs[step.input];
  std::string text = input.name + " is ";
  for (const Hedge hedge : step.hedges) text += word(hedge);
  return {text + (step.any ? "any" : input.terms[step.term].name)};
}

std::string inside(const Part& part, const char* joint) {
  return part.joint != nullptr && part.joint != joint ? "(" + part.text + ")" : part.text;
}

}  // namespace

std::string words(const RuleBase& base, const Rule& rule) {
  static constexpr const char* kAnd = " and ";
  static constexpr const char* kOr = " or ";
  std::vector<Part> parts;
  for (const Step& step : rule.antecedent) {
    if (step.kind == Step::Kind::proposition) {
      parts.push_back(proposition(base, step));
      continue;
    }
    const char* const joint = step.kind == Step::Kind::conjunction ? kAnd : kOr;
    const Part right = parts.back();
    parts.pop_back();
    parts.back() = {inside(parts.back(), joint) + joint + inside(right, joint), joint};
  }
  std::string text = "if " + parts.back().text + " then ";
  for (std::size_t i = 0; i < rule.conclusions.size(); ++i) {
    const Conclusion& c = rule.conclusions[i];
    const Output& output = base.outputs[c.output];
    text += fmt::format("{}{} is {}{}", i == 0 ? "" : " and ", output.name, c.negated ? "not " : "",
                        output.terms[c.term].name);
  }
  if (rule.weight != 1) text += fmt::format(" with {:g}", rule.weight);
  return text;
}

}  // namespace whisker::rules
