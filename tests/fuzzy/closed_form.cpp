#include "tests/fuzzy/closed_form.hpp"

#include <stddef.h>

namespace whisker::fuzzy {
namespace {

/// An input between two neighbouring centres, relative to the nearer one.
struct Place {
  uint8_t cell;
  int32_t near;        // index of the nearer centre
  ptrdiff_t to_other;  // 1 or -1
  int32_t fraction;    // from near (0) toward the other centre; at most kFull / 2
};

/// kFull / gap of every cell, so that the target needs no division.
struct UnitsPerStep {
  uint8_t of[kTerms - 1];
};

constexpr UnitsPerStep units_per_step(const int16_t (&centres)[kTerms]) noexcept {
  UnitsPerStep units{};
  for (int i = 0; i + 1 < kTerms; ++i)
    units.of[i] = static_cast<uint8_t>(kFull / (centres[i + 1] - centres[i]));
  return units;
}

template <const int16_t (&kCentres)[kTerms]>
Place place(int16_t input) noexcept {
  static constexpr UnitsPerStep kUnits = units_per_step(kCentres);
  constexpr int16_t kTop = kCentres[kTerms - 1];
  const int16_t x = input < kCentres[0] ? kCentres[0] : input > kTop ? kTop : input;
  const uint8_t cell = x < kCentres[2] ? (x < kCentres[1] ? 0 : 1) : (x < kCentres[3] ? 2 : 3);
  const int32_t fraction = (int32_t{x} - kCentres[cell]) * kUnits.of[cell];
  if (fraction <= kFull / 2) return {cell, cell, 1, fraction};
  return {cell, cell + 1, -1, kFull - fraction};
}

static_assert(sizeof(RuleBase) == 2 * sizeof(RuleBase::turn), "a rule's step lies behind its turn");

/// The four rules of a cell. With both fractions at most a half, their strengths min(1 - u, 1 - v),
/// min(1 - u, v), min(u, 1 - v) and min(u, v) are 1 - more, more, less and less.
struct Rules {
  const Q14* nearest;
  const Q14* along_more;
  const Q14* along_less;
  const Q14* across;
};

Q14 mean(const Rules& rules, int which, int32_t more, int32_t less) noexcept {
  const int32_t nearest = rules.nearest[which].raw();
  const int32_t sum = kFull * nearest + more * (rules.along_more[which].raw() - nearest) +
                      less * (int32_t{rules.along_less[which].raw()} + rules.across[which].raw());
  const int32_t half = kFull / 2 + less;
  return Q14::from_raw(static_cast<int16_t>((sum < 0 ? sum - half : sum + half) / (2 * half)));
}

}  // namespace

Response ClosedForm::operator()(Inputs in) const noexcept {
  const Place d = place<kDistanceCentres>(in.distance.raw());
  const Place r = place<kBiasCentres>(in.bias.raw());
  const Q14* const nearest = &table_->turn[d.near][r.near];
  const Q14* const along_d = nearest + d.to_other * kTerms;
  const Q14* const along_r = nearest + r.to_other;
  const Q14* const across = along_d + r.to_other;
  const bool d_more = d.fraction >= r.fraction;
  const Rules rules{nearest, d_more ? along_d : along_r, d_more ? along_r : along_d, across};
  const int32_t more = d_more ? d.fraction : r.fraction;
  const int32_t less = d_more ? r.fraction : d.fraction;
  return {mean(rules, 0, more, less), mean(rules, kTerms * kTerms, more, less), {d.cell, r.cell}};
}

}  // namespace whisker::fuzzy
