#include "firmware/fuzzy/closed_form.hpp"

namespace whisker::fuzzy {
namespace {

/// An input between two neighbouring centres, seen from the nearer one.
struct Place {
  uint8_t cell;
  uint8_t near;      // index of the nearer centre
  uint8_t far;       // index of the other one
  int32_t fraction;  // from near (0) toward far; at most kFull / 2
};

/// kFull / gap of every cell, so that the target divides by no gap.
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
  const uint8_t cell = static_cast<uint8_t>((x >= kCentres[1] ? 1 : 0) + (x >= kCentres[2] ? 1 : 0) +
                                            (x >= kCentres[3] ? 1 : 0));
  const uint8_t next = static_cast<uint8_t>(cell + 1);
  const int32_t fraction = (int32_t{x} - kCentres[cell]) * kUnits.of[cell];
  if (fraction <= kFull / 2) return {cell, cell, next, fraction};
  return {cell, next, cell, kFull - fraction};
}

/// How strong the four rules of a cell are. With both fractions at most a half, min(1 - u, v) is v and
/// min(u, 1 - v) is u, so that only u and v need comparing.
struct Strengths {
  int32_t near;
  int32_t along_d;
  int32_t along_r;
  int32_t across;
};

Strengths strengths(int32_t u, int32_t v) noexcept {
  return u < v ? Strengths{kFull - v, u, v, u} : Strengths{kFull - u, u, v, v};
}

Q14 mean(const Q14 (&near)[kTerms], const Q14 (&far)[kTerms], const Place& r, const Strengths& w) noexcept {
  const int32_t sum = w.near * near[r.near].raw() + w.along_d * far[r.near].raw() +
                      w.along_r * near[r.far].raw() + w.across * far[r.far].raw();
  const int32_t total = kFull + 2 * w.across;
  return Q14::from_raw(static_cast<int16_t>((sum < 0 ? sum - total / 2 : sum + total / 2) / total));
}

}  // namespace

Response ClosedForm::operator()(Inputs in) const noexcept {
  const Place d = place<kDistanceCentres>(in.distance.raw());
  const Place r = place<kBiasCentres>(in.bias.raw());
  const Strengths w = strengths(d.fraction, r.fraction);
  return {mean(table_->turn[d.near], table_->turn[d.far], r, w),
          mean(table_->step[d.near], table_->step[d.far], r, w),
          {d.cell, r.cell}};
}

}  // namespace whisker::fuzzy
