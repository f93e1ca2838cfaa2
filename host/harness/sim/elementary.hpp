/// The elementary functions of the simulator, implemented here so that every compiler and WebAssembly give
/// the same bits. tests/sim/elementary_test.cpp asserts the stated error bounds.
#pragma once

#include <stdint.h>

namespace whisker::sim {

constexpr double kPi = 0x1.921fb54442d18p+1;

/// Correctly rounded. x >= 0.
inline double square_root(double x) { return __builtin_sqrt(x); }
inline double size_of(double x) { return x < 0 ? -x : x; }

/// The largest integer that is not above x. |x| < 2^62.
inline int64_t whole_below(double x) {
  const int64_t i = static_cast<int64_t>(x);
  return static_cast<double>(i) > x ? i - 1 : i;
}

struct SinCos {
  double sin;
  double cos;
};

/// |x| <= 1e6 rad; absolute error of each < 2e-16 (2^-53 is 1.1e-16).
SinCos sin_cos(double x);

/// The angle of (x, y) in [-pi, pi]; relative error < 4e-16. arc_tangent(0, 0) is 0.
double arc_tangent(double y, double x);

/// x positive and normal; relative error < 2e-16.
double natural_log(double x);

/// x in [-700, 700]; relative error < 2e-16. Below -700 the result is 0.
double exponential(double x);

}  // namespace whisker::sim
