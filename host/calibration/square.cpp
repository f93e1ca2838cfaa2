#include "host/calibration/square.hpp"

#include <cmath>

#include "host/scenario/bearing.hpp"

namespace whisker::calibration {
namespace {

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

}  // namespace

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

}  // namespace whisker::calibration
