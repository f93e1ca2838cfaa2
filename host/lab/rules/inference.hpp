/// Inference in double precision: the reference of every table.
#pragma once

#include <cstddef>
#include <vector>

#include "host/lab/rules/aggregate.hpp"
#include "host/lab/rules/canvas.hpp"
#include "host/lab/rules/rule_base.hpp"

namespace whisker::rules {

struct Answer {
  double value = 0;
  bool fired = false;  ///< false: no rule fires, and the value is the output's silent value
};

/// Accurate to 1e-9 of the output's range. The rule base must outlive it.
class Inference {
 public:
  explicit Inference(const RuleBase& base);

  /// A term of an input with its hedges: all that rules see of the input.
  struct Proposition {
    std::size_t input;
    std::size_t term;
    bool any;
    std::vector<Hedge> hedges;
    double operator()(const RuleBase& base, double x) const;
  };
  const std::vector<Proposition>& propositions() const { return propositions_; }

  /// The first rule with the same strength at every input.
  std::size_t same_as(std::size_t rule) const { return same_as_[rule]; }

  /// Strength of a rule, by the degree of every proposition; 0 if below the least strength.
  double strength(std::size_t rule, const double* degrees) const;
  /// True if the rule's strength is zero whenever the proposition's degree is.
  bool needs(std::size_t rule, std::size_t proposition) const;

  /// By the strengths of all rules that are their own same_as(); the inputs matter to crisp terms only.
  Answer answer(std::size_t output, const double* strengths, const double* inputs) const;

  /// All outputs at one input.
  std::vector<Answer> operator()(const std::vector<double>& inputs) const;

 private:
  struct Part {        ///< a conclusion of a rule for one output
    std::size_t rule;  ///< the first with this condition
    std::size_t term;
    std::size_t set;
    bool product;
    double times;  ///< equal parts that count as one
  };
  struct Prepared {
    std::vector<Part> parts;
    std::vector<Canvas> canvas;  ///< none for crisp terms; a second one for weak rules
    std::size_t sets = 0;
  };
  void prepare(std::size_t output);
  bool weighted(const Output& output, const Prepared& prepared, const double* strengths, const double* inputs,
                double& out) const;
  void activate(const Output& output, const Prepared& prepared, const double* strengths,
                std::vector<Activated>& out) const;

  const RuleBase& base_;
  std::vector<Proposition> propositions_;
  std::vector<std::vector<std::size_t>> steps_;  ///< proposition of each step of each rule
  std::vector<bool> conjunctive_;                ///< the antecedent is one conjunction
  std::vector<std::size_t> same_as_;
  std::vector<Prepared> outputs_;
};

}  // namespace whisker::rules
