#include "host/lab/campaign/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whisker::campaign {
namespace {

std::optional<Estimate> geometric(const std::vector<double>& logs) {
  if (logs.empty()) return std::nullopt;
  return geometric_mean(logs);
}

std::optional<Estimate> mean_of(const std::vector<double>& sample) {
  if (sample.empty()) return std::nullopt;
  return mean(sample);
}

void add_ratio(std::vector<double>& logs, double a, double b) {
  if (a > 0 && b > 0) logs.push_back(std::log(b / a));
}

double total(const std::vector<double>& all) { return std::accumulate(all.begin(), all.end(), 0.0); }

}  // namespace

Estimate geometric_mean(const std::vector<double>& logs) {
  Estimate e = mean(logs);
  e.value = std::exp(e.value);
  if (e.low) e.low = std::exp(*e.low);
  if (e.high) e.high = std::exp(*e.high);
  return e;
}

Comparison compare(const std::vector<Pair>& pairs) {
  Comparison c;
  c.worlds = pairs.size();
  std::uint64_t a = 0, b = 0, there_a = 0, there_b = 0;
  std::vector<double> time, path, jerk, stops, flips, clearance;
  for (const Pair& pair : pairs) {
    const bool good_a = succeeded(pair.a), good_b = succeeded(pair.b);
    a += good_a;
    b += good_b;
    there_a += truly_there(pair.a);
    there_b += truly_there(pair.b);
    c.only_a += good_a && !good_b;
    c.only_b += good_b && !good_a;
    c.contacts_a += pair.a.verdict == Verdict::contact;
    c.contacts_b += pair.b.verdict == Verdict::contact;
    if (pair.a.verdict != Verdict::reached || pair.b.verdict != Verdict::reached) continue;
    ++c.both;
    add_ratio(time, pair.a.time_s, pair.b.time_s);
    add_ratio(path, pair.a.path_m, pair.b.path_m);
    add_ratio(jerk, pair.jerk_a, pair.jerk_b);
    clearance.push_back(pair.b.min_clearance_m - pair.a.min_clearance_m);
    if (!pair.a.shortest_m || !(*pair.a.shortest_m > 0)) continue;
    const auto more = [&](std::uint64_t now, std::uint64_t before) {
      return (static_cast<double>(now) - static_cast<double>(before)) / *pair.a.shortest_m;
    };
    stops.push_back(more(pair.b.stops, pair.a.stops));
    flips.push_back(more(pair.b.flips, pair.a.flips));
  }
  c.there_a = share(there_a, c.worlds);
  c.there_b = share(there_b, c.worlds);
  c.success_a = share(a, c.worlds);
  c.success_b = share(b, c.worlds);
  c.time = geometric(time);
  c.path = geometric(path);
  c.jerk = geometric(jerk);
  c.stops = mean_of(stops);
  c.flips = mean_of(flips);
  c.clearance = mean_of(clearance);
  return c;
}

void JerkMeter::add(double t_s, double speed_mps) {
  const double step = t_s - t_s_;
  if (seen_ > 0 && step > 0) {
    const double acceleration = (speed_mps - speed_) / step;
    if (seen_ > 1) {
      const double jerk = (acceleration - acceleration_) / step;
      squares_ += jerk * jerk * step;
      seconds_ += step;
    }
    acceleration_ = acceleration;
  }
  if (seen_ < 2) ++seen_;
  t_s_ = t_s;
  speed_ = speed_mps;
}

double JerkMeter::rms() const { return seconds_ > 0 ? std::sqrt(squares_ / seconds_) : 0; }

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
