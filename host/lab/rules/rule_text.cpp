#include "host/lab/rules/rule_text.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace whisker::rules {
namespace {

const char* word(Hedge hedge) {
  switch (hedge) {
    case Hedge::negation: return "not ";
    case Hedge::very: return "very ";
    case Hedge::cubed: return "cubed ";
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

constexpr int kDeepest = 16;

std::vector<Word> tokens(Word text) {
  constexpr std::string_view kSingle = "(),;=";
  std::vector<Word> all;
  for (const Word& word : split(text)) {
    std::size_t from = 0;
    for (std::size_t i = 0; i <= word.text.size(); ++i) {
      const bool single = i < word.text.size() && kSingle.find(word.text[i]) != std::string_view::npos;
      if (!single && i < word.text.size()) continue;
      if (i > from) all.push_back({word.text.substr(from, i - from), word.at + from});
      if (single) all.push_back({word.text.substr(i, 1), word.at + i});
      from = i + 1;
    }
  }
  return all;
}

class RuleReader {
 public:
  RuleReader(const Source& source, Word text, Dialect dialect, const RuleBase& base, Rule& rule)
      : source_(source),
        dialect_(dialect),
        base_(base),
        rule_(rule),
        tokens_(tokens(text)),
        end_{{}, text.at + text.text.size()} {}

  void run() {
    expect("if");
    disjunction(0);
    expect("then");
    conclusions();
    if (take("with")) {
      const Word weight = next("a weight");
      rule_.weight = source_.number(weight);
      if (!(rule_.weight >= 0 && rule_.weight <= 1)) source_.fail(weight, "a weight must be from 0 to 1");
    }
    take(";");
    if (at_ < tokens_.size()) source_.fail(tokens_[at_], fmt::format("unexpected '{}'", tokens_[at_].text));
  }

 private:
  bool is(std::string_view keyword) const {
    if (at_ >= tokens_.size()) return false;
    const std::string_view text = tokens_[at_].text;
    return dialect_ == Dialect::fcl ? lower_case(text) == keyword : text == keyword;
  }
  bool take(std::string_view keyword) {
    const bool found = is(keyword);
    if (found) ++at_;
    return found;
  }
  void expect(std::string_view keyword) {
    if (take(keyword)) return;
    if (at_ >= tokens_.size())
      source_.fail(end_, fmt::format("the rule ends where '{}' is expected", keyword));
    source_.fail(tokens_[at_], fmt::format("'{}' is expected, but this is '{}'", keyword, tokens_[at_].text));
  }
  Word next(std::string_view what) {
    if (at_ >= tokens_.size()) source_.fail(end_, fmt::format("the rule ends where {} is expected", what));
    return tokens_[at_++];
  }

  void add(Step step) {
    if (rule_.antecedent.size() >= kMostSteps) source_.fail(rule_.place, "the condition is too long");
    rule_.antecedent.push_back(std::move(step));
  }
  void operate(Step::Kind kind) {
    Step step;
    step.kind = kind;
    add(std::move(step));
  }

  void disjunction(int depth) {
    conjunction(depth);
    while (take("or")) {
      conjunction(depth);
      operate(Step::Kind::disjunction);
    }
  }
  void conjunction(int depth) {
    operand(depth);
    while (take("and")) {
      operand(depth);
      operate(Step::Kind::conjunction);
    }
  }
  void operand(int depth) {
    if (depth > kDeepest)
      source_.fail(at_ < tokens_.size() ? tokens_[at_] : end_, "the condition is nested too deep");
    if (dialect_ == Dialect::fcl && take("not")) {
      const std::size_t from = rule_.antecedent.size();
      operand(depth + 1);
      if (rule_.antecedent.size() == from + 1) {
        std::vector<Hedge>& hedges = rule_.antecedent.back().hedges;
        hedges.insert(hedges.begin(), Hedge::negation);
      } else {
        operate(Step::Kind::negation);
      }
    } else if (take("(")) {
      disjunction(depth + 1);
      expect(")");
    } else {
      proposition();
    }
  }

  void proposition() {
    const Word variable = next("an input");
    for (const Output& output : base_.outputs)
      if (output.name == variable.text)
        source_.fail(variable, fmt::format("'{}' is an output; a rule cannot depend on it", variable.text));
    Step step;
    step.input = source_.index_of(variable, names_of(base_.inputs), "input");
    if (!take("=")) expect("is");
    hedges(step);
    if (!step.any) {
      const Word term = next("a term");
      const Input& input = base_.inputs[step.input];
      step.term = source_.index_of_term(term, names_of(input.terms), input.name);
    }
    add(std::move(step));
  }

  void hedges(Step& step) {
    for (int i = 0; i < kDeepest; ++i) {
      if (take("not")) {
        step.hedges.push_back(Hedge::negation);
      } else if (dialect_ == Dialect::fll && take("any")) {
        step.any = true;
        return;
      } else if (dialect_ == Dialect::fll && take("very")) {
        step.hedges.push_back(Hedge::very);
      } else if (dialect_ == Dialect::fll && take("somewhat")) {
        step.hedges.push_back(Hedge::somewhat);
      } else if (dialect_ == Dialect::fll && take("extremely")) {
        step.hedges.push_back(Hedge::extremely);
      } else if (dialect_ == Dialect::fll && take("seldom")) {
        step.hedges.push_back(Hedge::seldom);
      } else {
        return;
      }
    }
  }

  void conclusions() {
    do {
      const Word variable = next("an output");
      Conclusion c;
      c.output = source_.index_of(variable, names_of(base_.outputs), "output");
      if (!take("=")) expect("is");
      const Word term = next("a term");
      const Output& output = base_.outputs[c.output];
      for (const char* hedge : {"not", "any", "very", "somewhat", "extremely", "seldom"})
        if (term == hedge && dialect_ == Dialect::fll)
          source_.fail(term, "a hedge in a conclusion cannot be compiled");
      c.term = source_.index_of_term(term, names_of(output.terms), output.name);
      rule_.conclusions.push_back(c);
    } while (take("and") || take(","));
  }

  const Source& source_;
  Dialect dialect_;
  const RuleBase& base_;
  Rule& rule_;
  std::vector<Word> tokens_;
  Word end_;
  std::size_t at_ = 0;
};

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
    if (step.kind == Step::Kind::negation) {
      parts.back() = {"not (" + parts.back().text + ")"};
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

void read_rule_text(const Source& source, Word text, Dialect dialect, const RuleBase& base, Rule& out) {
  RuleReader(source, text, dialect, base, out).run();
}

}  // namespace whisker::rules
