#include "host/rules/mutation.hpp"

#include <algorithm>

#include "host/rules/read.hpp"

namespace whisker::rules {
namespace {

constexpr double kFirstCentre = fuzzy::kDistanceLow / 128.0, kLastCentre = fuzzy::kDistanceHigh / 128.0;
constexpr double kOuterBias = fuzzy::kBiasHigh / 128.0;

/// False: it would leave [low, high].
template <class T>
bool move(T& x, T by, T low, T high) {
  if (x + by < low || x + by > high) return false;
  x += by;
  return true;
}

}  // namespace

std::optional<Response> admitted(const MirroredRules& rules) {
  Response r = response(parse_rules(to_toml(rules, "candidate", ""), "candidate.toml"), {});
  const auto [slowest, fastest] = std::minmax_element(rules.step.begin(), rules.step.end());
  const double turn_span = 2 * rules.turn[1], step_span = *fastest - *slowest;
  if (r.turn_error > kMostLookUpError * turn_span || r.step_error > kMostLookUpError * step_span)
    return std::nullopt;
  return r;
}

MirroredRules Mutation::operator()(MirroredRules rules) {
  std::size_t changes = 1;
  while (changes < 5 && below(2) == 0) ++changes;
  while (changes > 0)
    if (change(rules)) --changes;
  return rules;
}

// One draw a statement: the order in which a call evaluates its arguments is the compiler's.
bool Mutation::change(MirroredRules& rules) {
  if (steps_ && below(4) == 0) return change_step(rules);
  const std::size_t what = below(8);
  if (what >= 5) return change_centre(rules);
  const std::size_t row = below(kTerms);
  const std::size_t column = below(2);
  const int by = sign();
  if (what < 3) return move(rules.turns[row][column], by, -2, 2);
  bool moved = false;
  for (std::size_t d = 0; d < kTerms; ++d)
    for (std::size_t r = 0; r < 2; ++r)
      if (what == 3 ? d == row : r == column) moved |= move(rules.turns[d][r], by, -2, 2);
  return moved;
}

bool Mutation::change_step(MirroredRules& rules) {
  const std::size_t row = below(kTerms);
  const std::size_t column = below(4);  // 3: the whole row
  const int by = sign();
  bool moved = false;
  for (std::size_t r = 0; r < 3; ++r)
    if (column == 3 || r == column) moved |= move(rules.steps[row][r], by, 0, static_cast<int>(kTerms) - 1);
  return moved;
}

bool Mutation::change_centre(MirroredRules& rules) {
  const std::size_t what = below(4);
  const std::size_t term = below(kTerms);
  const int by = sign();
  const double part = by * static_cast<double>(1 + below(4)) / 4;  // of 1
  auto& d = rules.distance;
  if (what < 2) {
    const double low = term == 0 ? kFirstCentre : d[term - 1] + kLeastGap;
    const double high = term + 1 == kTerms ? kLastCentre : d[term + 1] - kLeastGap;
    return move(d[term], part, low, high);
  }
  const bool outer = term % 2 == 0;
  if (what == 2) {
    auto& [inner_bias, outer_bias] = rules.bias;
    return outer ? move(outer_bias, part, inner_bias + kLeastGap, kOuterBias)
                 : move(inner_bias, part, kLeastGap, outer_bias - kLeastGap);
  }
  auto& [little, much] = rules.turn;
  return outer ? move(much, part / 4, little + kLeastTurnGap, kGreatestTurn)
               : move(little, part / 4, kLeastTurnGap, much - kLeastTurnGap);
}

}  // namespace whisker::rules
