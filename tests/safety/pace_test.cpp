// The pace that the response table sets where clear ground is in doubt.
#include "firmware/safety/pace.hpp"

#include <gtest/gtest.h>

#include "firmware/fuzzy/engine.hpp"
#include "firmware/fuzzy/exact.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "firmware/planning/ground_inputs.hpp"
#include "firmware/planning/steering.hpp"
#include "firmware/safety/warning.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::test {
namespace {

using fuzzy::step_terms::M;
using fuzzy::step_terms::VB;

safety::Pace pace_of(const Params& params) {
  safety::Pace pace;
  pace.configure(params);
  return pace;
}

TEST(Pace, TheLargestStepOfTheCoresTableIsTheFullSpeed) {
  const Params p;
  EXPECT_NEAR(pace_of(p).wanted(VB, 900_mm).raw(), p.wheels.max_speed.raw(), 20);
  EXPECT_NEAR(pace_of(p).wanted(M, 900_mm).raw() * 1.7, p.wheels.max_speed.raw(), 50);
}

TEST(Pace, NoTableDrivesFasterThanTheNearestEchoAllows) {
  const safety::Pace pace = pace_of({});
  const Speed base = pace.wanted(M, 900_mm);
  const Q14 wild = Q14::from_raw(INT16_MAX);
  Speed last{};
  for (int mm = 0; mm <= 900; mm += 10) {
    const Speed now = pace.wanted(wild, millimetres(mm));
    EXPECT_LE(now.raw(), base.raw() * (mm / 450.0) + 1) << mm;
    EXPECT_GE(now, last);
    last = now;
  }
}

TEST(Pace, TheCoresTableAsksForNoMore) {
  const safety::Pace pace = pace_of({});
  const fuzzy::Engine engine(fuzzy::kDefaultTable);
  for (int mm = 450; mm <= 900; ++mm) {
    const Q7 distance = Q7::from_raw(static_cast<int16_t>(1280 * mm / 900));
    const Q14 step = engine({distance, {}}).step;
    EXPECT_NEAR(pace.wanted(step, millimetres(mm)).raw(), pace.wanted(step, 10_m).raw(), 20) << mm;
  }
}

TEST(Pace, RisesFromTheFloorAndFallsSmoothlyAndAtOnceToNothing) {
  const Params p;
  safety::Pace pace = pace_of(p);
  const Speed rise = p.wheels.max_acceleration * 10_ms / 4, fall = p.wheels.max_acceleration * 10_ms / 2;
  EXPECT_EQ(pace.follow(300_mm_per_s, 175_mm_per_s, 10_ms, p), 175_mm_per_s + rise);
  EXPECT_EQ(pace.follow(300_mm_per_s, 175_mm_per_s, 10_ms, p), 175_mm_per_s + rise * 2);
  EXPECT_EQ(pace.follow(20_mm_per_s, 175_mm_per_s, 10_ms, p), 175_mm_per_s + rise * 2 - fall);
  EXPECT_EQ(pace.follow({}, 175_mm_per_s, 10_ms, p), Speed{});
  for (int i = 0; i < 200; ++i) pace.follow(300_mm_per_s, 175_mm_per_s, 10_ms, p);
  EXPECT_EQ(pace.follow(300_mm_per_s, 175_mm_per_s, 10_ms, p), 300_mm_per_s);
}

TEST(Pace, EveryBodyStopsWithinASixthOfWhatItSees) {
  worlds::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    Params p;
    p.body.radius = millimetres(static_cast<int32_t>(random.uniform(20, 1000)));
    p.wheels.max_speed = Speed::from_raw(static_cast<int32_t>(random.uniform(20e3, 5e6)));
    p.wheels.max_acceleration = Acceleration::from_raw(static_cast<int32_t>(random.uniform(50e3, 5e6)));
    p.rangefinders.latency = milliseconds(static_cast<int32_t>(random.uniform(0, 200)));
    p.rangefinders.rate_hz = static_cast<int32_t>(random.uniform(5, 100));
    const double delay = safety::warning_delay(p, false).raw() * 1e-3;
    const double sight = p.body.radius.raw() * 1e-6 * planning::kSight;
    for (double share = 0.05; share <= 1; share += 0.05) {
      const Length nearest = Length::from_raw(static_cast<int32_t>(sight * share * 1e6));
      const double v = pace_of(p).wanted(VB, nearest).raw() * 1e-6;
      const double stop = v * delay + v * v / 2 / (p.wheels.max_acceleration.raw() * 1e-6);
      EXPECT_LE(stop, sight * share / 6 + 1e-5) << "robot " << i << ", " << share;
    }
  }
}

}  // namespace
}  // namespace whisker::test
