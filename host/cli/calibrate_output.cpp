#include "host/cli/calibrate_output.hpp"

#include <cmath>

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

}  // namespace whisker::cli
