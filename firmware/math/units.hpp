/// Quantities as types: a length does not convert to a speed, and every sum saturates.
///
/// | type | raw unit | range |
/// |---|---|---|
/// | Length | 1 um | +-2147 m |
/// | Speed | 1 um/s | +-2147 m/s |
/// | Acceleration | 1 um/s^2 | +-2147 m/s^2 |
/// | AngularRate | 1 urad/s | +-2147 rad/s |
/// | Duration | 1 ms | +-24.8 days |
/// | Ratio | 1e-6 | +-2147 |
/// | Time | 1 ms, wraps after 49.7 days | - |
#pragma once

#include <stdint.h>

#include "firmware/math/fixed.hpp"

namespace whisker {

template <class Tag>
class Unit {
 public:
  constexpr Unit() noexcept = default;
  static constexpr Unit from_raw(int32_t raw) noexcept {
    Unit u;
    u.raw_ = raw;
    return u;
  }
  constexpr int32_t raw() const noexcept { return raw_; }

  friend constexpr bool operator==(Unit a, Unit b) noexcept { return a.raw_ == b.raw_; }
  friend constexpr bool operator!=(Unit a, Unit b) noexcept { return a.raw_ != b.raw_; }
  friend constexpr bool operator<(Unit a, Unit b) noexcept { return a.raw_ < b.raw_; }
  friend constexpr bool operator>(Unit a, Unit b) noexcept { return a.raw_ > b.raw_; }
  friend constexpr bool operator<=(Unit a, Unit b) noexcept { return a.raw_ <= b.raw_; }
  friend constexpr bool operator>=(Unit a, Unit b) noexcept { return a.raw_ >= b.raw_; }
  friend constexpr Unit operator-(Unit a) noexcept { return from_raw(saturating_negate(a.raw_)); }
  friend constexpr Unit operator+(Unit a, Unit b) noexcept {
    return from_raw(saturating_add(a.raw_, b.raw_));
  }
  friend constexpr Unit operator-(Unit a, Unit b) noexcept {
    return from_raw(saturating_subtract(a.raw_, b.raw_));
  }
  friend constexpr Unit operator*(Unit a, int32_t k) noexcept {
    return from_raw(saturate32(signed_product(a.raw_, k)));
  }
  /// Times a fixed-point factor, rounded to nearest.
  template <int kFraction, class Rep>
  friend constexpr Unit operator*(Unit a, Fixed<kFraction, Rep> k) noexcept {
    return from_raw(saturate32(scale_down<kFraction>(signed_product(a.raw_, k.raw()))));
  }
  /// Rounded to nearest. k > 0, so the quotient fits.
  friend constexpr Unit operator/(Unit a, int32_t k) noexcept {
    return from_raw(divide_rounded_32(a.raw_, k));
  }
  constexpr Unit& operator+=(Unit b) noexcept { return *this = *this + b; }
  constexpr Unit& operator-=(Unit b) noexcept { return *this = *this - b; }

 private:
  int32_t raw_ = 0;
};

using Length = Unit<struct LengthTag>;
using Speed = Unit<struct SpeedTag>;
using Acceleration = Unit<struct AccelerationTag>;
using AngularRate = Unit<struct AngularRateTag>;
using Duration = Unit<struct DurationTag>;
using Ratio = Unit<struct RatioTag>;

// Parentheses, because Arduino and some vendors' headers define macros abs(), min() and max(). Choosing
// between raw values, not between units, keeps the compilers from putting both on the stack.
template <class Tag>
constexpr Unit<Tag>(abs)(Unit<Tag> a) noexcept {
  return a.raw() < 0 ? -a : a;
}
template <class Tag>
constexpr Unit<Tag>(min)(Unit<Tag> a, Unit<Tag> b) noexcept {
  return Unit<Tag>::from_raw(b < a ? b.raw() : a.raw());
}
template <class Tag>
constexpr Unit<Tag>(max)(Unit<Tag> a, Unit<Tag> b) noexcept {
  return Unit<Tag>::from_raw(a < b ? b.raw() : a.raw());
}
/// x limited to [-limit, limit]. limit >= 0.
template <class Tag>
constexpr Unit<Tag> limit(Unit<Tag> x, Unit<Tag> limit) noexcept {
  return (max)(-limit, (min)(x, limit));
}

/// An instant on a millisecond counter that wraps; compare instants by their difference only.
class Time {
 public:
  constexpr Time() noexcept = default;
  static constexpr Time from_raw(uint32_t ms) noexcept {
    Time t;
    t.ms_ = ms;
    return t;
  }
  constexpr uint32_t raw() const noexcept { return ms_; }
  /// Valid for instants less than 24.8 days apart.
  friend constexpr Duration operator-(Time a, Time b) noexcept {
    return Duration::from_raw(as_signed(a.ms_ - b.ms_));
  }
  friend constexpr Time operator+(Time a, Duration d) noexcept {
    return from_raw(a.ms_ + static_cast<uint32_t>(d.raw()));
  }
  friend constexpr Time operator-(Time a, Duration d) noexcept {
    return from_raw(a.ms_ - static_cast<uint32_t>(d.raw()));
  }

 private:
  uint32_t ms_ = 0;
};

constexpr Length micrometres(int32_t um) noexcept { return Length::from_raw(um); }
constexpr Length millimetres(int32_t mm) noexcept {
  constexpr int32_t kMost = INT32_MAX / 1000;
  return Length::from_raw(mm > kMost ? INT32_MAX : mm < -kMost ? INT32_MIN : mm * 1000);
}
constexpr Duration milliseconds(int32_t ms) noexcept { return Duration::from_raw(ms); }
constexpr Ratio millionths(int32_t ppm) noexcept { return Ratio::from_raw(ppm); }

namespace literals {
constexpr Length operator""_mm(unsigned long long x) noexcept {
  return Length::from_raw(narrow<int32_t>(x * 1000));
}
constexpr Length operator""_m(unsigned long long x) noexcept {
  return Length::from_raw(narrow<int32_t>(x * 1000000));
}
constexpr Speed operator""_mm_per_s(unsigned long long x) noexcept {
  return Speed::from_raw(narrow<int32_t>(x * 1000));
}
constexpr Acceleration operator""_mm_per_s2(unsigned long long x) noexcept {
  return Acceleration::from_raw(narrow<int32_t>(x * 1000));
}
constexpr AngularRate operator""_mrad_per_s(unsigned long long x) noexcept {
  return AngularRate::from_raw(narrow<int32_t>(x * 1000));
}
constexpr Duration operator""_ms(unsigned long long x) noexcept {
  return Duration::from_raw(narrow<int32_t>(x));
}
}  // namespace literals

/// The distance covered at this speed in this time.
constexpr Length operator*(Speed v, Duration t) noexcept {
  return Length::from_raw(multiply_divide(v.raw(), t.raw(), 1000));
}
constexpr Speed operator*(Acceleration a, Duration t) noexcept {
  return Speed::from_raw(multiply_divide(a.raw(), t.raw(), 1000));
}
/// The speed of a point at this distance from the axis.
constexpr Speed operator*(AngularRate w, Length radius) noexcept {
  return Speed::from_raw(multiply_divide(w.raw(), radius.raw(), 1000000));
}

static_assert((Time::from_raw(5) - Time::from_raw(0xFFFFFFFBU)).raw() == 10);
static_assert((Time::from_raw(0xFFFFFFFBU) - Time::from_raw(5)).raw() == -10);

}  // namespace whisker
