// .fis files of MATLAB and Octave, versions 1 and 2.
#include <fmt/format.h>

#include <cmath>

#include "host/lab/rules/read.hpp"
#include "host/lab/rules/shapes.hpp"

namespace whisker::rules {
namespace {

/// The text inside quotes, or the word itself.
Word unquoted(Word w) {
  if (w.text.size() >= 2 && (w.text.front() == '\'' || w.text.front() == '"') &&
      w.text.back() == w.text.front())
    return {w.text.substr(1, w.text.size() - 2), w.at + 1};
  return w;
}

/// A comment starts at a % or # outside quotes.
Word without_comment(Word line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.text.size(); ++i) {
    const char c = line.text[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '%' || c == '#') {
      return {line.text.substr(0, i), line.at};
    }
  }
  return line;
}

/// MATLAB's name of an operator that Octave names otherwise.
Word matlab_name(Word w) {
  if (w == "algebraic_product") w.text = "prod";
  if (w == "algebraic_sum") w.text = "probor";
  return w;
}

class FisReader {
 public:
  explicit FisReader(const Source& source) : source_(source) {}

  RuleBase run() {
    base_.file = source_.file();
    for (const Word& whole : source_.lines()) {
      const Word line = trimmed(without_comment(whole));
      if (line.empty()) continue;
      if (line.text.front() == '[') {
        section(line);
      } else {
        read(line);
      }
    }
    finish();
    return std::move(base_);
  }

 private:
  enum class In { nothing, system, input, output, rules };

  void section(const Word& line) {
    if (line.text.back() != ']') source_.fail(line, "']' is missing");
    const Word name{line.text.substr(1, line.text.size() - 2), line.at + 1};
    const auto numbered = [&](std::string_view head, std::size_t count) {
      if (name.text.substr(0, head.size()) != head) return false;
      const Word number{name.text.substr(head.size()), name.at + head.size()};
      if (static_cast<std::size_t>(source_.whole(number, 1, kMostVariables)) != count + 1)
        source_.fail(name, fmt::format("section [{}] is out of order", name.text));
      return true;
    };
    if (name == "System") {
      in_ = In::system;
    } else if (name == "Rules") {
      in_ = In::rules;
    } else if (numbered("Input", base_.inputs.size())) {
      in_ = In::input;
      base_.inputs.push_back({std::string(name.text), source_.place(name.at), kNoRange, kNoRange, {}, {}});
    } else if (numbered("Output", base_.outputs.size())) {
      in_ = In::output;
      Output output;
      output.name = name.text;
      output.place = source_.place(name.at);
      output.low = output.high = kNoRange;
      base_.outputs.push_back(output);
    } else {
      source_.fail(name, fmt::format("unknown section [{}]", name.text));
    }
  }

  void read(const Word& line) {
    if (in_ == In::nothing) source_.fail(line, "the file must begin with a section such as [System]");
    if (in_ == In::rules) {
      if (lines_.size() >= kMostRules) source_.fail(line, "too many rules");
      lines_.push_back(line);
      return;
    }
    const Halves pair = split_at(line, '=');
    if (!pair.found) source_.fail(line, "a line is 'key=value'");
    const Word key = trimmed(pair.before);
    const Word value = trimmed(pair.after);
    switch (in_) {
      case In::system: return system(key, unquoted(value));
      case In::input: return variable(key, value, base_.inputs.back(), base_.inputs);
      case In::output: return variable(key, value, base_.outputs.back(), base_.outputs);
      case In::nothing:
      case In::rules: return;
    }
  }

  void system(const Word& key, const Word& value) {
    if (key == "Name") {
      base_.name = value.text;
    } else if (key == "Type") {
      if (value == "sugeno") {
        sugeno_ = true;
      } else if (value != "mamdani") {
        source_.fail(value, fmt::format("type '{}' cannot be compiled; only mamdani and sugeno", value.text));
      }
    } else if (key == "Version") {
      source_.number(value);
    } else if (key == "NumInputs" || key == "NumOutputs" || key == "NumRules") {
      counts_.push_back({key, value, in_, 0});
    } else if (key == "AndMethod") {
      and_ = matlab_name(value);
    } else if (key == "OrMethod") {
      or_ = matlab_name(value);
    } else if (key == "ImpMethod") {
      implication_ = matlab_name(value);
    } else if (key == "AggMethod") {
      aggregation_ = matlab_name(value);
    } else if (key == "DefuzzMethod") {
      defuzzifier_ = value;
    } else if (key != "NumMFs" && key != "DisableStructuralChecks") {
      source_.fail(key, fmt::format("unknown key '{}' of [System]", key.text));
    }
  }

  void range(const Word& value, double& low, double& high) {
    const std::vector<Word> words = bracketed(value);
    if (words.size() != 2) source_.fail(value, "a range is two numbers in brackets");
    low = source_.number(words[0]);
    high = source_.number(words[1]);
  }

  std::vector<Word> bracketed(const Word& value) {
    if (value.text.size() < 2 || value.text.front() != '[' || value.text.back() != ']')
      source_.fail(value, "numbers in brackets are expected");
    return split({value.text.substr(1, value.text.size() - 2), value.at + 1}, true);
  }

  template <class Variable>
  void variable(const Word& key, const Word& value, Variable& v, const std::vector<Variable>& all) {
    if (key == "Name") {
      const Word name = unquoted(value);
      check_new_name(source_, name, all, "variable");
      v.name = name.text;
      v.place = source_.place(name.at);
    } else if (key == "Range") {
      range(value, v.low, v.high);
    } else if (key == "NumMFs") {
      source_.whole(value, 0, kMostTerms);
      counts_.push_back({key, value, in_, all.size() - 1});
    } else if (key == "Enabled") {
      if (source_.number(value) != 1) source_.fail(value, "a disabled variable cannot be compiled");
    } else if (key.text.substr(0, 2) == "MF") {
      const Word number{key.text.substr(2), key.at + 2};
      if (static_cast<std::size_t>(source_.whole(number, 1, kMostTerms)) != v.terms.size() + 1)
        source_.fail(key, fmt::format("{} is out of order", key.text));
      term(value, v.terms);
    } else {
      extra(key, value, v);
    }
  }

  void extra(const Word& key, const Word& value, Input&) {
    if (key != "LockRange") source_.fail(key, fmt::format("unknown key '{}' of an input", key.text));
    source_.number(value);
  }
  /// Keys that fuzzylite adds.
  void extra(const Word& key, const Word& value, Output& v) {
    if (key == "Default") {
      if (value == "nan") return;
      v.silent_value = source_.number(value);
      v.silent = Silent::value;
    } else if (key == "LockRange") {
      v.clamp = source_.number(value) != 0;
    } else if (key == "LockPrevious") {
      if (source_.number(value) != 0)
        source_.fail(value, "an output that keeps its previous value cannot be compiled");
    } else {
      source_.fail(key, fmt::format("unknown key '{}' of an output", key.text));
    }
  }

  /// 'name':'trimf',[0 1 2]; rules name terms by number, so names may repeat.
  void term(const Word& value, std::vector<Term>& terms) {
    const std::size_t bracket = value.text.find('[');
    const Halves words = split_at({value.text.substr(0, bracket), value.at}, ':');
    if (bracket == std::string_view::npos || !words.found)
      source_.fail(value, "a term is 'NAME':'TYPE',[PARAMETERS]");
    const Word name = unquoted(trimmed(words.before));
    Word type = trimmed(words.after);
    if (type.empty() || type.text.back() != ',')
      source_.fail(type, "a comma is missing before the parameters");
    type.text.remove_suffix(1);
    type = unquoted(trimmed(type));
    Term t;
    t.name = name.text;
    t.place = source_.place(name.at);
    const long inputs = in_ == In::input ? -1 : static_cast<long>(base_.inputs.size());
    read_fis_shape(source_, type, bracketed({value.text.substr(bracket), value.at + bracket}), inputs, t);
    terms.push_back(std::move(t));
  }

  And conjunction(const Word& w) {
    if (w.empty()) source_.fail(Place{}, "[System] has no AndMethod");
    return static_cast<And>(source_.index_of(w,
                                             {"min", "prod", "bounded_difference", "drastic_product",
                                              "einstein_product", "hamacher_product", "nilpotent_minimum"},
                                             "operator"));
  }
  Or disjunction(const Word& w) {
    if (w.empty()) source_.fail(Place{}, "[System] has no OrMethod or AggMethod");
    return static_cast<Or>(source_.index_of(w,
                                            {"max", "probor", "bounded_sum", "sum", "drastic_sum",
                                             "einstein_sum", "hamacher_sum", "nilpotent_maximum"},
                                            "operator"));
  }

  /// MATLAB names no way but these, and answers with the middle of the range where no rule fires.
  void operators() {
    if (!sugeno_ && implication_.empty()) source_.fail(Place{}, "[System] has no ImpMethod");
    if (defuzzifier_.empty()) source_.fail(Place{}, "[System] has no DefuzzMethod");
    if (!sugeno_ && implication_ != "min" && implication_ != "prod")
      source_.fail(implication_,
                   fmt::format("implication '{}' cannot be compiled; only min and prod", implication_.text));
    for (Output& output : base_.outputs) {
      if (!sugeno_) output.aggregation = disjunction(aggregation_);
      if (output.aggregation == Or::drastic || output.aggregation == Or::nilpotent)
        source_.fail(aggregation_, fmt::format("aggregation '{}' cannot be compiled", aggregation_.text));
      const std::vector<std::string_view> names = {"centroid", "bisector", "mom",  "som",
                                                   "lom",      "wtaver",   "wtsum"};
      constexpr Defuzzifier kAll[] = {Defuzzifier::centroid,        Defuzzifier::bisector,
                                      Defuzzifier::mean_of_maxima,  Defuzzifier::smallest_maximum,
                                      Defuzzifier::largest_maximum, Defuzzifier::weighted_average,
                                      Defuzzifier::weighted_sum};
      const std::size_t which = source_.index_of(defuzzifier_, names, "defuzzifier");
      if ((which >= 5) != sugeno_)
        source_.fail(defuzzifier_, fmt::format("'{}' does not fit a {} system", defuzzifier_.text,
                                               sugeno_ ? "sugeno" : "mamdani"));
      output.defuzzifier = kAll[which];
      if (output.silent == Silent::undefined) {
        output.silent = Silent::value;
        output.silent_value = (output.low + output.high) / 2;
      }
    }
  }

  /// A number of lines that follow. All lines count, whatever it says.
  struct Count {
    Word key, given;
    In in;
    std::size_t variable;
  };
  void check_counts() {
    for (const Count& c : counts_) {
      const std::size_t found = c.key == "NumInputs"    ? base_.inputs.size()
                                : c.key == "NumOutputs" ? base_.outputs.size()
                                : c.key == "NumRules"   ? lines_.size()
                                : c.in == In::input     ? base_.inputs[c.variable].terms.size()
                                                        : base_.outputs[c.variable].terms.size();
      if (static_cast<std::size_t>(source_.whole(c.given, 0, 1000000)) == found) continue;
      source_.warn(c.given, fmt::format("{} is {}, but the file has {}, and all are read", c.key.text,
                                        c.given.text, found));
    }
  }

  void finish() {
    check_counts();
    operators();
    for (const Word& line : lines_) rule(line);
    check(source_, base_);
  }

  /// 1 -2, 1 0 (0.5) : 1
  void rule(const Word& line) {
    const Halves sides = split_at(line, ',');
    const Halves rest = split_at(sides.after, '(');
    const Halves weight = split_at(rest.after, ')');
    const Halves connection = split_at(weight.after, ':');
    if (!sides.found || !rest.found || !weight.found || !connection.found)
      source_.fail(line, "a rule is 'INPUT TERMS, OUTPUT TERMS (WEIGHT) : CONNECTION'");
    Rule rule;
    rule.place = source_.place(line.at);
    const Word weight_word = trimmed(weight.before);
    rule.weight = source_.number(weight_word);
    if (!(rule.weight >= 0 && rule.weight <= 1)) source_.fail(weight_word, "a weight must be from 0 to 1");
    rule.implication = implication_ == "prod" ? And::product : And::minimum;
    const bool any = source_.whole(trimmed(connection.after), 1, 2) == 2;
    condition(split(sides.before), any, line, rule);
    conclude(split(rest.before), line, rule);
    // MATLAB reads its operators only where a rule joins several inputs.
    if (rule.antecedent.size() > 1)
      (any ? void(rule.disjunction = disjunction(or_)) : void(rule.conjunction = conjunction(and_)));
    base_.rules.push_back(std::move(rule));
  }

  void condition(const std::vector<Word>& words, bool any, const Word& line, Rule& rule) {
    if (words.size() != base_.inputs.size())
      source_.fail(line, fmt::format("the rule names {} inputs, but the file has {}", words.size(),
                                     base_.inputs.size()));
    for (std::size_t i = 0; i < words.size(); ++i) {
      Step step;
      step.input = i;
      const double code = source_.number(words[i]);
      if (code == 0) continue;
      const double index = std::floor(std::abs(code));
      if (index < 1 || index > static_cast<double>(base_.inputs[i].terms.size()))
        source_.fail(words[i], fmt::format("'{}' has no term {}", base_.inputs[i].name, words[i].text));
      step.term = static_cast<std::size_t>(index) - 1;
      if (code < 0) step.hedges.push_back(Hedge::negation);
      const long hundredths = std::lround((std::abs(code) - index) * 100);
      if (std::abs(std::abs(code) - index - static_cast<double>(hundredths) / 100) > 1e-9)
        source_.fail(words[i], "unknown hedge");
      switch (hundredths) {
        case 0: break;
        case 5: step.hedges.push_back(Hedge::somewhat); break;
        case 20: step.hedges.push_back(Hedge::very); break;
        case 30: step.hedges.push_back(Hedge::cubed); break;
        case 40: step.hedges.push_back(Hedge::very_very); break;
        default: source_.fail(words[i], "this hedge cannot be compiled; only .05, .20, .30 and .40");
      }
      rule.antecedent.push_back(step);
      if (rule.antecedent.size() == 1) continue;
      Step joint;
      joint.kind = any ? Step::Kind::disjunction : Step::Kind::conjunction;
      rule.antecedent.push_back(joint);
    }
  }

  void conclude(const std::vector<Word>& words, const Word& line, Rule& rule) {
    if (words.size() != base_.outputs.size())
      source_.fail(line, fmt::format("the rule names {} outputs, but the file has {}", words.size(),
                                     base_.outputs.size()));
    for (std::size_t o = 0; o < words.size(); ++o) {
      const long count = static_cast<long>(base_.outputs[o].terms.size());
      const double number = source_.number(words[o]);
      if (number != std::floor(number)) source_.fail(words[o], "a hedge in a conclusion cannot be compiled");
      const long code = source_.whole(words[o], -count, count);
      if (code == 0) continue;
      if (code < 0 && sugeno_) source_.fail(words[o], "NOT of a constant or linear term has no meaning");
      rule.conclusions.push_back({o, static_cast<std::size_t>(std::abs(code)) - 1, code < 0});
    }
  }

  const Source& source_;
  RuleBase base_;
  std::vector<Word> lines_;
  std::vector<Count> counts_;
  Word and_, or_, implication_, aggregation_, defuzzifier_;
  bool sugeno_ = false;
  In in_ = In::nothing;
};

}  // namespace

RuleBase read_fis(const Source& source) { return FisReader(source).run(); }

}  // namespace whisker::rules
