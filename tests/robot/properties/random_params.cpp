#include "tests/robot/properties/random_params.hpp"

#include <cstdint>
#include <string_view>

namespace whisker::test {
namespace {

/// The boards of these tests have no bumper.
bool is_of_a_bumper(const std::string_view key) { return key == "bumper" || key == "creep_speed_mps"; }

/// Gives each field in turn a new value, and restores it if check() rejects the set.
struct Draw {
  Params& whole;
  Bits& bits;

  template <class T>
  void draw(T& field, std::int64_t low, std::int64_t high, T (*make)(std::int64_t)) {
    const T old = field;
    switch (bits.whole(0, 4)) {
      case 0: return;
      case 1: field = make(low); break;
      case 2: field = make(high); break;
      default: field = make(bits.between(low, high)); break;
    }
    if (check(whole) != ParamFault::none) field = old;
  }
  template <class Tag>
  void number(const char* key, Unit<Tag>& x, Unit<Tag> low, Unit<Tag> high) {
    if (!is_of_a_bumper(key))
      draw<Unit<Tag>>(x, low.raw(), high.raw(),
                      [](std::int64_t v) { return Unit<Tag>::from_raw(static_cast<std::int32_t>(v)); });
  }
  void number(const char*, Angle& x, Angle low, Angle high) {
    draw<Angle>(x, low.raw(), high.raw(),
                [](std::int64_t v) { return Angle::from_raw(static_cast<std::uint32_t>(v)); });
  }
  void count(const char*, std::int32_t& x, std::int32_t low, std::int32_t high) {
    draw<std::int32_t>(x, low, high, [](std::int64_t v) { return static_cast<std::int32_t>(v); });
  }
  template <class E>
  void choice(const char* key, E& x, const char* const*, int names) {
    if (!is_of_a_bumper(key)) draw<E>(x, 0, names - 1, [](std::int64_t v) { return static_cast<E>(v); });
  }
  void derived(const char*) {}
};

}  // namespace

Params random_params(Bits& bits) {
  Params params;
  // A change of one field may allow values of another, so every field gets several attempts.
  for (int pass = 0; pass < 3; ++pass) for_each_param(params, Draw{params, bits});
  return params;
}

Params robot_like_the_reference(Bits& bits) {
  Params p;
  do {
    p = Params{};
    const auto scale = static_cast<std::int32_t>(bits.whole(50, 300));  // per cent
    const auto scaled = [&](Length l) { return Length::from_raw(multiply_divide(l.raw(), scale, 100)); };
    p.body.radius = scaled(p.body.radius);
    p.body.track = scaled(p.body.track);
    p.body.margin = scaled(p.body.margin);
    p.wheels.counts_per_metre = static_cast<std::int32_t>(bits.whole(5000, 100000));
    p.wheels.max_speed = Speed::from_raw(static_cast<std::int32_t>(bits.whole(100, 600)) * 1000);
    p.wheels.max_acceleration =
        Acceleration::from_raw(static_cast<std::int32_t>(bits.whole(300, 2000)) * 1000);
    p.wheels.motor_lag = milliseconds(static_cast<std::int32_t>(bits.whole(0, 120)));
    p.rangefinders.rate_hz = static_cast<std::int32_t>(bits.whole(20, 80));
    p.rangefinders.latency = milliseconds(static_cast<std::int32_t>(bits.whole(0, 60)));
    p.safety.period = milliseconds(static_cast<std::int32_t>(bits.whole(5, 20)));
  } while (check(p) != ParamFault::none);
  return p;
}

}  // namespace whisker::test
