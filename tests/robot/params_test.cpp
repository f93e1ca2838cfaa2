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
constexpr Params with_guard_margin(Length margin) {
  Params p;
  p.boundary.guard_margin = margin;
  return p;
}
static_assert(check(Params{}) == ParamFault::none);
static_assert(check(with_guard_margin(6_mm)) == ParamFault::none);
static_assert(check(with_guard_margin(7_mm)) == ParamFault::planning_below_guard_margin);
static_assert(check(with_guard_margin(501_mm)) == ParamFault::out_of_range);

TEST(Params, TheDefaultsAreAccepted) { EXPECT_EQ(check(Params{}), ParamFault::none); }

struct Broken {
  ParamFault fault;
  std::function<void(Params&)> apply;
};

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
      {ParamFault::danger_inside_body, [](Params& p) { p.thesis.danger_range = 120_mm; }},
      {ParamFault::steps_reversed, [](Params& p) { p.thesis.small_step = 201_mm; }},
      {ParamFault::stop_longer_than_range, [](Params& p) { p.wheels.max_acceleration = 50_mm_per_s2; }},
      {ParamFault::stale_before_next_reading, [](Params& p) { p.conditioning.stale_after = 40_ms; }},
      {ParamFault::lost_before_stale, [](Params& p) { p.safety.lost_after = 99_ms; }},
      {ParamFault::tolerance_below_encoder, [](Params& p) { p.wheels.counts_per_metre = 400; }},
      {ParamFault::tolerance_below_encoder,
       [](Params& p) { p.motion.turn_tolerance = Angle::turns(1, 3600); }},
      {ParamFault::gap_below_period, [](Params& p) { p.safety.max_gap = 19_ms; }},
      {ParamFault::stuck_within_cone,
       [](Params& p) { p.conditioning.stuck_turn = p.rangefinders.cone = 30_deg; }},
      {ParamFault::cone_too_wide, [](Params& p) { p.rangefinders.cone = 60_deg + Angle::from_raw(1); }},
      {ParamFault::tolerance_above_step,
       [](Params& p) { p.motion.drive_tolerance = p.thesis.small_step = 20_mm; }},
      {ParamFault::tolerance_above_step, [](Params& p) { p.motion.turn_tolerance = p.thesis.delta = 5_deg; }},
      {ParamFault::tolerance_below_wire,
       [](Params& p) {
         p.wheels.counts_per_metre = 1000000;
         p.body.track = 20_mm;
         p.motion.turn_tolerance = Angle::turns(1, 3600);
         p.motion.settle = 1000_ms;
       }},
      {ParamFault::stalled_before_count,
       [](Params& p) {
         p.safety.stalled_after = 200_ms;
         p.motion.settle = 200_ms;
       }},
      {ParamFault::settle_below_lag, [](Params& p) { p.motion.settle = 59_ms; }},
      {ParamFault::step_beyond_range, [](Params& p) { p.thesis.base_step = 941_mm; }},
      {ParamFault::step_beyond_range, [](Params& p) { p.rangefinders.clear_range = 519_mm; }},
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
         p.motion.turn_tolerance = 4_deg;
         p.motion.drive_tolerance = 5_mm;
         p.safety.stalled_after = 4000_ms;
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
      {ParamFault::local_grid_too_small, [](Params& p) { p.boundary.probe = 200_mm; }},
      {ParamFault::local_grid_too_small, [](Params& p) { p.boundary.probe = 44_mm; }},
      {ParamFault::local_grid_too_small,
       [](Params& p) {
         p.body.radius = 340_mm;
         p.thesis.danger_range = 500_mm;
         p.rangefinders.incidence = 80_deg;
       }},
      {ParamFault::planning_below_guard_margin, [](Params& p) { p.boundary.guard_margin = 7_mm; }},
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
         p.thesis.danger_range = 500_mm;
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
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kParamFaults) - 1) << "of them all";
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
  std::multiset<ParamFault> asked;
  for_each_relation(Params{}, [&asked](ParamFault fault, bool holds) {
    EXPECT_TRUE(holds) << name(fault);
    asked.insert(fault);
    return true;
  });
  ASSERT_EQ(asked.size(), static_cast<std::size_t>(kParamFaults) - 1);
  for (int i = 1; i < kParamFaults; ++i) EXPECT_EQ(asked.count(static_cast<ParamFault>(i)), 1U) << i;

  Params p;
  p.body.track = 181_mm;
  p.thesis.small_step = 201_mm;
  p.boundary.guard_margin = 7_mm;
  EXPECT_EQ(violated(p), (std::set<ParamFault>{ParamFault::track_wider_than_body, ParamFault::steps_reversed,
                                               ParamFault::planning_below_guard_margin}));
  EXPECT_EQ(check(p), ParamFault::track_wider_than_body) << "the first";
}

TEST(Params, NoRelationIsAskedOfValuesOutsideTheirRanges) {
  Params p;
  p.rangefinders.rate_hz = 0;  // a divisor
  EXPECT_EQ(violated(p), std::set<ParamFault>{ParamFault::out_of_range});
}

TEST(Params, EveryFaultHasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < kParamFaults; ++i) names.insert(name(static_cast<ParamFault>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kParamFaults));
  EXPECT_EQ(names.count("?"), 0U);
  EXPECT_STREQ(name(ParamFault::none), "none");
  EXPECT_STREQ(name(ParamFault::track_wider_than_body), "track_wider_than_body");
  EXPECT_STREQ(name(static_cast<ParamFault>(kParamFaults)), "?");
}

TEST(Params, EachNewestRelationHoldsExactlyAtItsLimit) {
  Params p;
  p.conditioning.stuck_turn = 60_deg;
  p.rangefinders.cone = 60_deg - Angle::from_raw(1);
  EXPECT_EQ(check(p), ParamFault::none);
  p = {};
  p.rangefinders.cone = 60_deg;
  EXPECT_EQ(check(p), ParamFault::none);
  p = {};
  p.rangefinders.clear_range = 520_mm;  // 2 x 0.2 + 0.12 m
  EXPECT_EQ(check(p), ParamFault::none);
  p = {};
  p.thesis.small_step = 20_mm;
  p.motion.drive_tolerance = 20_mm - micrometres(1);
  p.motion.turn_tolerance = 5_deg - Angle::from_raw(1);
  p.thesis.delta = 5_deg;
  EXPECT_EQ(check(p), ParamFault::none);
  p = {};
  p.thesis.base_step = 940_mm;  // 2 x 0.94 + 0.12 m is the range
  EXPECT_EQ(check(p), ParamFault::none);
  p = {};
  p.motion.settle = p.wheels.motor_lag + p.safety.period;
  EXPECT_EQ(check(p), ParamFault::none);
  p.motion.settle = 80_ms;
  // 16 x 50 ms of lag, 6 x 10 ms of ticks, and twice the sum of: 80 ms, 0.2 mm at 0.21 m/s (1 ms), 0.2 mm at
  // 1 m/s^2 from rest (20 ms).
  p.safety.stalled_after = 1062_ms;
  EXPECT_EQ(check(p), ParamFault::none);
  p.safety.stalled_after = 1061_ms;
  EXPECT_EQ(check(p), ParamFault::stalled_before_count);
}

TEST(Params, AChoiceOutsideItsNamesIsRefused) {
  for (const int wrong : {2, 3, 255}) {
    Params p;
    p.conditioning.consensus = static_cast<Consensus>(wrong);
    EXPECT_EQ(check(p), ParamFault::out_of_range) << wrong;
    p = Params{};
    p.thesis.distance_source = static_cast<DistanceSource>(wrong);
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
