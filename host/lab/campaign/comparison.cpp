#include "host/lab/campaign/comparison.hpp"

#include <cmath>

namespace whisker::campaign {
namespace {

/// Of ratios, from their logarithms.
std::optional<Estimate> geometric_mean(const std::vector<double>& logs) {
  if (logs.empty()) return std::nullopt;
  Estimate e = mean(logs);
  e.value = std::exp(e.value);
  if (e.low) e.low = std::exp(*e.low);
  if (e.high) e.high = std::exp(*e.high);
  return e;
}

std::optional<Estimate> mean_of(const std::vector<double>& sample) {
  if (sample.empty()) return std::nullopt;
  return mean(sample);
}

void add_ratio(std::vector<double>& logs, double a, double b) {
  if (a > 0 && b > 0) logs.push_back(std::log(b / a));
}

}  // namespace

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
  c.time = geometric_mean(time);
  c.path = geometric_mean(path);
  c.jerk = geometric_mean(jerk);
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

}  // namespace whisker::campaign
