#include "host/lab/calibration/calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "firmware/params/relations.hpp"
#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/coverage.hpp"
#include "host/harness/scenario/mounting.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/lab/calibration/beam_fit.hpp"

namespace whisker::calibration {
namespace {

/// The readings of a sweep by the place of the body.
struct Places {
  Sweep first;                  ///< within 3 cm of the first reading
  std::optional<Sweep> second;  ///< within 3 cm of the last one, if that is 0.1 m away or more
  double x_m = 0, y_m = 0;      ///< from the first to the second
};

struct Square {
  double wall_deg = 0;
  double error_deg = 0;  ///< standard deviation
};

constexpr double kSamePlace = 0.03;   // m
constexpr double kOtherPlace = 0.09;  // m
constexpr double kLeastAlong = 0.5;   // sine of the angle between the drive and the wall's normal
constexpr double kLeastError = 0.1;   // deg

double apart(const Sample& a, const Sample& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

Sweep near(const Sweep& sweep, bool last) {
  Sweep some;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    if (sweep[i].empty()) continue;
    const Sample& center = last ? sweep[i].back() : sweep[i].front();
    for (const Sample& s : sweep[i]) {
      if (apart(s, center) < kSamePlace) some[i].push_back(s);
    }
  }
  return some;
}

Places places_of(const Sweep& sweep) {
  Places p;
  p.first = near(sweep, false);
  const Samples& any = sweep[hal::kFront];
  if (any.empty() || apart(any.front(), any.back()) < kOtherPlace) return p;
  p.second = near(sweep, true);
  p.x_m = any.back().x_m - any.front().x_m;
  p.y_m = any.back().y_m - any.front().y_m;
  return p;
}

// With n the unit vector to the wall and d the way between the places: first distance - second = n . d
/// From the difference of the wall's distances. None: too few beams were measured at both places, or the
/// second place does not lie along the wall. near_deg: decides between the two headings that are possible.
std::optional<Square> squared(const Places& places, const std::array<BeamFit, hal::kBeams>& first,
                              const std::array<BeamFit, hal::kBeams>& second, double near_deg) {
  double nearer = 0, weight = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i].trouble != Trouble::none || second[i].trouble != Trouble::none) continue;
    const double error = std::hypot(first[i].wall_error_m, second[i].wall_error_m);
    nearer += (first[i].wall_m - second[i].wall_m) / (error * error);
    weight += 1 / (error * error);
  }
  if (weight == 0) return std::nullopt;
  nearer /= weight;
  const double length = std::hypot(places.x_m, places.y_m), way = std::atan2(places.y_m, places.x_m);
  if (std::fabs(nearer) >= length) return std::nullopt;
  const double aside = std::acos(nearer / length);
  if (std::sin(aside) < kLeastAlong) return std::nullopt;
  const double off_left = wrapped(way + aside - near_deg * kRadPerDeg);
  const double off_right = wrapped(way - aside - near_deg * kRadPerDeg);
  const double off = std::fabs(off_left) < std::fabs(off_right) ? off_left : off_right;
  const double error = 1 / std::sqrt(weight) / (length * std::sin(aside));
  return Square{near_deg + off / kRadPerDeg, std::hypot(error / kRadPerDeg, kLeastError)};
}

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

const char* const kBeamNames[hal::kBeams] = {"left", "front", "right"};

bool Calibration::complete() const {
  return std::all_of(fits.begin(), fits.end(), [](const BeamFit& f) { return f.trouble == Trouble::none; });
}

Calibration calibrate(const Sweep& sweep, const Params& params, double wall_deg) {
  Calibration all;
  all.wall_deg = all.assumed_wall_deg = wall_deg;
  for (std::size_t i = 0; i < all.fits.size(); ++i) all.believed[i] = believed(params, static_cast<int>(i));
  const Places places = places_of(sweep);
  const auto fit = [&](const Sweep& at) {
    std::array<BeamFit, hal::kBeams> fits{};
    for (std::size_t i = 0; i < fits.size(); ++i) fits[i] = fit_beam(at[i], all.believed[i], all.wall_deg);
    return fits;
  };
  all.fits = fit(places.first);
  if (!places.second) return all;
  const auto second = fit(*places.second);
  const std::optional<Square> square = squared(places, all.fits, second, wall_deg);
  if (!square) return all;
  all.wall_deg = square->wall_deg;
  all.wall_error_deg = square->error_deg;
  all.fits = fit(places.first);
  for (BeamFit& f : all.fits) f.axis_error_deg = std::hypot(f.axis_error_deg, square->error_deg);
  return all;
}

double skew_deg(const Believed& beam, const BeamFit& fit) {
  return std::remainder(fit.axis_deg - beam.axis_deg, 360);
}

double incidence_deg(const BeamFit& fit) { return fit.edge_deg - fit.half_cone_deg; }

double incidence_error_deg(const BeamFit& fit) {
  return std::hypot(fit.edge_error_deg, fit.half_cone_error_deg);
}

double incidence_deg(const BeamFit& fit, const Believed& beam) { return fit.edge_deg - beam.half_cone_deg; }

std::string trouble_words(const Believed& beam, const BeamFit& fit) {
  switch (fit.trouble) {
    case Trouble::none: return "";
    case Trouble::few_readings:
      return fmt::format("only {} readings; a slow turn gives several hundred", fit.readings);
    case Trouble::not_enough_turn:
      return fmt::format("the body turned {:.0f} degrees; it must turn once around", fit.turn_deg);
    case Trouble::nothing_seen:
      return fmt::format("{} readings and hardly an echo; is the wall between {:.2f} and {:.2f} m away?",
                         fit.readings, beam.min_range_m, beam.max_range_m);
    case Trouble::no_wall:
      return "echoes, but none of a flat wall; it must be flat, and wide enough to reach out of the range on "
             "both sides";
    case Trouble::second_wall:
      return fmt::format(
          "a second wall or object: {:.2f} m and {:.2f} m away; keep everything else more than twice as far "
          "away as the wall",
          fit.wall_m, fit.second_m);
    case Trouble::too_noisy:
      return fmt::format(
          "too noisy: the axis would be uncertain by {:.1f} degrees, the distances by {:.0f} mm",
          fit.axis_error_deg, fit.sigma_m * 1e3);
  }
  return "";
}

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
