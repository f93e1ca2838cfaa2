#include "host/lab/play/rule_faults.hpp"

namespace whisker::play {
namespace {

using fuzzy::kTerms;

constexpr int kCentre = kTerms / 2;

int size_of(Q14 x) { return x.raw() < 0 ? -x.raw() : x.raw(); }

std::uint32_t faults_at(const fuzzy::RuleBase& rules, int d, int r) {
  const Q14 turn = rules.turn[d][r];
  const Q14 step = rules.step[d][r];
  const int mirror = kTerms - 1 - r;
  std::uint32_t faults = 0;
  if (turn.raw() != -rules.turn[d][mirror].raw()) faults |= kTurnNotMirrored;
  if (step != rules.step[d][mirror]) faults |= kStepNotMirrored;
  // Terms below the centre: the right side is nearer, and a left turn (positive) leads away from it.
  if (r < kCentre ? turn < Q14{} : r > kCentre && turn > Q14{}) faults |= kTurnsTowardsNearer;
  if (d + 1 < kTerms) {
    if (size_of(turn) < size_of(rules.turn[d + 1][r])) faults |= kTurnsLessNear;
    if (step > rules.step[d + 1][r]) faults |= kStepsLongerNear;
  }
  return faults;
}

}  // namespace

std::uint32_t rule_faults(const fuzzy::RuleBase& rules) {
  std::uint32_t faults = 0;
  for (int d = 0; d < kTerms; ++d)
    for (int r = 0; r < kTerms; ++r) faults |= faults_at(rules, d, r);
  return faults;
}

bool rule_at_fault(const fuzzy::RuleBase& rules, int d, int r) { return faults_at(rules, d, r) != 0; }

}  // namespace whisker::play
