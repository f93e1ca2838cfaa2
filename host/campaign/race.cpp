#include "host/campaign/race.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/campaign/comparison.hpp"

namespace whisker::campaign {
namespace {

double total(const std::vector<double>& all) { return std::accumulate(all.begin(), all.end(), 0.0); }

}  // namespace

void Standing::add(const Row& row, double limit_s) {
  const bool good = succeeded(row);
  contacts += row.verdict == Verdict::contact;
  successes += good;
  log_s.push_back(std::log(good ? std::max(row.time_s, 1e-3) : kTimesLimit * limit_s));
}

Estimate time_ratio(const Standing& a, const Standing& b) {
  std::vector<double> logs;
  for (std::size_t i = 0; i < a.log_s.size(); ++i) logs.push_back(b.log_s[i] - a.log_s[i]);
  return geometric_mean(logs);
}

bool ranks_before(const Standing& a, const Standing& b) {
  if (a.contacts != b.contacts) return a.contacts < b.contacts;
  if (a.successes != b.successes) return a.successes > b.successes;
  return total(a.log_s) < total(b.log_s);
}

bool improves(const Standing& challenger, const Standing& holder) {
  if (challenger.contacts > holder.contacts || challenger.successes < holder.successes) return false;
  const Estimate ratio = time_ratio(holder, challenger);
  return ratio.high && *ratio.high < 1;
}

std::vector<Round> halving(std::size_t entrants, std::size_t worlds) {
  std::vector<Round> rounds{{entrants, worlds}};
  while (rounds.back().entrants > 1) rounds.push_back({(rounds.back().entrants + 1) / 2, worlds});
  for (std::size_t r = rounds.size() - 1; r > 0; --r)
    rounds[r - 1].worlds = std::max<std::size_t>(1, rounds[r].worlds / 2);
  return rounds;
}

}  // namespace whisker::campaign
