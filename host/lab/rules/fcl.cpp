// .fcl files of IEC 61131-7, with the shapes that fuzzylite and jFuzzyLogic add.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host/lab/rules/fcl_tokens.hpp"
#include "host/lab/rules/read.hpp"
#include "host/lab/rules/rule_text.hpp"
#include "host/lab/rules/shapes.hpp"

namespace whisker::rules {
namespace {

/// What a rule block says of the aggregation of its outputs.
struct Accumulation {
  Word word;
  std::vector<std::size_t> rules;
};

constexpr std::string_view kSections[] = {"var_input", "var_output", "fuzzify",
                                          "defuzzify", "ruleblock",  "end_function_block"};

class FclReader {
 public:
  explicit FclReader(const Source& source) : source_(source), tokens_(source) {}

  RuleBase run() {
    base_.file = source_.file();
    tokens_.expect("function_block");
    const std::string first = lower_case(tokens_.peek().text);
    const auto* const end = std::end(kSections);
    if (std::find(std::begin(kSections), end, first) == end) base_.name = tokens_.next("a name").text;
    while (!tokens_.take("end_function_block")) section();
    if (!tokens_.ended()) source_.fail(tokens_.peek(), "only one function block can be compiled");
    accumulate();
    finish();
    return std::move(base_);
  }

 private:
  void section() {
    const Word word = tokens_.next("a section or END_FUNCTION_BLOCK");
    const std::string name = lower_case(word.text);
    if (name == "var_input") {
      declare(base_.inputs, "input");
    } else if (name == "var_output") {
      declare(base_.outputs, "output");
    } else if (name == "fuzzify") {
      fuzzify();
    } else if (name == "defuzzify") {
      defuzzify();
    } else if (name == "ruleblock") {
      rule_block();
    } else {
      source_.fail(word, fmt::format("'{}' cannot be compiled here", word.text));
    }
  }

  template <class Variable>
  void declare(std::vector<Variable>& all, const char* what) {
    while (!tokens_.take("end_var")) {
      do {
        const Word name = tokens_.next("a name");
        if (all.size() >= kMostVariables) source_.fail(name, "too many variables");
        check_new_name(source_, name, all, what);
        Variable v;
        v.name = name.text;
        v.place = source_.place(name.at);
        v.low = v.high = kNoRange;
        all.push_back(v);
      } while (tokens_.take(","));
      tokens_.expect(":");
      tokens_.expect("real");
      tokens_.expect(";");
    }
  }

  template <class Variable>
  Variable& named(std::vector<Variable>& all, const char* what) {
    const Word name = tokens_.next("a name");
    return all[source_.index_of(name, names_of(all), what)];
  }

  void fuzzify() {
    Input& input = named(base_.inputs, "input");
    while (!tokens_.take("end_fuzzify")) {
      const Word word = tokens_.next("END_FUZZIFY");
      const std::string key = lower_case(word.text);
      if (key == "term") {
        term(input.terms, -1);
      } else if (key == "range") {
        range(input.low, input.high);
      } else if (key == "lock") {
        tokens_.skip_to_semicolon();
      } else {
        source_.fail(word, fmt::format("'{}' cannot be compiled in FUZZIFY", word.text));
      }
    }
    if (std::isnan(input.low)) widen(input);
  }

  void defuzzify() {
    Output& output = named(base_.outputs, "output");
    output.silent_reason = "it has no DEFAULT";
    bool method = false;
    while (!tokens_.take("end_defuzzify")) {
      const Word word = tokens_.next("END_DEFUZZIFY");
      const std::string key = lower_case(word.text);
      if (key == "term") {
        term(output.terms, static_cast<long>(base_.inputs.size()));
      } else if (key == "range") {
        range(output.low, output.high);
      } else if (key == "method") {
        tokens_.expect(":");
        output.defuzzifier = this->method(tokens_.next("a method"));
        method = true;
        tokens_.expect(";");
      } else if (key == "accu") {
        tokens_.expect(":");
        output.aggregation = accumulation(tokens_.next("an accumulation"));
        tokens_.expect(";");
      } else if (key == "default") {
        silent(output);
      } else if (key == "lock") {
        tokens_.expect(":");
        const Word what = tokens_.next("RANGE");
        if (lower_case(what.text) != "range")
          source_.fail(what, "an output that keeps its previous value cannot be compiled");
        output.clamp = true;
        tokens_.expect(";");
      } else {
        source_.fail(word, fmt::format("'{}' cannot be compiled in DEFUZZIFY", word.text));
      }
    }
    if (!method) source_.fail(output.place, fmt::format("'{}' has no METHOD", output.name));
    if (std::isnan(output.low)) widen(output);
    output.merge_terms = output.defuzzifier == Defuzzifier::weighted_average;
  }

  /// Without RANGE: from the first to the last corner of the terms.
  template <class Variable>
  void widen(Variable& v) {
    std::vector<double> all;
    for (const Term& term : v.terms) {
      if (term.crisp) all.push_back(term.constant);
      for (const double x : term.crisp ? std::vector<double>{} : term.set.breaks()) all.push_back(x);
    }
    if (all.empty()) source_.fail(v.place, fmt::format("'{}' has no terms", v.name));
    v.low = *std::min_element(all.begin(), all.end());
    v.high = *std::max_element(all.begin(), all.end());
    const bool crisp = v.terms.front().crisp;
    if (crisp && v.low == v.high) v.high = v.low + 1;
    if (v.low == v.high)
      source_.fail(v.place, fmt::format("'{}' has no RANGE, and its terms span none", v.name));
  }

  void range(double& low, double& high) {
    tokens_.expect(":=");
    tokens_.expect("(");
    low = source_.number(tokens_.next("a number"));
    tokens_.expect("..");
    high = source_.number(tokens_.next("a number"));
    tokens_.expect(")");
    tokens_.expect(";");
  }

  void silent(Output& output) {
    tokens_.expect(":=");
    const Word value = tokens_.next("a number or NC");
    const bool keeps = lower_case(value.text) == "nc";
    if (!keeps && lower_case(value.text) != "nan") {
      output.silent = Silent::value;
      output.silent_value = source_.number(value);
    }
    if (tokens_.take("|") || keeps) {
      if (!keeps) tokens_.expect("nc");
      output.silent = Silent::undefined;
      output.silent_reason = "it keeps the previous answer there (DEFAULT NC)";
    }
    tokens_.expect(";");
  }

  Defuzzifier method(const Word& word) {
    static const std::map<std::string, Defuzzifier> kAll = {
        {"cog", Defuzzifier::centroid},      {"coa", Defuzzifier::bisector},
        {"lm", Defuzzifier::first_maximum},  {"rm", Defuzzifier::last_maximum},
        {"mm", Defuzzifier::mean_of_maxima}, {"cogs", Defuzzifier::weighted_average},
        {"cogss", Defuzzifier::weighted_sum}};
    const auto found = kAll.find(lower_case(word.text));
    if (found == kAll.end()) source_.fail(word, fmt::format("METHOD '{}' cannot be compiled", word.text));
    return found->second;
  }

  /// A normalized sum divides the whole set by its greatest value, which changes no defuzzified value.
  Or accumulation(const Word& word) {
    static const std::map<std::string, Or> kAll = {{"max", Or::maximum},      {"asum", Or::probabilistic_sum},
                                                   {"bsum", Or::bounded_sum}, {"nsum", Or::sum},
                                                   {"esum", Or::einstein},    {"hsum", Or::hamacher}};
    const auto found = kAll.find(lower_case(word.text));
    if (found == kAll.end()) source_.fail(word, fmt::format("ACCU '{}' cannot be compiled", word.text));
    return found->second;
  }

  void term(std::vector<Term>& terms, long inputs) {
    const Word name = tokens_.next("a name");
    if (terms.size() >= kMostTerms) source_.fail(name, "too many terms");
    check_new_name(source_, name, terms, "term");
    Term term;
    term.name = name.text;
    term.place = source_.place(name.at);
    tokens_.expect(":=");
    const Word first = tokens_.peek();
    std::vector<Word> words;
    while (!tokens_.take(";")) {
      const Word word = tokens_.next("';'");
      if (word != "(" && word != ")" && word != ",") words.push_back(word);
    }
    if (first == "(") {
      read_fll_shape(source_, {"Discrete", first.at}, words, -1, term);
    } else if (words.size() == 1) {
      read_fll_shape(source_, {"Constant", first.at}, words, inputs, term);
    } else if (!words.empty()) {
      const std::vector<Word> parameters(words.begin() + 1, words.end());
      if (!other_shape(words.front(), parameters, term))
        read_fll_shape(source_, words.front(), parameters, inputs, term);
    } else {
      source_.fail(first, "a term needs a number, points or a shape");
    }
    terms.push_back(std::move(term));
  }

  /// The shapes of jFuzzyLogic, which orders some parameters differently.
  bool other_shape(const Word& type, std::vector<Word> p, Term& out) {
    const std::string name = lower_case(type.text);
    const auto read = [&](std::string_view as) {
      read_fll_shape(source_, {as, type.at}, p, -1, out);
      return true;
    };
    if (name == "trian") return read("Triangle");
    if (name == "trape") return read("Trapezoid");
    if (name == "gauss") return read("Gaussian");
    if (name == "gbell" && p.size() == 3) {
      std::rotate(p.begin(), p.begin() + 2, p.end());
      return read("Bell");
    }
    if (name == "gauss2") return read("GaussianProduct");
    if ((name == "sigm" && p.size() == 2) || (name == "dsigm" && p.size() == 4)) {
      std::swap(p[0], p[1]);
      return read(name == "sigm" ? "Sigmoid" : "SigmoidDifference");
    }
    // Half of the width before the centre; fuzzylite's Cosine has the centre before the width.
    if (name == "cosine" && type != "Cosine" && p.size() == 2) {
      out.set = curve(Shape::cosine, {source_.number(p[1]), 2 * positive(p[0])});
      return true;
    }
    if (name == "singletons")
      source_.fail(type, "SINGLETONS cannot be compiled; write one number, or points such as (0, 0) (1, 1)");
    return false;
  }

  double positive(const Word& word) {
    const double x = source_.number(word);
    if (!(x > 0)) source_.fail(word, "the width must be above zero");
    return x;
  }

  /// One operator of a pair implies the other.
  void rule_block() {
    Rule operators;
    bool has_and = false;
    bool has_or = false;
    Accumulation accu;
    if (tokens_.peek_after() != ":" && lower_case(tokens_.peek().text) != "end_ruleblock" &&
        lower_case(tokens_.peek().text) != "rule")
      tokens_.next("a name");
    std::vector<std::pair<Word, Word>> texts;
    while (!tokens_.take("end_ruleblock")) {
      const Word word = tokens_.next("END_RULEBLOCK");
      const std::string key = lower_case(word.text);
      if (key == "rule") {
        if (base_.rules.size() + texts.size() >= kMostRules) source_.fail(word, "too many rules");
        texts.push_back({word, tokens_.rule_text()});
        continue;
      }
      tokens_.expect(":");
      const Word value = tokens_.next("an operator");
      if (key == "and") {
        operators.conjunction = conjunction(value);
        has_and = true;
      } else if (key == "or") {
        operators.disjunction = disjunction(value);
        has_or = true;
      } else if (key == "act") {
        const std::string act = lower_case(value.text);
        if (act != "min" && act != "prod")
          source_.fail(value, fmt::format("ACT '{}' cannot be compiled", value.text));
        operators.implication = act == "prod" ? And::product : And::minimum;
      } else if (key == "accu") {
        accu.word = value;
      } else {
        source_.fail(word, fmt::format("'{}' cannot be compiled in RULEBLOCK", word.text));
      }
      tokens_.expect(";");
    }
    if (has_and && !has_or) operators.disjunction = partner(operators.conjunction);
    if (has_or && !has_and) operators.conjunction = partner(operators.disjunction);
    for (const auto& [word, text] : texts) {
      Rule rule = operators;
      rule.place = source_.place(word.at);
      read_rule_text(source_, text, Dialect::fcl, base_, rule);
      accu.rules.push_back(base_.rules.size());
      base_.rules.push_back(std::move(rule));
    }
    if (!accu.word.empty()) accumulations_.push_back(accu);
  }

  static Or partner(And norm) {
    return norm == And::product              ? Or::probabilistic_sum
           : norm == And::bounded_difference ? Or::bounded_sum
                                             : Or::maximum;
  }
  static And partner(Or norm) {
    return norm == Or::probabilistic_sum ? And::product
           : norm == Or::bounded_sum     ? And::bounded_difference
                                         : And::minimum;
  }

  And conjunction(const Word& w) {
    static const std::map<std::string, And> kAll = {
        {"min", And::minimum},   {"prod", And::product},   {"bdif", And::bounded_difference},
        {"dprod", And::drastic}, {"eprod", And::einstein}, {"hprod", And::hamacher},
        {"nmin", And::nilpotent}};
    return norm(w, kAll);
  }
  Or disjunction(const Word& w) {
    static const std::map<std::string, Or> kAll = {{"max", Or::maximum},      {"asum", Or::probabilistic_sum},
                                                   {"bsum", Or::bounded_sum}, {"nsum", Or::bounded_sum},
                                                   {"dsum", Or::drastic},     {"esum", Or::einstein},
                                                   {"hsum", Or::hamacher},    {"nmax", Or::nilpotent}};
    return norm(w, kAll);
  }
  template <class Norm>
  Norm norm(const Word& w, const std::map<std::string, Norm>& all) {
    const auto found = all.find(lower_case(w.text));
    if (found == all.end()) source_.fail(w, fmt::format("unknown operator '{}'", w.text));
    return found->second;
  }

  /// ACCU of a rule block holds for every output that its rules conclude.
  void accumulate() {
    std::vector<const Word*> of(base_.outputs.size(), nullptr);
    for (const Accumulation& a : accumulations_) {
      for (const std::size_t r : a.rules) {
        for (const Conclusion& c : base_.rules[r].conclusions) {
          if (of[c.output] != nullptr && lower_case(of[c.output]->text) != lower_case(a.word.text))
            source_.fail(a.word, fmt::format("'{}' already has another ACCU", base_.outputs[c.output].name));
          of[c.output] = &a.word;
          base_.outputs[c.output].aggregation = accumulation(a.word);
        }
      }
    }
  }

  void finish() {
    for (const Output& output : base_.outputs)
      if (output.terms.empty())
        source_.fail(output.place, fmt::format("'{}' has no DEFUZZIFY block", output.name));
    for (const Input& input : base_.inputs)
      if (input.terms.empty())
        source_.fail(input.place, fmt::format("'{}' has no FUZZIFY block", input.name));
    check(source_, base_);
  }

  const Source& source_;
  FclTokens tokens_;
  RuleBase base_;
  std::vector<Accumulation> accumulations_;
};

}  // namespace

RuleBase read_fcl(const Source& source) {
  const std::string plain = without_fcl_comments(source.text());
  const Source same(plain, source.file());
  return FclReader(same).run();
}

}  // namespace whisker::rules
