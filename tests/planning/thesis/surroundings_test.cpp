#include "firmware/planning/thesis/surroundings.hpp"

#include <cstdint>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace whisker::planning
