#include "host/lab/calibration/umbmark.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "host/harness/sim/elementary.hpp"

namespace whisker::calibration {
namespace {

struct Place {
  double x = 0, y = 0, heading = 0;
  void drive(double length, double turn) {
    const double chord = std::abs(turn) < 1e-9 ? length : length * std::sin(turn / 2) / (turn / 2);
    x += chord * std::cos(heading + turn / 2);
    y += chord * std::sin(heading + turn / 2);
    heading += turn;
  }
};

/// Where a body with this skew (the right wheel goes 1 + skew, the left one 1 - skew times as far as
/// believed) and this track (true / believed) is at the end of a square. Every side ends as far beside and
/// beyond its corner as the robot believes of the last one, and the next one makes up for it.
Place driven(const SquareEnd& end, double side, double track, double skew, double track_ratio) {
  const double turn_sign = end.left ? 1 : -1;
  const double beside = turn_sign * end.believed_x_m;  // to the left of a side
  const double beyond = -turn_sign * end.believed_y_m;
  Place at;
  for (int i = 0; i < 4; ++i) {
    const double before = i == 0 ? 0 : turn_sign * beside;
    const double length = side + beyond - before;
    const double aslant = std::atan2(beside + (i == 0 ? 0 : turn_sign * beyond), length);
    at.heading += aslant;
    at.drive(length, 2 * skew * length / (track * track_ratio));
    at.heading -= aslant;
    const double rim = turn_sign * sim::kPi / 4 * track;
    at.drive(skew * rim, 2 * rim / (track * track_ratio));
  }
  return at;
}

struct Fit {
  double skew = 0, track = 1;
};
using Normal = std::array<double, 3>;  // of a symmetric 2 x 2 matrix

double determinant(const Normal& n) { return n[0] * n[2] - n[1] * n[1]; }

}  // namespace

Umbmark umbmark(const std::vector<SquareEnd>& ends, double side_m, double track_m, double scale_sigma) {
  int left = 0;
  for (const SquareEnd& end : ends) left += end.left ? 1 : 0;
  const int right = static_cast<int>(ends.size()) - left;
  if (left < 2 || right < 2)
    throw std::runtime_error("two squares to the left and two to the right are needed");
  Fit fit;
  Normal normal{};
  Normal spread{};  // of the squares' contributions to the gradient: their two coordinates err together
  double squares = 0;
  for (int round = 0; round < 30; ++round) {
    normal = spread = {};
    squares = 0;
    double g0 = 0, g1 = 0;
    for (const SquareEnd& end : ends) {
      const auto at = [&](double skew, double track) { return driven(end, side_m, track_m, skew, track); };
      constexpr double kNudge = 1e-6;
      double own0 = 0, own1 = 0;
      const Place now = at(fit.skew, fit.track);
      const Place by_skew = at(fit.skew + kNudge, fit.track);
      const Place by_track = at(fit.skew, fit.track + kNudge);
      const auto take = [&](double seen, double here, double s, double t) {
        const double a = (s - here) / kNudge, b = (t - here) / kNudge, error = seen - here;
        normal[0] += a * a, normal[1] += a * b, normal[2] += b * b;
        own0 += a * error, own1 += b * error;
        squares += error * error;
      };
      take(end.x_m, now.x, by_skew.x, by_track.x);
      take(end.y_m, now.y, by_skew.y, by_track.y);
      g0 += own0, g1 += own1;
      spread[0] += own0 * own0, spread[1] += own0 * own1, spread[2] += own1 * own1;
    }
    const double det = determinant(normal);
    if (!(det > 1e-12)) throw std::runtime_error("the ends tell nothing: is the side long enough?");
    const double d_skew = (normal[2] * g0 - normal[1] * g1) / det;
    const double d_track = (normal[0] * g1 - normal[1] * g0) / det;
    fit.skew += d_skew;
    fit.track += d_track;
    if (std::abs(fit.skew) > 0.06 || std::abs(fit.track - 1) > 0.12) {
      throw std::runtime_error("no ratio within 12 % and track within 12 % explain the ends");
    }
    if (std::abs(d_skew) < 1e-10 && std::abs(d_track) < 1e-10) break;
  }
  const double freedom = 2.0 * static_cast<double>(ends.size()) - 2;
  const double variance = squares / freedom;
  const double det = determinant(normal);
  // normal^-1 spread normal^-1, the variance without the assumption that all coordinates err alike.
  const double few = static_cast<double>(ends.size()) / static_cast<double>(ends.size() - 2);
  const auto variance_of = [&](double a, double b) {
    return few * (a * a * spread[0] + 2 * a * b * spread[1] + b * b * spread[2]);
  };
  const double skew_variance =
      std::max(variance * normal[2] / det, variance_of(normal[2] / det, -normal[1] / det));
  const double track_variance =
      std::max(variance * normal[0] / det, variance_of(-normal[1] / det, normal[0] / det));
  Umbmark result;
  result.wheel_ratio = (1 + fit.skew) / (1 - fit.skew);
  // A side that is truly longer by a share makes the effect of both errors larger by it.
  result.ratio_sigma = std::hypot(2 * std::sqrt(skew_variance), (result.wheel_ratio - 1) * scale_sigma);
  result.track = fit.track;
  result.track_sigma = std::hypot(std::sqrt(track_variance), (fit.track - 1) * scale_sigma);
  result.residual_m = std::sqrt(squares / (2.0 * static_cast<double>(ends.size())));
  return result;
}

}  // namespace whisker::calibration
