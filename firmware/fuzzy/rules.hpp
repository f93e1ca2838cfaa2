/// The 25 rules. docs/rules.md gives the reason for each block.
#pragma once

#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy {

/// The output terms, under their names in the source.
// NOLINTBEGIN(readability-identifier-naming)
namespace turn_terms {
constexpr Q14 TRVB = Q14::ratio(-3, 2);  ///< turn right, very big
constexpr Q14 TRB = Q14::ratio(-3, 4);
constexpr Q14 Z = Q14::ratio(0, 1);
constexpr Q14 TLB = Q14::ratio(3, 4);
constexpr Q14 TLVB = Q14::ratio(3, 2);
}  // namespace turn_terms

namespace step_terms {
constexpr Q14 VS = Q14::ratio(3, 10);
constexpr Q14 S = Q14::ratio(6, 10);
constexpr Q14 M = Q14::ratio(10, 10);
constexpr Q14 B = Q14::ratio(14, 10);
constexpr Q14 VB = Q14::ratio(17, 10);
}  // namespace step_terms
// NOLINTEND(readability-identifier-naming)

constexpr RuleBase default_rules() noexcept {
  using namespace turn_terms;
  using namespace step_terms;
  // clang-format off
  return {
    // SA   R: RVB    RB    CE    LB    LVB         D
    {       { TLVB,  TLVB,  Z,   TRVB,  TRVB },  // VS
            { TLVB,  TLB,   Z,   TRB,   TRVB },  // S
            { TLB,   TLB,   Z,   TRB,   TRB  },  // M
            { TLB,   Z,     Z,   Z,     TRB  },  // B
            { Z,     Z,     Z,   Z,     Z    }}, // VB

    // SD   R: RVB    RB    CE    LB    LVB         D
    {       { VS,    VS,    VS,   VS,   VS   },  // VS
            { S,     S,     S,    S,    S    },  // S
            { M,     M,     M,    M,    M    },  // M
            { M,     B,     B,    B,    M    },  // B
            { B,     VB,    VB,   VB,   B    }}, // VB
  };
  // clang-format on
}

inline constexpr RuleBase kRules = default_rules();

/// SA of a mirrored world is the mirrored SA, so SA is 0 if R is centred.
constexpr bool antisymmetric(const Q14 (&picture)[kTerms][kTerms]) noexcept {
  for (int d = 0; d < kTerms; ++d)
    for (int r = 0; r < kTerms; ++r)
      if (picture[d][r] != -picture[d][kTerms - 1 - r]) return false;
  return true;
}

constexpr bool symmetric(const Q14 (&picture)[kTerms][kTerms]) noexcept {
  for (int d = 0; d < kTerms; ++d)
    for (int r = 0; r < kTerms; ++r)
      if (picture[d][r] != picture[d][kTerms - 1 - r]) return false;
  return true;
}

static_assert(antisymmetric(kRules.turn) && symmetric(kRules.step));
static_assert(step_terms::M - step_terms::VS == step_terms::VB - step_terms::M);
static_assert(step_terms::M - step_terms::S == step_terms::B - step_terms::M);

}  // namespace whisker::fuzzy
