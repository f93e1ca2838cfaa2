#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/cli/calibrate_output.hpp"

namespace whisker::cli {
namespace {

using calibration::BeamFit;
using calibration::Believed;
using calibration::TrialResult;
using calibration::Trouble;
using calibration::Truth;
using Json = nlohmann::ordered_json;

/// One figure of all beams that were measured: what was measured less what is true.
struct Column {
  const char* name;
  std::function<double(const BeamFit&, const Believed&, const Truth&)> difference;
  std::function<double(const BeamFit&)> error;  ///< as estimated
  bool of_bounds;                               ///< also of beams whose edge is a bound
};

const Column kColumns[] = {
    {"axis", [](auto& f, auto&, auto& t) { return std::remainder(f.axis_deg - t.axis_deg, 360); },
     [](auto& f) { return f.axis_error_deg; }, true},
    {"cone/2", [](auto& f, auto&, auto& t) { return f.half_cone_deg - t.half_cone_deg; },
     [](auto& f) { return f.half_cone_error_deg; }, true},
    {"cone/2 + L", [](auto& f, auto&, auto& t) { return f.edge_deg - t.edge_deg; },
     [](auto& f) { return f.edge_error_deg; }, false},
    {"L", [](auto& f, auto&, auto& t) { return calibration::incidence_deg(f) - t.incidence_deg; },
     [](auto& f) { return calibration::incidence_error_deg(f); }, false},
    {"L of the believed cone",
     [](auto& f, auto& b, auto& t) { return calibration::incidence_deg(f, b) - t.incidence_deg; },
     [](auto& f) { return f.edge_error_deg; }, false},
};

struct Distribution {
  std::size_t count = 0;
  double p50 = 0, p95 = 0, least = 0, most = 0;  ///< p50 and p95 of the absolute values
  double within_two = 0;                         ///< share within twice the estimated error
};

Distribution distribution(const std::vector<TrialResult>& trials, const Column& column) {
  Distribution d;
  std::vector<double> sizes;
  double within = 0;
  for (const TrialResult& trial : trials) {
    for (std::size_t i = 0; i < trial.truth.size(); ++i) {
      const BeamFit& f = trial.measured.fits[i];
      if (f.trouble != Trouble::none || (f.edge_is_bound && !column.of_bounds)) continue;
      const double off = column.difference(f, trial.measured.believed[i], trial.truth[i]);
      d.least = sizes.empty() ? off : std::min(d.least, off);
      d.most = sizes.empty() ? off : std::max(d.most, off);
      within += std::fabs(off) <= 2 * column.error(f) ? 1 : 0;
      sizes.push_back(std::fabs(off));
    }
  }
  d.count = sizes.size();
  if (sizes.empty()) return d;
  std::sort(sizes.begin(), sizes.end());
  d.p50 = sizes[(sizes.size() - 1) / 2];
  d.p95 = sizes[(sizes.size() - 1) * 95 / 100];
  d.within_two = within / static_cast<double>(sizes.size());
  return d;
}

std::size_t refused(const std::vector<TrialResult>& trials) {
  std::size_t n = 0;
  for (const TrialResult& t : trials) {
    for (const BeamFit& f : t.measured.fits) n += f.trouble == Trouble::none ? 0 : 1;
  }
  return n;
}

/// deg, of the trials with a written L: how far it lies below the true one.
struct Written {
  std::size_t count = 0;
  std::size_t above = 0;  ///< the robot would believe in echoes that do not come
  double least = 0, mean = 0;
};

Written written(const std::vector<TrialResult>& trials) {
  Written w;
  for (const TrialResult& t : trials) {
    if (t.written_incidence_deg == 0) continue;
    const double below = t.truth[0].incidence_deg - t.written_incidence_deg;
    w.least = w.count == 0 ? below : std::min(w.least, below);
    w.mean += below;
    w.above += below < 0 ? 1 : 0;
    ++w.count;
  }
  if (w.count > 0) w.mean /= static_cast<double>(w.count);
  return w;
}

}  // namespace

std::string trials_words(const std::vector<TrialResult>& trials) {
  std::string out =
      "| degrees | beams | error p50 | p95 | least | most | within twice the estimated error |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Column& column : kColumns) {
    const Distribution d = distribution(trials, column);
    out += fmt::format("| {} | {} | {:.2f} | {:.2f} | {:+.2f} | {:+.2f} | {:.0f} % |\n", column.name, d.count,
                       d.p50, d.p95, d.least, d.most, 100 * d.within_two);
  }
  const Written w = written(trials);
  return out +
         fmt::format(
             "\n{} of {} beams were not measured. The range_incidence_deg to write lies {:.1f} degrees below "
             "the true L on average, {:.1f} at least; {} of {} lie above it.\n",
             refused(trials), 3 * trials.size(), w.mean, w.least, w.above, w.count);
}

std::string trials_json(const std::vector<TrialResult>& trials) {
  const Written w = written(trials);
  Json json = {{"trials", trials.size()}, {"refused", refused(trials)}};
  json["written"] = {
      {"count", w.count}, {"above", w.above}, {"least_below_deg", w.least}, {"mean_below_deg", w.mean}};
  for (const Column& column : kColumns) {
    const Distribution d = distribution(trials, column);
    json[column.name] = {{"beams", d.count},     {"p50_deg", d.p50},   {"p95_deg", d.p95},
                         {"least_deg", d.least}, {"most_deg", d.most}, {"within_two", d.within_two}};
  }
  return json.dump();
}

}  // namespace whisker::cli
