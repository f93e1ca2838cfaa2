#include <algorithm>
#include <array>
#include <cmath>

#include "host/calibration/wall_search.hpp"

namespace whisker::calibration {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

/// The inverse of a symmetric, positive definite matrix.
Matrix inverse(const Matrix& a) {
  Matrix minor{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      minor[i][j] = a[r][c] * a[s][d] - a[r][d] * a[s][c];
    }
  }
  const double det = a[0][0] * minor[0][0] + a[0][1] * minor[0][1] + a[0][2] * minor[0][2];
  for (Vector& row : minor) {
    for (double& x : row) x /= det;
  }
  return minor;
}

constexpr double kWeak = 0.35;         // rad: what is known of an angle without any reading
constexpr double kBinError = 0.0017;   // rad, of axis and edge: their resolution
constexpr double kModelError = 0.003;  // rad, of the half cone: real cones have no sharp edge

}  // namespace

Uncertainty uncertainty(const Wall& wall, const std::vector<Look>& looks, const Errors& errors,
                        double min_range) {
  const double noise = 1 / (errors.sigma * errors.sigma);
  Matrix information{};
  information[0][0] = information[1][1] = 1 / (kWeak * kWeak);
  information[2][2] = 1;
  // Of each side: the readings beyond the last tenth before the edge, and whether the edge is within the
  // range.
  int readings[2] = {0, 0};
  bool bound[2] = {true, true};
  constexpr double kRim = 0.17;  // rad
  for (const Look& look : looks) {
    const double u = wrapped(look.heading - wall.facing);
    const Prediction p = predict(wall, look, errors, min_range);
    const int side = u < 0 ? 0 : 1;
    const bool sure = p.visible && !p.uncertain;
    if (std::fabs(p.off_axis - wall.edge) < kRim && !look.lost) ++readings[side];
    if (p.off_axis > wall.edge && p.off_axis < wall.edge + kRim && sure) bound[side] = false;
    if (!sure || p.off_axis > wall.edge || look.metres <= 0) continue;
    if (std::fabs(look.metres - p.metres) > 4 * errors.sigma) continue;
    const double incidence = std::max(p.off_axis - wall.half_cone, 0.0);
    const double slope = p.metres * std::tan(incidence);
    const Vector d{u < 0 ? slope : -slope, -slope, 1 / std::cos(incidence)};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) information[i][j] += d[i] * d[j] * noise;
    }
  }
  // Each side's edge lies between two readings, or a few farther out if dropouts hide the last ones.
  const auto spacing = [&](int side) {
    return 2 * kRim / std::max(readings[side], 1) / (1 - errors.dropout);
  };
  const double left = spacing(0), right = spacing(1);
  Uncertainty u;
  u.edge_is_bound = bound[0] && bound[1];
  const double edges = 0.5 * std::sqrt(left * left + right * right);
  if (!bound[0] && !bound[1]) information[0][0] += 1 / (edges * edges);
  const Matrix covariance = inverse(information);
  u.facing = std::sqrt(covariance[0][0] + kBinError * kBinError);
  u.half_cone = std::sqrt(covariance[1][1] + kModelError * kModelError);
  u.distance = std::sqrt(covariance[2][2]);
  u.edge = std::sqrt(edges * edges + kBinError * kBinError);
  return u;
}

}  // namespace whisker::calibration
