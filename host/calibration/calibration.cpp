#include "host/calibration/calibration.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/calibration/square.hpp"

namespace whisker::calibration {

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

}  // namespace whisker::calibration
