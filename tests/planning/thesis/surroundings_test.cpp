#include "firmware/planning/thesis/surroundings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "firmware/planning/thesis/near_way.hpp"
#include "firmware/planning/thesis/step_probe.hpp"

namespace whisker::planning {
namespace {

using perception::Echo;
using perception::Echoes;
using perception::Validity;

Echoes seen(int left_mm, int front_mm, int right_mm) {
  Echoes e;
  const int mm[] = {left_mm, front_mm, right_mm};
  for (int i = 0; i < hal::kBeams; ++i) e.beam[i] = {millimetres(mm[i]), Validity::ok};
  return e;
}

class SurroundingsTest : public testing::Test {
 protected:
  SurroundingsTest() { ring_.configure(params_); }
  Params params_;
  Surroundings ring_;
};

TEST_F(SurroundingsTest, ObjectToNothingWithoutALook) { EXPECT_TRUE(ring_.allow(Angle{}, 1_m)); }

// The beams of the last scan alone cannot cover this case: a corner 0.1 m away, 55 degrees off the heading.
TEST_F(SurroundingsTest, RememberACornerThatHasLeftTheCones) {
  ring_.add(seen(2000, 2000, 99), 17_deg);  // the right cone covers -25.5 to -0.5 degrees
  EXPECT_FALSE(ring_.allow(47_deg, 100_mm));
  EXPECT_FALSE(ring_.allow(75_deg, 100_mm));
  EXPECT_TRUE(ring_.allow(100_deg, 100_mm)) << "behind the flank nothing gets nearer";
  ring_.forget();
  EXPECT_TRUE(ring_.allow(47_deg, 100_mm));
}

TEST_F(SurroundingsTest, ASectorKeepsTheLargestDistanceThatWasProved) {
  ring_.add(seen(2000, 150, 2000), Angle{});
  EXPECT_FALSE(ring_.allow(Angle{}, 100_mm));
  // Cones beside the obstacle cover the same directions, so the obstacle lies at the edge between them.
  ring_.add(seen(2000, 2000, 2000), 12_deg);
  ring_.add(seen(2000, 2000, 2000), -(12_deg));
  EXPECT_TRUE(ring_.allow(Angle{}, 100_mm));
}

TEST_F(SurroundingsTest, WhatIsNotUsableProvesNothing) {
  Echoes lost = seen(99, 99, 99);
  for (Echo& e : lost.beam) e.validity = Validity::stale;
  ring_.add(lost, Angle{});
  EXPECT_TRUE(ring_.allow(Angle{}, 100_mm));
}

TEST_F(SurroundingsTest, LeftAndRightAreMirrored) {
  for (int deg = -180; deg < 180; deg += 7) {
    Surroundings mirrored = ring_;
    Surroundings ring = ring_;
    ring.add(seen(180, 900, 400), Angle::turns(deg, 360));
    mirrored.add(seen(400, 900, 180), Angle::turns(-deg, 360));
    for (int way = -180; way < 180; ++way) {
      ASSERT_EQ(ring.allow(Angle::turns(way, 360), 150_mm), mirrored.allow(Angle::turns(-way, 360), 150_mm))
          << deg << ' ' << way;
    }
  }
}

TEST_F(SurroundingsTest, AnApexAheadOfTheCentreMovesTheEchoOutAndNarrowsTheCone) {
  params_.rangefinders.offset = 60_mm;
  ring_.configure(params_);
  ring_.add(seen(2000, 130, 2000),
            Angle::turns(1, 144));  // 0.188 m from the centre, in the middle of a sector
  EXPECT_TRUE(ring_.allow(Angle{}, 60_mm));
  EXPECT_FALSE(ring_.allow(Angle{}, 80_mm));
  params_.rangefinders.offset = 1_m;
  ring_.configure(params_);
  ring_.forget();
  ring_.add(seen(10, 10, 10), Angle{});
  EXPECT_TRUE(ring_.allow(Angle{}, 1_m)) << "a cone that the body's rim never enters covers no direction";
}

constexpr double kPi = 3.14159265358979323846;

/// The smallest distance between the path and any point that the echo allows, by steps along the arc.
double nearest(double axis, double half, double offset, double d, double step) {
  double best = 1e9;
  for (int i = 0; i <= 4000; ++i) {
    const double a = axis - half + 2 * half * i / 4000;
    const double x = offset * std::cos(axis) + d * std::cos(a);
    const double y = offset * std::sin(axis) + d * std::sin(a);
    const double t = std::clamp(x, 0.0, step);
    best = std::min(best, std::hypot(x - t, y));
  }
  return best;
}

TEST(StepProbe, AgreesWithEveryPointThatTheConesAllow) {
  int free_count = 0, blocked_count = 0;
  for (const int offset : {0, 40}) {
    Params params;
    params.rangefinders.offset = millimetres(offset);
    StepProbe probe;
    probe.configure(params);
    for (int step = 20; step <= 400; step += 38) {
      for (int d = 30; d <= 700; d += 9) {
        for (int beam = 0; beam < hal::kBeams; ++beam) {
          Echoes look;
          for (Echo& e : look.beam) e = {2_m, Validity::clear};
          look.beam[beam] = {millimetres(d), Validity::ok};
          const double axis = (1 - beam) * kPi / 6;
          const double gap = nearest(axis, kPi * 12.5 / 180, offset * 1e-3, d * 1e-3, step * 1e-3);
          if (std::fabs(gap - 0.12) < 1e-5) continue;
          const bool expected = gap > 0.12;
          ASSERT_EQ(probe.free(look, millimetres(step)), expected)
              << "beam " << beam << " d " << d << " step " << step;
          ++(expected ? free_count : blocked_count);
        }
      }
    }
  }
  std::printf("probe: %d free and %d blocked cases\n", free_count, blocked_count);
  EXPECT_GT(free_count, 1000);
  EXPECT_GT(blocked_count, 1000);
}

void expect_gap(Vec point, Length gap) {
  EXPECT_FALSE(near_way(point, 100_mm, gap));
  EXPECT_TRUE(near_way(point, 100_mm, gap + micrometres(1)));
}

TEST(Way, IsAsFarAsItsNearestPoint) {
  expect_gap({-(30_mm), 40_mm}, 50_mm);
  expect_gap({0_mm, -(40_mm)}, 40_mm);
  expect_gap({100_mm, 40_mm}, 40_mm);
  expect_gap({130_mm, -(40_mm)}, 50_mm);
}

TEST(StepProbe, ABeamThatIsNotUsableBlocks) {
  StepProbe probe;
  probe.configure(Params{});
  for (const Validity v :
       {Validity::pending, Validity::invalid, Validity::stale, Validity::stuck, Validity::too_near}) {
    for (int beam = 0; beam < hal::kBeams; ++beam) {
      Echoes look;
      for (Echo& e : look.beam) e = {2_m, Validity::clear};
      EXPECT_TRUE(probe.free(look, 100_mm));
      look.beam[beam] = {Length{}, v};
      EXPECT_FALSE(probe.free(look, 100_mm)) << beam;
    }
  }
}

TEST(StepProbe, ASideConeThatCoversTheAxisCountsAsAhead) {
  Params params;
  params.rangefinders.side_angle = 10_deg;
  StepProbe probe;
  probe.configure(params);
  Echoes look;
  for (Echo& e : look.beam) e = {2_m, Validity::clear};
  look.beam[hal::kLeft] = {300_mm, Validity::ok};
  EXPECT_TRUE(probe.free(look, 180_mm));
  EXPECT_FALSE(probe.free(look, 181_mm));
}

}  // namespace
}  // namespace whisker::planning
