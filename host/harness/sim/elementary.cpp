#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {
namespace {

// Each constant is split so that its leading part times a small integer is exact.
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
constexpr double kHalfPi1 = 0x1.921fb544p+0;  // 33 bits
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
constexpr double kLog2E = 0x1.71547652b82fep+0;
constexpr double kLn2High = 0x1.62e42feep-1;  // 32 bits
constexpr double kLn2Low = 0x1.a39ef35793c76p-33;

// Each power series ends where the next term is below 2^-56 of the result.

double sin_near_zero(double r) {
  const double z = r * r;
  double p = -1.0 / 1307674368000.0;
  p = p * z + 1.0 / 6227020800.0;
  p = p * z - 1.0 / 39916800.0;
  p = p * z + 1.0 / 362880.0;
  p = p * z - 1.0 / 5040.0;
  p = p * z + 1.0 / 120.0;
  p = p * z - 1.0 / 6.0;
  return r + r * (z * p);
}

double cos_near_zero(double r) {
  const double z = r * r;
  double p = 1.0 / 20922789888000.0;
  p = p * z - 1.0 / 87178291200.0;
  p = p * z + 1.0 / 479001600.0;
  p = p * z - 1.0 / 3628800.0;
  p = p * z + 1.0 / 40320.0;
  p = p * z - 1.0 / 720.0;
  p = p * z + 1.0 / 24.0;
  p = p * z - 1.0 / 2.0;
  return 1.0 + z * p;
}

// |t| <= tan(pi / 16)
double arc_tangent_near_zero(double t) {
  const double z = t * t;
  double p = 0;
  for (int n = 23; n >= 3; n -= 2) {
    const double sign = n % 4 == 3 ? -1.0 : 1.0;
    p = z * (sign / n + p);
  }
  return t + t * p;
}

// t in [0, 1]
double arc_tangent_first_octant(double t) {
  constexpr double kTanPi8 = 0.41421356237309503;
  constexpr double kTanPi16 = 0.198912367379658;
  constexpr double kTan3Pi16 = 0.6681786379192989;
  if (t <= kTanPi16) return arc_tangent_near_zero(t);
  if (t <= kTan3Pi16) return kPi / 8 + arc_tangent_near_zero((t - kTanPi8) / (1.0 + t * kTanPi8));
  return kPi / 4 + arc_tangent_near_zero((t - 1.0) / (1.0 + t));
}

uint64_t bits_of(double x) {
  uint64_t bits;
  __builtin_memcpy(&bits, &x, sizeof bits);
  return bits;
}

double double_of(uint64_t bits) {
  double x;
  __builtin_memcpy(&x, &bits, sizeof x);
  return x;
}

}  // namespace

SinCos sin_cos(double x) {
  const int64_t quarter = whole_below(x * kTwoOverPi + 0.5);
  const double k = static_cast<double>(quarter);
  const double r = ((x - k * kHalfPi1) - k * kHalfPi2) - k * kHalfPi3;
  const double s = sin_near_zero(r);
  const double c = cos_near_zero(r);
  switch (static_cast<unsigned>(static_cast<uint64_t>(quarter) & 3U)) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

double arc_tangent(double y, double x) {
  const double ax = x < 0 ? -x : x;
  const double ay = y < 0 ? -y : y;
  if (ax <= 0 && ay <= 0) return 0;
  double angle = ay <= ax ? arc_tangent_first_octant(ay / ax) : kPi / 2 - arc_tangent_first_octant(ax / ay);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

double natural_log(double x) {
  constexpr double kRootHalf = 0.70710678118654757;
  const uint64_t bits = bits_of(x);
  int exponent = static_cast<int>(bits >> 52) - 1022;
  double m = double_of((bits & UINT64_C(0x000FFFFFFFFFFFFF)) | UINT64_C(0x3FE0000000000000));
  if (m < kRootHalf) {
    m *= 2;
    --exponent;
  }
  // log m = 2 artanh(s) with s = f / (2 + f); f - (f^2 / 2 - s (f^2 / 2 + tail)) keeps the precision of f.
  const double f = m - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  double tail = 0;
  for (int n = 21; n >= 3; n -= 2) tail = z * (2.0 / n + tail);
  const double half_square = 0.5 * f * f;
  const double k = exponent;
  return k * kLn2High - ((half_square - (s * (half_square + tail) + k * kLn2Low)) - f);
}

double exponential(double x) {
  if (x < -700) return 0;
  const int64_t n = whole_below(x * kLog2E + 0.5);
  const double k = static_cast<double>(n);
  const double r = (x - k * kLn2High) - k * kLn2Low;
  double p = 1.0 / 6227020800.0;
  p = p * r + 1.0 / 479001600.0;
  p = p * r + 1.0 / 39916800.0;
  p = p * r + 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  const double e = 1.0 + (r + r * r * p);
  return e * double_of(static_cast<uint64_t>(n + 1023) << 52);
}

}  // namespace whisker::sim
