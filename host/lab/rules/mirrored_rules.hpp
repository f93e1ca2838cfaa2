/// Rule bases of the core's variables that a search can change: five terms a variable, mirrored in R by
/// construction.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "firmware/fuzzy/variables.hpp"
#include "host/lab/rules/response.hpp"
#include "host/lab/rules/rule_base.hpp"

namespace whisker::rules {

constexpr std::size_t kTerms = fuzzy::kTerms;

/// In a mirrored world (R -> -R), SA is the mirrored SA and SD the same SD. Terms count from 0 in the order
/// of docs/rules.md, and have the core's names.
struct MirroredRules {
  std::array<double, kTerms> distance{};  ///< centres of D, rising
  std::array<double, 2> bias{};           ///< centres of LB and LVB, rising, above 0; RB and RVB mirror them
  std::array<double, 2> turn{};       ///< values of TLB and TLVB, rising, above 0; TRB and TRVB mirror them
  std::array<double, kTerms> step{};  ///< values of the terms of SD
  /// Rows: terms of D. Columns: R is RVB, RB. From -2, TRVB, to 2, TLVB. LB and LVB mirror it, CE is Z.
  std::array<std::array<int, 2>, kTerms> turns{};
  /// Rows: terms of D. Columns: R is RVB, RB, CE. Term of SD. LB and LVB mirror it.
  std::array<std::array<int, 3>, kTerms> steps{};
};

/// The core's own.
MirroredRules core_rules();

/// Throws InputError if the rule base has no such form. It must come from a .toml file.
MirroredRules mirrored_rules(const RuleBase& base);

/// As a file in TOML that reads as two pictures of 5 x 5 terms. Each line of `comment` becomes a comment at
/// the top; `name` is that of the rule base.
std::string to_toml(const MirroredRules& rules, const std::string& name, const std::string& comment);

/// What a search keeps: centres of an input and values of SA this far apart at least, and within the part of
/// the inputs that the core's grid covers.
constexpr double kLeastGap = 1.0;
constexpr double kLeastTurnGap = 0.125;
constexpr double kGreatestTurn = 1.5;
/// Greatest error of the look-up that a search admits, as a share of the span of the output's terms.
constexpr double kMostLookUpError = 0.02;

/// The table of these rules; none if the look-up errs by more than kMostLookUpError. Throws as response().
std::optional<Response> admitted(const MirroredRules& rules);

/// Equal seeds give equal sequences on every machine.
class Mutation {
 public:
  /// steps: it also changes the rules of SD.
  Mutation(std::uint64_t seed, bool steps) : random_(seed), steps_(steps) {}

  /// The rules with one to five small changes: a rule by one term, the turns of a row or a column of rules by
  /// one term, a centre by at most 1, or a value of SA by at most 0.25. The terms of SD keep their values.
  MirroredRules operator()(MirroredRules rules);

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  int sign() { return below(2) == 0 ? -1 : 1; }
  bool change(MirroredRules& rules);  ///< false: it does not fit
  bool change_step(MirroredRules& rules);
  bool change_centre(MirroredRules& rules);

  std::mt19937_64 random_;
  bool steps_;
};

}  // namespace whisker::rules
