#include "firmware/params.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "hal/types.hpp"

namespace whisker {
namespace {

// Errors that the compiler finds.
constexpr Params with_track(Length track) {
  Params p;
  p.body.track = track;
  return p;
}
static_assert(check(Params{}) == ParamFault::none);
static_assert(check(with_track(180_mm)) == ParamFault::none);
static_assert(check(with_track(181_mm)) == ParamFault::track_wider_than_body);
static_assert(check(with_track(2001_mm)) == ParamFault::out_of_range);

TEST(Params, TheDefaultsAreAccepted) { EXPECT_EQ(check(Params{}), ParamFault::none); }

TEST(Params, LengthsForABodyAreInProportionToItsRadius) {
  Params p;
  for (std::int32_t radius = 1; radius <= 600'000; radius += radius / 50 + 1) {
    p.body.radius = micrometres(radius);
    for (std::int32_t um = 1; um <= 60'000'000; um += um / 40 + 1) {
      const std::int32_t expected = multiply_divide(um, radius, 90'000);
      ASSERT_EQ(for_body(p, micrometres(um)).raw(), expected) << um << " for " << radius;
      ASSERT_EQ(for_body(p, micrometres(-um)).raw(), -expected) << -um << " for " << radius;
    }
  }
  EXPECT_EQ(for_body(p, Length{}), Length{});
}

struct Broken {
  ParamFault fault;
  std::function<void(Params&)> apply;
};

std::multiset<ParamFault> relations() {
  std::multiset<ParamFault> asked;
  for_each_relation(Params{}, [&asked](ParamFault fault, bool holds) {
    EXPECT_TRUE(holds) << name(fault);
    asked.insert(fault);
    return true;
  });
  return asked;
}

TEST(Params, EveryRelationIsChecked) {
  const Broken cases[] = {
      {ParamFault::out_of_range, [](Params& p) { p.body.radius = Length{}; }},
      {ParamFault::out_of_range, [](Params& p) { p.conditioning.consensus = static_cast<Consensus>(2); }},
      {ParamFault::track_wider_than_body,
       [](Params& p) { p.body.track = p.body.radius * 2 + micrometres(1); }},
      {ParamFault::ranges_reversed,
       [](Params& p) { p.rangefinders.min_range = p.rangefinders.max_range = 300_mm; }},
      {ParamFault::cones_apart_from_front,
       [](Params& p) {
         p.rangefinders.side_angle = 80_deg;
         p.rangefinders.cone = 30_deg;
       }},
      {ParamFault::stop_longer_than_range, [](Params& p) { p.wheels.max_acceleration = 50_mm_per_s2; }},
      {ParamFault::stale_before_next_reading, [](Params& p) { p.conditioning.stale_after = 40_ms; }},
      {ParamFault::gap_below_period, [](Params& p) { p.safety.max_gap = 19_ms; }},
      {ParamFault::cone_too_wide, [](Params& p) { p.rangefinders.cone = 60_deg + Angle::from_raw(1); }},
      {ParamFault::tolerance_above_step,
       [](Params& p) {
         p.wheels.counts_per_metre = 100;
         p.body.track = 100_mm;
       }},
      {ParamFault::tolerance_above_step,
       [](Params& p) {
         p.wheels.counts_per_metre = 100;
         p.rangefinders.clear_range = 160_mm;
       }},
      {ParamFault::stalled_before_count,
       [](Params& p) {
         p.wheels.counts_per_metre = 150;
         p.wheels.max_speed = 100_mm_per_s;
         p.wheels.max_acceleration = 50_mm_per_s2;
         p.wheels.max_turn_rate = 100_mrad_per_s;
         p.wheels.motor_lag = 500_ms;
       }},
      {ParamFault::step_beyond_range, [](Params& p) { p.rangefinders.clear_range = 159_mm; }},
      {ParamFault::cone_too_narrow,
       [](Params& p) {
         p.rangefinders.cone = 3_deg;
         p.rangefinders.offset = 80_mm;
       }},
      {ParamFault::cone_too_narrow, [](Params& p) { p.rangefinders.offset = 140_mm; }},
      {ParamFault::cone_too_narrow, [](Params& p) { p.rangefinders.beams[2].cone = Angle::from_raw(1); }},
      // One count of each wheel turns the body by 3.2 degrees, and the cones are 4 degrees wide.
      {ParamFault::cone_too_narrow,
       [](Params& p) {
         p.rangefinders.cone = 4_deg;
         p.wheels.counts_per_metre = 250;
       }},
      {ParamFault::creep_without_bumper, [](Params& p) { p.bumper.creep_speed = 50_mm_per_s; }},
      {ParamFault::gyro_unfit,
       [](Params& p) {
         p.gyro.fitted = Fitted::yes;
         p.gyro.range = 3749_mrad_per_s;
       }},
      {ParamFault::walls_without_bound, [](Params& p) { p.walls.straight = Fitted::yes; }},
      {ParamFault::beams_crossed,
       [](Params& p) { p.rangefinders.beams[hal::kFront].angle = direction_of(31_deg); }},
      {ParamFault::local_grid_too_small,
       [](Params& p) {
         p.body.radius = 340_mm;
         p.rangefinders.incidence = 80_deg;
       }},
      {ParamFault::local_grid_too_small, [](Params& p) { p.boundary.guard_margin = 200_mm; }},
      {ParamFault::walls_unseen, [](Params& p) { p.rangefinders.incidence = 47_deg; }},
      {ParamFault::walls_unseen,
       [](Params& p) {
         p.rangefinders.incidence = 14_deg;
         p.rangefinders.side_angle = 75_deg;
         p.rangefinders.cone = 12_deg;
       }},
      {ParamFault::flank_unseen,
       [](Params& p) {
         p.body.radius = 300_mm;
         p.body.track = 400_mm;
         p.rangefinders.incidence = 80_deg;
         p.rangefinders.side_angle = 20_deg;
       }},
      {ParamFault::flank_unseen,
       [](Params& p) {
         p.rangefinders.incidence = 60_deg;
         p.rangefinders.side_angle = 60_deg;
         p.wheels.max_speed = 400_mm_per_s;
       }},
      {ParamFault::blind_at_rim,
       [](Params& p) {
         p.rangefinders.incidence = 60_deg;
         p.rangefinders.min_range = 142_mm;
       }},
  };
  std::set<ParamFault> seen;
  for (const Broken& c : cases) {
    Params p;
    c.apply(p);
    EXPECT_EQ(check(p), c.fault) << static_cast<int>(c.fault);
    seen.insert(c.fault);
  }
  EXPECT_EQ(seen.size(), relations().size()) << "of them all";
}

std::set<ParamFault> violated(const Params& p) {
  std::set<ParamFault> found;
  for_each_relation(p, [&found](ParamFault fault, bool holds) {
    if (!holds) found.insert(fault);
    return true;
  });
  return found;
}

TEST(Params, EveryRelationIsAskedOnceAndAllThatFailAreFound) {
  const std::multiset<ParamFault> asked = relations();
  EXPECT_EQ(std::set<ParamFault>(asked.begin(), asked.end()).size(), asked.size());

  Params p;
  p.body.track = 181_mm;
  p.bumper.creep_speed = 50_mm_per_s;
  p.rangefinders.clear_range = 159_mm;
  EXPECT_EQ(violated(p),
            (std::set<ParamFault>{ParamFault::track_wider_than_body, ParamFault::step_beyond_range,
                                  ParamFault::creep_without_bumper}));
  EXPECT_EQ(check(p), ParamFault::track_wider_than_body) << "the first";
}

TEST(Params, NoRelationIsAskedOfValuesOutsideTheirRanges) {
  Params p;
  p.rangefinders.rate_hz = 0;  // a divisor
  EXPECT_EQ(violated(p), std::set<ParamFault>{ParamFault::out_of_range});
}

TEST(Params, EveryFaultHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const ParamFault fault : relations()) names.insert(name(fault));
  EXPECT_EQ(names.size(), relations().size());
  EXPECT_EQ(names.count("?"), 0U);
  EXPECT_STREQ(name(ParamFault::none), "none");
  EXPECT_STREQ(name(ParamFault::track_wider_than_body), "track_wider_than_body");
  EXPECT_STREQ(name(static_cast<ParamFault>(kParamFaults)), "?");
}

TEST(Params, EachNewestRelationHoldsExactlyAtItsLimit) {
  Params p;
  p.rangefinders.cone = 60_deg;
  EXPECT_EQ(check(p), ParamFault::none);
  p = {};
  p.rangefinders.clear_range = 160_mm;  // 2 x 0.02 + 0.12 m
  EXPECT_EQ(check(p), ParamFault::none);
}

TEST(Derived, FollowsTheHardware) {
  Params p;
  EXPECT_EQ(derived::base_step(p), 200_mm);
  EXPECT_EQ(derived::small_step(p), 100_mm);
  EXPECT_EQ(derived::danger_range(p), 300_mm);
  EXPECT_EQ(derived::most_steps(p), 4000);
  EXPECT_EQ(derived::settle_time(p), 80_ms);
  EXPECT_EQ(derived::lost_after(p), 1000_ms);
  EXPECT_EQ(derived::stalled_after(p), 2000_ms);
  EXPECT_EQ(derived::turn_tolerance(p), 1_deg);
  EXPECT_EQ(derived::drive_tolerance(p), 2_mm);
  p.rangefinders.clear_range = 250_mm;
  p.wheels.motor_lag = 200_ms;
  p.conditioning.stale_after = 1500_ms;
  p.wheels.counts_per_metre = 200;
  EXPECT_EQ(derived::base_step(p), 65_mm);
  EXPECT_EQ(derived::settle_time(p), 210_ms);
  EXPECT_EQ(derived::lost_after(p), 1500_ms);
  EXPECT_EQ(derived::drive_tolerance(p), 5_mm);
  EXPECT_GE(arc(derived::turn_tolerance(p), p.body.track / 2), 5_mm);
  EXPECT_LE(arc(derived::turn_tolerance(p), p.body.track / 2), 5_mm + micrometres(2));
  // 16 x 200 ms of lag, 6 x 10 ms of ticks, and twice the sum of: 210 ms, 5 mm at 0.21 m/s (24 ms), 5 mm at
  // 1 m/s^2 from rest (100 ms).
  EXPECT_EQ(derived::stalled_after(p), 3928_ms);
  EXPECT_EQ(check(p), ParamFault::none);
  p.body.radius = 300_mm;
  EXPECT_EQ(derived::danger_range(p), 825_mm);
}

TEST(Params, AChoiceOutsideItsNamesIsRefused) {
  for (const int wrong : {2, 3, 255}) {
    Params p;
    p.conditioning.consensus = static_cast<Consensus>(wrong);
    EXPECT_EQ(check(p), ParamFault::out_of_range) << wrong;
    p = Params{};
    p.bumper.fitted = static_cast<Fitted>(wrong);
    EXPECT_EQ(check(p), ParamFault::out_of_range) << wrong;
  }
}

/// Sets field number `wanted` just outside its range, low or high, and stores its key.
struct PushOut {
  int wanted;
  bool high;
  int index = 0;
  std::string key;
  template <class Tag>
  void number(const char* k, Unit<Tag>& x, Unit<Tag> low, Unit<Tag> top) {
    if (index++ != wanted) return;
    key = k;
    x = high ? top + Unit<Tag>::from_raw(1) : low - Unit<Tag>::from_raw(1);
  }
  void number(const char* k, Angle& x, Angle low, Angle top) {
    if (index++ != wanted) return;
    key = k;
    x = high ? top + Angle::from_raw(1) : low - Angle::from_raw(1);
  }
  void count(const char* k, std::int32_t& x, std::int32_t low, std::int32_t top) {
    if (index++ != wanted) return;
    key = k;
    x = high ? top + 1 : low - 1;
  }
  template <class E>
  void choice(const char* k, E& x, const char* const*, int names) {
    if (index++ != wanted) return;
    key = k;
    x = static_cast<E>(names);
  }
  void derived(const char*) {}
};

TEST(Params, EveryFieldHasARangeAtBothEndsAndAKeyOfItsOwn) {
  Params counted;
  PushOut counter{-1, false, 0, {}};
  for_each_param(counted, counter);
  std::set<std::string> keys;
  for (int i = 0; i < counter.index; ++i) {
    for (const bool high : {false, true}) {
      Params p;
      PushOut push{i, high, 0, {}};
      for_each_param(p, push);
      EXPECT_EQ(check(p), ParamFault::out_of_range) << push.key << (high ? " high" : " low");
      keys.insert(push.key);
    }
  }
  EXPECT_EQ(keys.size(), static_cast<std::size_t>(counter.index));
  EXPECT_GE(counter.index, 30);
}

/// Intervals from a reading that is the newest at a tick to the next such reading but one, at most.
std::int32_t most_intervals(std::int32_t period_ms, std::int32_t rate_hz) {
  std::int32_t most = 0, last = 0, before = 0;
  for (std::int32_t tick = 1; tick <= 2000; ++tick) {
    const std::int32_t newest = tick * period_ms * rate_hz / 1000;
    if (newest == last) continue;
    if (before > 0) most = std::max(most, newest - before);
    before = last;
    last = newest;
  }
  return most;
}

// Ticks and readings at rates that are no multiples of each other: 56 Hz at 50 Hz skips a reading now and
// then.
TEST(TurnRate, KeepsTheNewestReadingsOfTicksWithinAStep) {
  Params p;
  p.rangefinders.offset = 80_mm;
  ASSERT_TRUE(rim_sweep(p).needed);
  const double step_rad = rim_sweep(p).step.raw() * (6.283185 / 4294967296.0) * 0.8;
  for (std::int32_t period = 5; period <= 20; ++period) {
    for (std::int32_t rate = 5; rate <= 100; ++rate) {
      p.safety.period = milliseconds(period);
      p.rangefinders.rate_hz = rate;
      const double turn = turn_rate(p).raw() * 1e-6 / rate * most_intervals(period, rate);
      EXPECT_LE(turn, step_rad * 1.0001) << rate << " Hz, " << period << " ms";
      const bool limited = turn_rate(p) < p.wheels.max_turn_rate;
      EXPECT_TRUE(!limited || turn > step_rad * 0.999) << rate << " Hz, " << period << " ms";
    }
  }
}

}  // namespace
}  // namespace whisker
