/// Many ways to drive in the same worlds: which of them is better, and which is worth more worlds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/campaign/bounds.hpp"
#include "host/campaign/row.hpp"

namespace whisker::campaign {

/// A mission that does not succeed counts as this many times its time limit.
constexpr double kTimesLimit = 10;

/// One way to drive, in the worlds so far. The missions of two that are compared have the same worlds in the
/// same order, so a ratio of times is one of times per metre.
struct Standing {
  std::uint64_t contacts = 0;
  std::uint64_t successes = 0;
  std::vector<double> log_s;  ///< logarithm of each mission's time

  void add(const Row& row, double limit_s);
};

/// Geometric mean of the times of b over those of a. At least one mission.
Estimate time_ratio(const Standing& a, const Standing& b);

/// Fewer contacts; then more successes; then less time.
bool ranks_before(const Standing& a, const Standing& b);

/// No more contacts, no fewer successes, and less time as far as 95 % bounds can tell.
bool improves(const Standing& challenger, const Standing& holder);

struct Round {
  std::size_t entrants;
  std::size_t worlds;  ///< driven by the end of the round, at most all
};
/// Successive halving (Jamieson and Talwalkar, AISTATS 2016): in each round, the better half of the entrants
/// goes on, and the number of worlds doubles. In the last round, one entrant drives all worlds. Both at
/// least 1.
std::vector<Round> halving(std::size_t entrants, std::size_t worlds);

}  // namespace whisker::campaign
