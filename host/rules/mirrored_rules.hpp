/// Rule bases of the core's variables that a search can change: five terms a variable, mirrored in R by
/// construction.
#pragma once

#include <array>
#include <string>

#include "firmware/fuzzy/variables.hpp"
#include "host/rules/rule_base.hpp"

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

}  // namespace whisker::rules
