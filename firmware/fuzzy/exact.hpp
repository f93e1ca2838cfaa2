/// Exact inference in integers; only the last step rounds. The strength of a rule is w = min(muD, muR), and
/// an output is sum(w * centre) / sum(w) over the 25 rules, rounded to the nearest raw unit, ties away from
/// zero. It is the reference for the engines and generates the tables.
#pragma once

#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy {

/// Membership of x in term `i`: 1 at its own centre, 0 at its neighbours', linear between; shoulders outside.
constexpr int32_t membership(const int16_t (&centres)[kTerms], int i, int32_t x) noexcept {
  const int32_t own = centres[i];
  if (x == own) return kFull;
  const int neighbour = x < own ? i - 1 : i + 1;
  if (neighbour < 0 || neighbour == kTerms) return kFull;
  const int32_t away = x < own ? own - x : x - own;
  const int32_t gap = x < own ? own - centres[neighbour] : centres[neighbour] - own;
  return away < gap ? (gap - away) * (kFull / gap) : 0;
}

/// The last cell between neighbouring centres whose lower end is at most x.
constexpr uint8_t rule_cell(const int16_t (&centres)[kTerms], int32_t x) noexcept {
  uint8_t cell = 0;
  for (int i = 1; i < kTerms - 1; ++i)
    if (x >= centres[i]) cell = static_cast<uint8_t>(i);
  return cell;
}

class Exact {
 public:
  using Table = RuleBase;
  explicit constexpr Exact(const RuleBase& rules) noexcept : rules_(&rules) {}
  Exact(const RuleBase&&) = delete;

  constexpr Response operator()(Inputs in) const noexcept {
    const int32_t d = in.distance.raw();
    const int32_t r = in.bias.raw();
    int32_t turn = 0;
    int32_t step = 0;
    int32_t total = 0;
    for (int i = 0; i < kTerms; ++i) {
      const int32_t mu_d = membership(kDistanceCentres, i, d);
      for (int j = 0; j < kTerms; ++j) {
        const int32_t mu_r = membership(kBiasCentres, j, r);
        const int32_t w = mu_d < mu_r ? mu_d : mu_r;
        turn += w * rules_->turn[i][j].raw();
        step += w * rules_->step[i][j].raw();
        total += w;
      }
    }
    return {quotient(turn, total),
            quotient(step, total),
            {rule_cell(kDistanceCentres, d), rule_cell(kBiasCentres, r)}};
  }

 private:
  static constexpr Q14 quotient(int32_t sum, int32_t weight) noexcept {
    return Q14::from_raw(narrow<int16_t>(divide_rounded(sum, weight)));
  }
  const RuleBase* rules_;
};

}  // namespace whisker::fuzzy
