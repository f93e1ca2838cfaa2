#include "firmware/safety/supervisor.hpp"

#include <gtest/gtest.h>

namespace whisker::safety {
namespace {

/// Seconds until a running robot that stays in one place overstays.
int longest_stay_s(const Params& params) {
  Health health;
  Supervisor supervisor(params, health);
  supervisor.configure();
  int seconds = 1;
  while (!supervisor.overstays({}, true, 1000_ms) && seconds < 1000000) ++seconds;
  EXPECT_FALSE(supervisor.faulted()) << "nothing is broken";
  EXPECT_FALSE(supervisor.overstays({}, false, 1000_ms));
  EXPECT_FALSE(supervisor.overstays({}, true, 1000_ms)) << "the next mission has as much time";
  return seconds;
}

TEST(Supervisor, OnePlaceIsLeftInMinutes) {
  EXPECT_GT(longest_stay_s({}), 60);
  EXPECT_LT(longest_stay_s({}), 600);
}

// Wheels of 0.02 m/s, 2 m apart: a full turn takes 314 s.
TEST(Supervisor, SlowWheelsFarApartHaveTheTimeToTurn) {
  Params params;
  params.body.track = 2_m;
  params.body.radius = 1_m;
  params.wheels.max_speed = 20_mm_per_s;
  EXPECT_GT(longest_stay_s(params), 20 * 314);
}

TEST(Supervisor, WhoLeavesThePlaceOrRestsIsNotCounted) {
  Health health;
  const Params params;
  Supervisor supervisor(params, health);
  supervisor.configure();
  for (int s = 0; s < 10000; ++s) EXPECT_FALSE(supervisor.overstays({}, false, 1000_ms));
  for (int s = 0; s < 10000; ++s)
    EXPECT_FALSE(supervisor.overstays({millimetres(s % 100 < 50 ? 0 : 40), {}}, true, 1000_ms));
}

TEST(Supervisor, PressesInOnePlaceAreBounded) {
  Health health;
  const Params params;
  Supervisor supervisor(params, health);
  supervisor.configure();
  for (int i = 0; i < 30; ++i) supervisor.check_bump({millimetres(100 * (i % 5)), {}});
  EXPECT_FALSE(supervisor.faulted());
  supervisor.check_bump({});
  EXPECT_EQ(health.fault, Fault::no_progress);
  EXPECT_EQ(health.bumps, 31U);
}

TEST(Supervisor, PressesElsewhereOrInTheNextMissionCountAnew) {
  Health health;
  const Params params;
  Supervisor supervisor(params, health);
  supervisor.configure();
  for (int i = 0; i < 300; ++i) supervisor.check_bump({millimetres(100 * i), {}});
  for (int mission = 0; mission < 10; ++mission) {
    supervisor.overstays({}, false, 10_ms);
    for (int i = 0; i < 25; ++i) supervisor.check_bump({});
  }
  EXPECT_FALSE(supervisor.faulted());
}

TEST(Supervisor, TheFirstFaultStays) {
  Health health;
  const Params params;
  Supervisor supervisor(params, health);
  supervisor.configure();
  supervisor.check_ranges(derived::lost_after(params) + 1_ms);
  supervisor.check_gap({}, false);
  EXPECT_EQ(health.fault, Fault::range_lost);
  EXPECT_EQ(health.clock_jumps, 1U) << "counted all the same";
  supervisor.reset();
  EXPECT_FALSE(supervisor.faulted());
}

}  // namespace
}  // namespace whisker::safety
