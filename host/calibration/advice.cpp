#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "firmware/params/relations.hpp"
#include "host/calibration/calibration.hpp"
#include "host/scenario/coverage.hpp"
#include "host/scenario/mounting.hpp"
#include "host/scenario/param_list.hpp"

namespace whisker::calibration {
namespace {

constexpr double kSure = 2;         // standard deviations
constexpr double kLeastCone = 0.5;  // deg, of the half: the same
constexpr double kLeastSkew = 0.5;  // deg; what is smaller changes nothing that can be measured
constexpr double kCommonTurn = 2;   // deg, of all beams: rather the body than three mounts
constexpr double kAlike = 1.5;      // deg, from their mean

double half_degree_below(double deg) { return std::floor(deg * 2 + 1e-9) / 2; }
double tenth(double deg) { return std::round(deg * 10) / 10; }

/// Writes a line and sets the parameter. False: out of its range.
bool set(Advice& advice, const std::string& key, double value) {
  const std::vector<ParamEntry> list = param_list(advice.params);
  const auto at = std::find_if(list.begin(), list.end(), [&](const auto& e) { return key == e.key; });
  const std::int64_t raw = to_raw(value, at->unit);
  if (at == list.end() || raw < at->low || raw > at->high) return false;
  set_param(advice.params, static_cast<std::size_t>(at - list.begin()), raw);
  advice.lines.push_back(fmt::format("{} = {}", key, at->text_of(raw)));
  return true;
}

void advise_axes(Advice& advice, const Calibration& c) {
  for (std::size_t i = 0; i < c.fits.size(); ++i) {
    const BeamFit& fit = c.fits[i];
    if (fit.trouble != Trouble::none) continue;
    const double skew = skew_deg(c.believed[i], fit);
    if (std::fabs(skew) < std::max(kLeastSkew, kSure * fit.axis_error_deg)) continue;
    // Zero would stand for the angle that the beams share.
    const double angle = tenth(fit.axis_deg) == 0 && i != hal::kFront ? 0.1 : tenth(fit.axis_deg);
    if (!set(advice, fmt::format("range_{}_angle_deg", kBeamNames[i]), angle)) {
      advice.notes.push_back(fmt::format("the {} beam points to {:.1f} degrees, which no robot file accepts",
                                         kBeamNames[i], fit.axis_deg));
    }
  }
}

void advise_cones(Advice& advice, const Calibration& c) {
  for (std::size_t i = 0; i < c.fits.size(); ++i) {
    const BeamFit& fit = c.fits[i];
    if (fit.trouble != Trouble::none) continue;
    if (fit.half_cone_deg + std::max(kLeastCone, kSure * fit.half_cone_error_deg) >=
        c.believed[i].half_cone_deg)
      continue;
    advice.notes.push_back(
        fmt::format("the {} cone is {:.1f} degrees wide at {:.2f} m, and the robot believes {:.1f}: it would "
                    "take ground for free that no beam sees",
                    kBeamNames[i], 2 * fit.half_cone_deg, fit.wall_m, 2 * c.believed[i].half_cone_deg));
    set(advice, fmt::format("range_{}_cone_deg", kBeamNames[i]), half_degree_below(2 * fit.half_cone_deg));
  }
}

/// The smallest of the three, because they share the parameter.
void advise_incidence(Advice& advice, const Calibration& c) {
  double least = 90;
  bool bound = true;
  for (std::size_t i = 0; i < c.fits.size(); ++i) {
    const BeamFit& fit = c.fits[i];
    const double cone = std::max(fit.half_cone_deg, c.believed[i].half_cone_deg);
    const double sure = fit.sure_edge_deg - cone - kSure * incidence_error_deg(fit);
    if (sure >= least) continue;
    least = sure;
    bound = fit.edge_is_bound;
  }
  for (std::size_t i = 0; i < c.fits.size(); ++i) {
    const BeamFit& fit = c.fits[i];
    if (fit.sure_edge_deg >= fit.edge_deg) continue;
    advice.notes.push_back(
        fmt::format("the edge of the {} beam is soft: from {:.1f} to {:.1f} degrees off its axis, echoes are "
                    "missing now and then; the line above does without them",
                    kBeamNames[i], fit.sure_edge_deg, fit.edge_deg));
  }
  if (!set(advice, "range_incidence_deg", half_degree_below(least))) {
    advice.notes.push_back(
        fmt::format("walls give an echo up to {:.1f} degrees only: too little to drive by", least));
  }
  if (bound) {
    advice.notes.push_back(
        "the wall left the range before its echo was lost: L may be larger; measure again nearer to the "
        "wall");
  }
}

void note_common_turn(Advice& advice, const Calibration& c) {
  if (c.wall_error_deg) return;
  double mean = 0;
  for (std::size_t i = 0; i < c.fits.size(); ++i) mean += skew_deg(c.believed[i], c.fits[i]) / hal::kBeams;
  if (std::fabs(mean) < kCommonTurn) return;
  for (std::size_t i = 0; i < c.fits.size(); ++i) {
    if (std::fabs(skew_deg(c.believed[i], c.fits[i]) - mean) > kAlike) return;
  }
  advice.notes.push_back(
      fmt::format("all beams are turned by {:.1f} degrees: was the body square to the wall when the spin "
                  "began? If not, the angles above are wrong by that",
                  mean));
}

}  // namespace

Advice advise(const Calibration& calibration, const Params& params) {
  Advice advice;
  advice.params = params;
  advise_axes(advice, calibration);
  advise_cones(advice, calibration);
  if (calibration.complete()) {
    advise_incidence(advice, calibration);
    note_common_turn(advice, calibration);
  }
  const ParamFault fault = check(advice.params);
  advice.fits = fault == ParamFault::none;
  if (!advice.fits) {
    advice.notes.insert(
        advice.notes.begin(),
        fmt::format("the parameters do not fit together with these lines: {}", relation(fault).words));
    return advice;
  }
  for (const MountingWarning& w : mounting_warnings(advice.params, Sensor{})) advice.notes.push_back(w.text);
  return advice;
}

}  // namespace whisker::calibration
