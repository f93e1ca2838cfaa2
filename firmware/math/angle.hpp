/// Angles as binary fractions of a turn: they wrap without loss of precision.
#pragma once

#include <stdint.h>

#include "firmware/math/fixed.hpp"
#include "firmware/math/units.hpp"

namespace whisker {

/// An angle; raw unit 2^-32 turn, counter-clockwise positive. Sums wrap intentionally.
class Angle {
 public:
  constexpr Angle() noexcept = default;
  static constexpr Angle from_raw(uint32_t raw) noexcept {
    Angle a;
    a.raw_ = raw;
    return a;
  }
  /// numerator / denominator of a turn, rounded to nearest. |numerator| < 2^30, 0 < denominator.
  static constexpr Angle turns(int32_t numerator, int32_t denominator) noexcept {
    return from_raw(static_cast<uint32_t>(
        static_cast<uint64_t>(divide_rounded(int64_t{numerator} * (INT64_C(1) << 32), denominator))));
  }
  constexpr uint32_t raw() const noexcept { return raw_; }
  /// The same angle in [-half a turn, half a turn), unit 2^-32 turn.
  constexpr int32_t wrapped() const noexcept { return as_signed(raw_); }

  friend constexpr bool operator==(Angle a, Angle b) noexcept { return a.raw_ == b.raw_; }
  friend constexpr bool operator!=(Angle a, Angle b) noexcept { return a.raw_ != b.raw_; }
  friend constexpr Angle operator-(Angle a) noexcept { return from_raw(0U - a.raw_); }
  friend constexpr Angle operator+(Angle a, Angle b) noexcept { return from_raw(a.raw_ + b.raw_); }
  friend constexpr Angle operator-(Angle a, Angle b) noexcept { return from_raw(a.raw_ - b.raw_); }
  friend constexpr Angle operator*(Angle a, int32_t k) noexcept {
    return from_raw(a.raw_ * static_cast<uint32_t>(k));
  }
  constexpr Angle& operator+=(Angle b) noexcept { return *this = *this + b; }
  constexpr Angle& operator-=(Angle b) noexcept { return *this = *this - b; }

 private:
  uint32_t raw_ = 0;
};

/// The absolute value of the smaller turn between the angle and zero, unit 2^-32 turn, at most 2^31.
constexpr uint32_t magnitude(Angle a) noexcept { return magnitude(a.wrapped()); }

/// The wrapped angle times a factor, rounded to nearest; the product must stay within half a turn.
template <int kFraction, class Rep>
constexpr Angle scaled(Angle a, Fixed<kFraction, Rep> k) noexcept {
  const int64_t turn = scale_down<kFraction>(signed_product(a.wrapped(), k.raw()));
  return Angle::from_raw(static_cast<uint32_t>(static_cast<uint64_t>(turn)));
}

/// The arc length of a point at this radius; the angle is taken in [-1/2, 1/2) turn. |radius| <= 600 m.
constexpr Length arc(Angle a, Length radius) noexcept {
  constexpr int64_t kTwoPiQ28 = 1686629713;
  const int64_t circumference = scale_down<28>(radius.raw() * kTwoPiQ28);
  return Length::from_raw(saturate32(scale_down<32>(a.wrapped() * circumference)));
}

/// The angle of an arc of this length at this radius, modulo a turn. radius > 0.
constexpr Angle angle_of(Length arc, Length radius) noexcept {
  constexpr int64_t kRadianQ0 = 683565276;  // 2^32 / 2 pi
  const int64_t raw = divide_rounded(arc.raw() * kRadianQ0, radius.raw());
  return Angle::from_raw(static_cast<uint32_t>(static_cast<uint64_t>(raw)));
}

/// A direction from straight ahead, counter-clockwise positive; raw unit 2^-32 turn. Unlike angles,
/// directions have an order.
using Direction = Unit<struct DirectionTag>;
constexpr Direction direction_of(Angle a) noexcept { return Direction::from_raw(a.wrapped()); }
constexpr Angle angle_of(Direction d) noexcept { return Angle::from_raw(static_cast<uint32_t>(d.raw())); }

namespace literals {
constexpr Angle operator""_deg(unsigned long long x) noexcept {
  return Angle::from_raw(static_cast<uint32_t>(((x << 32) + 180) / 360));
}
}  // namespace literals

static_assert(Angle::turns(1, 2) + Angle::turns(1, 2) == Angle{});
static_assert(Angle::turns(-1, 4) == Angle::turns(3, 4));
static_assert(Angle::turns(1, 2).wrapped() == INT32_MIN);

}  // namespace whisker
