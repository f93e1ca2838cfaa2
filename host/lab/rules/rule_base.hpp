/// A rule base of any format: variables, terms, rules and the operators that its format defines.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/lab/rules/membership.hpp"
#include "host/lab/rules/norms.hpp"

namespace whisker::rules {

/// Counted from 1.
struct Place {
  std::size_t line = 1;
  std::size_t column = 1;
};

struct Term {
  std::string name;
  Place place;
  Membership set;
  /// A crisp output term: constant + sum of coefficient times input. Then `set` has no meaning.
  bool crisp = false;
  double constant = 0;
  std::vector<double> coefficients;  ///< one for each input, or none
};

/// The ends of a range that the file does not give.
constexpr double kNoRange = std::numeric_limits<double>::quiet_NaN();

struct Input {
  std::string name;
  Place place;
  double low = 0;
  double high = 1;
  std::vector<Term> terms;
  std::optional<double> raw_per_unit;  ///< resolution that the file asks for
};

enum class Defuzzifier {
  centroid,
  bisector,
  mean_of_maxima,           ///< mean over all places of the maximum
  middle_of_first_maximum,  ///< fuzzylite: middle of the first place of the maximum
  first_maximum,
  last_maximum,
  smallest_maximum,  ///< MATLAB: the place of the maximum with the least absolute value
  largest_maximum,   ///< MATLAB: the place with the greatest absolute value
  weighted_average,
  weighted_sum,
};

/// The answer where no rule fires.
enum class Silent {
  value,     ///< `silent_value`
  undefined  ///< the file gives none: refused if there is such an input
};

struct Output {
  std::string name;
  Place place;
  double low = 0;
  double high = 1;
  std::vector<Term> terms;
  Defuzzifier defuzzifier = Defuzzifier::centroid;
  Or aggregation = Or::maximum;
  bool merge_terms = false;  ///< weighted average over terms, each with the aggregated strength of its rules
  Silent silent = Silent::undefined;
  double silent_value = 0;
  const char* silent_reason = "";  ///< why it is undefined
  bool clamp = false;              ///< limit the answer to [low, high]
  std::optional<double> raw_per_unit;
};

/// Its terms are constants or linear, and no sets.
constexpr bool is_weighted(Defuzzifier d) {
  return d == Defuzzifier::weighted_average || d == Defuzzifier::weighted_sum;
}

enum class Hedge { negation, very, cubed, very_very, somewhat, extremely, seldom };

/// Step of an antecedent in postfix order.
struct Step {
  enum class Kind { proposition, conjunction, disjunction, negation } kind = Kind::proposition;
  std::size_t input = 0;
  std::size_t term = 0;
  bool any = false;           ///< true whatever the input is
  std::vector<Hedge> hedges;  ///< the last applies first
};

struct Conclusion {
  std::size_t output = 0;
  std::size_t term = 0;
  bool negated = false;
};

struct Rule {
  Place place;
  std::vector<Step> antecedent;
  std::vector<Conclusion> conclusions;
  double weight = 1;
  And conjunction = And::minimum;
  Or disjunction = Or::maximum;
  And implication = And::minimum;  ///< minimum or product
};

struct RuleBase {
  std::string file;
  std::string name;
  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::vector<Rule> rules;
  double least_strength = 0;          ///< a rule fires with at least this strength, above zero
  std::vector<std::string> warnings;  ///< what is read otherwise than the file says, each with its place
};

/// Throws InputError at a place of the file.
[[noreturn]] void fail(const RuleBase& base, Place at, const std::string& what);

/// The degree after the hedges.
double hedged(double degree, const std::vector<Hedge>& hedges);

}  // namespace whisker::rules
