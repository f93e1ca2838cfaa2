/// Random changes of a mirrored rule base, for a search.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "host/rules/mirrored_rules.hpp"
#include "host/rules/response.hpp"

namespace whisker::rules {

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
