#include "host/cli/calibrate_output.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace whisker::cli {
namespace {

using calibration::BeamFit;
using calibration::Believed;
using calibration::Trouble;
using calibration::Truth;
using Json = nlohmann::ordered_json;

const char* word(Trouble trouble) {
  switch (trouble) {
    case Trouble::none: return "none";
    case Trouble::few_readings: return "few_readings";
    case Trouble::not_enough_turn: return "not_enough_turn";
    case Trouble::nothing_seen: return "nothing_seen";
    case Trouble::no_wall: return "no_wall";
    case Trouble::second_wall: return "second_wall";
    case Trouble::too_noisy: return "too_noisy";
  }
  return "";
}

/// To a tenth; never -0.0.
double tenths(double x) { return std::round(x * 10) / 10 + 0.0; }

std::string value(double x, double error) { return fmt::format("{:.1f} +-{:.1f}", tenths(x), error); }

std::string measured_row(const char* name, const Believed& beam, const BeamFit& f) {
  const char* const bound = f.edge_is_bound ? ">=" : "";
  return fmt::format(
      "{:<7}{:>13}{:>8}{:>13}{:>15}{:>15}{:>9}{:>9}{:>8}{:>7}{:>6}{:>10}\n", name,
      value(f.axis_deg, f.axis_error_deg), fmt::format("{:+.1f}", tenths(calibration::skew_deg(beam, f))),
      value(f.half_cone_deg, f.half_cone_error_deg), bound + value(f.edge_deg, f.edge_error_deg),
      bound + value(calibration::incidence_deg(f), calibration::incidence_error_deg(f)),
      fmt::format("{}{:.1f}", bound, calibration::incidence_deg(f, beam)), fmt::format("{:.3f}", f.wall_m),
      fmt::format("{:.1f}", f.sigma_m * 1e3), f.on_wall, f.dropouts, f.phantoms);
}

std::string truth_row(const Believed& beam, const Truth& t) {
  return fmt::format("{:<7}{:>8.1f}{:>13}{:>8.1f}{:>15.1f}{:>15.1f}\n", "  true", tenths(t.axis_deg),
                     fmt::format("{:+.1f}", tenths(t.axis_deg - beam.axis_deg)), t.half_cone_deg, t.edge_deg,
                     t.incidence_deg);
}

Json beam_json(std::size_t i, const CalibrationReport& r) {
  const BeamFit& f = r.measured.fits[i];
  const Believed& b = r.measured.believed[i];
  Json one = {{"beam", calibration::kBeamNames[i]},
              {"trouble", word(f.trouble)},
              {"text", calibration::trouble_words(b, f)}};
  one["believed_axis_deg"] = b.axis_deg;
  one["believed_cone_deg"] = 2 * b.half_cone_deg;
  one["readings"] = f.readings;
  if (f.trouble == Trouble::none) {
    one["axis_deg"] = f.axis_deg;
    one["axis_error_deg"] = f.axis_error_deg;
    one["skew_deg"] = calibration::skew_deg(b, f);
    one["cone_deg"] = 2 * f.half_cone_deg;
    one["cone_error_deg"] = 2 * f.half_cone_error_deg;
    one["edge_deg"] = f.edge_deg;
    one["edge_error_deg"] = f.edge_error_deg;
    one["sure_edge_deg"] = f.sure_edge_deg;
    one["edge_is_bound"] = f.edge_is_bound;
    one["incidence_deg"] = calibration::incidence_deg(f);
    one["incidence_error_deg"] = calibration::incidence_error_deg(f);
    one["incidence_of_believed_cone_deg"] = calibration::incidence_deg(f, b);
    one["wall_m"] = f.wall_m;
    one["sigma_m"] = f.sigma_m;
    one["within_m"] = f.within_m;
    one["on_wall"] = f.on_wall;
    one["dropouts"] = f.dropouts;
    one["wild"] = f.wild;
    one["phantoms"] = f.phantoms;
  }
  if (r.truth) {
    const Truth& t = (*r.truth)[i];
    one["true_axis_deg"] = t.axis_deg;
    one["true_cone_deg"] = 2 * t.half_cone_deg;
    one["true_edge_deg"] = t.edge_deg;
    one["true_incidence_deg"] = t.incidence_deg;
  }
  return one;
}

using calibration::TrialResult;

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

std::string calibration_words(const CalibrationReport& r) {
  std::string out = r.source + "\n";
  out += fmt::format("{:<7}{:>13}{:>8}{:>13}{:>15}{:>15}{:>9}{:>9}{:>8}{:>7}{:>6}{:>10}\n", "beam", "axis",
                     "skew", "cone/2", "cone/2+L", "L", "L given", "wall, m", "+-, mm", "echoes", "lost",
                     "phantoms");
  for (std::size_t i = 0; i < r.measured.fits.size(); ++i) {
    const BeamFit& f = r.measured.fits[i];
    if (f.trouble == Trouble::none)
      out += measured_row(calibration::kBeamNames[i], r.measured.believed[i], f);
    if (f.trouble == Trouble::none && r.truth) out += truth_row(r.measured.believed[i], (*r.truth)[i]);
  }
  out += "Angles in degrees. L given: cone/2+L less the half cone that the robot believes.\n";
  if (r.measured.wall_error_deg) {
    out += fmt::format(
        "The body stood {} degrees off square, by the two turns; the axes take that into account.\n",
        value(r.measured.assumed_wall_deg - r.measured.wall_deg, *r.measured.wall_error_deg));
  }
  if (!r.advice.lines.empty()) out += fmt::format("\nWrite into {}:\n", r.robot);
  for (const std::string& line : r.advice.lines) out += line + "\n";
  if (!r.advice.notes.empty()) out += "\n";
  for (const std::string& note : r.advice.notes) out += "note: " + note + "\n";
  return out;
}

std::string calibration_json(const CalibrationReport& r) {
  Json json = {{"measured", r.measured.complete()}, {"fits", r.advice.fits}};
  json["off_square_deg"] = nullptr;
  if (r.measured.wall_error_deg) {
    json["off_square_deg"] = r.measured.assumed_wall_deg - r.measured.wall_deg;
    json["off_square_error_deg"] = *r.measured.wall_error_deg;
  }
  Json beams = Json::array();
  for (std::size_t i = 0; i < r.measured.fits.size(); ++i) beams.push_back(beam_json(i, r));
  json["beams"] = beams;
  json["lines"] = r.advice.lines;
  json["notes"] = r.advice.notes;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

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
