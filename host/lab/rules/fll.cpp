// .fll files of fuzzylite 6.
#include <fmt/format.h>

#include <limits>

#include "host/lab/rules/read.hpp"
#include "host/lab/rules/rule_text.hpp"
#include "host/lab/rules/shapes.hpp"

namespace whisker::rules {
namespace {

/// fuzzylite triggers no rule below this degree.
constexpr double kLeastStrength = 1e-6;

struct Block {
  And conjunction = And::minimum;
  Or disjunction = Or::maximum;
  And implication = And::minimum;
  bool has_conjunction = false, has_disjunction = false, has_implication = false;
  bool enabled = true;
};

struct Pending {
  Word text;
  std::size_t block;
};

/// What check() cannot see afterwards.
struct OutputNotes {
  bool aggregated = false;
  bool defuzzified = false;
  bool lock_previous = false;
};

bool read_boolean(const Source& source, const Word& value) {
  if (value == "true") return true;
  if (value != "false") source.fail(value, fmt::format("'{}' must be true or false", value.text));
  return false;
}

And read_and(const Source& source, const Word& value) {
  const std::vector<std::string_view> names = {"Minimum",         "AlgebraicProduct", "BoundedDifference",
                                               "DrasticProduct",  "EinsteinProduct",  "HamacherProduct",
                                               "NilpotentMinimum"};
  return static_cast<And>(source.index_of(value, names, "T-norm"));
}

Or read_or(const Source& source, const Word& value) {
  // A normalized sum equals a bounded sum.
  if (value == "NormalizedSum") return Or::bounded_sum;
  const std::vector<std::string_view> names = {"Maximum",      "AlgebraicSum",    "BoundedSum",
                                               "UnboundedSum", "DrasticSum",      "EinsteinSum",
                                               "HamacherSum",  "NilpotentMaximum"};
  return static_cast<Or>(source.index_of(value, names, "S-norm"));
}

template <class Variable>
void read_range(const Source& source, const Word& value, Variable& v) {
  const std::vector<Word> words = split(value);
  if (words.size() != 2) source.fail(value, "a range is two numbers");
  v.low = source.number(words[0]);
  v.high = source.number(words[1]);
}

class FllReader {
 public:
  explicit FllReader(const Source& source) : source_(source) {}

  RuleBase run() {
    base_.file = source_.file();
    base_.least_strength = kLeastStrength;
    for (const Word& whole : source_.lines()) {
      const Word line = trimmed(split_at(whole, '#').before);
      if (line.empty()) continue;
      const Halves pair = split_at(line, ':');
      if (!pair.found) source_.fail(line, "a line is 'key: value'");
      read(trimmed(pair.before), trimmed(pair.after));
    }
    finish();
    return std::move(base_);
  }

 private:
  enum class In { engine, input, output, block };

  void read(const Word& key, const Word& value) {
    if (key == "Engine") {
      base_.name = value.text;
    } else if (key == "InputVariable") {
      in_ = In::input;
      if (base_.inputs.size() >= kMostVariables) source_.fail(key, "too many inputs");
      check_new_name(source_, value, base_.inputs, "input");
      base_.inputs.push_back({std::string(value.text), source_.place(value.at), kNoRange, kNoRange, {}, {}});
    } else if (key == "OutputVariable") {
      in_ = In::output;
      if (base_.outputs.size() >= kMostVariables) source_.fail(key, "too many outputs");
      check_new_name(source_, value, base_.outputs, "output");
      Output output;
      output.name = value.text;
      output.place = source_.place(value.at);
      output.low = output.high = kNoRange;
      base_.outputs.push_back(output);
      notes_.emplace_back();
    } else if (key == "RuleBlock") {
      in_ = In::block;
      blocks_.emplace_back();
    } else if (key != "description") {
      property(key, value);
    }
  }

  void property(const Word& key, const Word& value) {
    switch (in_) {
      case In::engine: source_.fail(key, fmt::format("unexpected key '{}'", key.text));
      case In::input: return input(key, value, base_.inputs.back());
      case In::output: return output(key, value, base_.outputs.back(), notes_.back());
      case In::block: return block(key, value, blocks_.back());
    }
  }

  void input(const Word& key, const Word& value, Input& v) {
    if (key == "range") {
      read_range(source_, value, v);
    } else if (key == "enabled") {
      if (!read_boolean(source_, value)) source_.fail(value, "a disabled variable cannot be compiled");
    } else if (key == "lock-range") {
      read_boolean(source_, value);
    } else if (key == "term") {
      term(value, v.terms, -1);
    } else {
      source_.fail(key, fmt::format("unknown key '{}' of an input", key.text));
    }
  }

  void output(const Word& key, const Word& value, Output& v, OutputNotes& notes) {
    if (key == "range") {
      read_range(source_, value, v);
    } else if (key == "enabled") {
      if (!read_boolean(source_, value)) source_.fail(value, "a disabled variable cannot be compiled");
    } else if (key == "lock-range") {
      v.clamp = read_boolean(source_, value);
    } else if (key == "lock-previous" || key == "lock-valid") {
      notes.lock_previous = read_boolean(source_, value);
    } else if (key == "default") {
      if (value == "nan") return;
      v.silent = Silent::value;
      v.silent_value = source_.number(value);
    } else if (key == "aggregation" || key == "accumulation") {
      notes.aggregated = value != "none";
      if (notes.aggregated) v.aggregation = read_or(source_, value);
      if (v.aggregation == Or::drastic || v.aggregation == Or::nilpotent)
        source_.fail(value, fmt::format("aggregation by {} cannot be compiled", value.text));
    } else if (key == "defuzzifier") {
      notes.defuzzified = true;
      v.defuzzifier = defuzzifier(value);
    } else if (key == "term") {
      term(value, v.terms, static_cast<long>(base_.inputs.size()));
    } else {
      source_.fail(key, fmt::format("unknown key '{}' of an output", key.text));
    }
  }

  Defuzzifier defuzzifier(const Word& value) {
    const std::vector<Word> words = split(value);
    if (words.empty()) source_.fail(value, "a defuzzifier is missing");
    const std::vector<std::string_view> names = {"Centroid",          "Bisector",         "MeanOfMaximum",
                                                 "SmallestOfMaximum", "LargestOfMaximum", "WeightedAverage",
                                                 "WeightedSum"};
    constexpr Defuzzifier kAll[] = {
        Defuzzifier::centroid,      Defuzzifier::bisector,     Defuzzifier::middle_of_first_maximum,
        Defuzzifier::first_maximum, Defuzzifier::last_maximum, Defuzzifier::weighted_average,
        Defuzzifier::weighted_sum};
    const std::size_t which = source_.index_of(words[0], names, "defuzzifier");
    if (words.size() > 1 && which < 5) source_.whole(words[1], 1, 1000000);
    if (words.size() > 1 && which >= 5 && words[1] != "TakagiSugeno" && words[1] != "Automatic")
      source_.fail(words[1],
                   fmt::format("a weighted defuzzifier of type '{}' cannot be compiled", words[1].text));
    return kAll[which];
  }

  void block(const Word& key, const Word& value, Block& b) {
    if (key == "rule") {
      if (pending_.size() >= kMostRules) source_.fail(key, "too many rules");
      pending_.push_back({value, blocks_.size() - 1});
    } else if (key == "enabled") {
      b.enabled = read_boolean(source_, value);
    } else if (key == "conjunction") {
      b.has_conjunction = value != "none";
      if (b.has_conjunction) b.conjunction = read_and(source_, value);
    } else if (key == "disjunction") {
      b.has_disjunction = value != "none";
      if (b.has_disjunction) b.disjunction = read_or(source_, value);
    } else if (key == "implication") {
      b.has_implication = value != "none";
      if (b.has_implication) b.implication = read_and(source_, value);
      if (b.implication != And::minimum && b.implication != And::product)
        source_.fail(value, fmt::format("implication by {} cannot be compiled", value.text));
    } else if (key == "activation") {
      if (value != "General" && value != "none")
        source_.fail(value, fmt::format("activation '{}' cannot be compiled; only General", value.text));
    } else {
      source_.fail(key, fmt::format("unknown key '{}' of a rule block", key.text));
    }
  }

  void term(const Word& value, std::vector<Term>& terms, long inputs) {
    const std::vector<Word> words = split(value);
    if (words.size() < 2) source_.fail(value, "a term is 'NAME SHAPE PARAMETERS'");
    if (terms.size() >= kMostTerms) source_.fail(value, "too many terms");
    check_new_name(source_, words[0], terms, "term");
    Term term;
    term.name = words[0].text;
    term.place = source_.place(words[0].at);
    read_fll_shape(source_, words[1], {words.begin() + 2, words.end()}, inputs, term);
    terms.push_back(std::move(term));
  }

  void finish() {
    for (std::size_t o = 0; o < base_.outputs.size(); ++o) {
      Output& output = base_.outputs[o];
      if (!notes_[o].defuzzified)
        source_.fail(output.place, fmt::format("'{}' has no defuzzifier", output.name));
      if (!is_weighted(output.defuzzifier) && !notes_[o].aggregated)
        source_.fail(output.place, fmt::format("'{}' has no aggregation", output.name));
      output.silent_reason = "its default is nan";
      if (notes_[o].lock_previous) {
        output.silent = Silent::undefined;
        output.silent_reason = "it keeps the previous answer there (lock-previous)";
      }
    }
    for (const Pending& p : pending_) rule(p);
    check(source_, base_);
  }

  void rule(const Pending& pending) {
    const Block& b = blocks_[pending.block];
    if (!b.enabled) return;
    Rule rule;
    rule.place = source_.place(pending.text.at);
    rule.conjunction = b.conjunction;
    rule.disjunction = b.disjunction;
    rule.implication = b.implication;
    read_rule_text(source_, pending.text, Dialect::fll, base_, rule);
    for (const Step& step : rule.antecedent) {
      if (step.kind == Step::Kind::conjunction && !b.has_conjunction)
        source_.fail(rule.place, "the rule block has no conjunction");
      if (step.kind == Step::Kind::disjunction && !b.has_disjunction)
        source_.fail(rule.place, "the rule block has no disjunction");
    }
    for (const Conclusion& c : rule.conclusions)
      if (!b.has_implication && !base_.outputs[c.output].terms[c.term].crisp)
        source_.fail(rule.place, "the rule block has no implication");
    base_.rules.push_back(std::move(rule));
  }

  const Source& source_;
  RuleBase base_;
  std::vector<OutputNotes> notes_;
  std::vector<Block> blocks_;
  std::vector<Pending> pending_;
  In in_ = In::engine;
};

}  // namespace

RuleBase read_fll(const Source& source) { return FllReader(source).run(); }

}  // namespace whisker::rules
