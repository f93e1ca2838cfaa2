#include "firmware/perception/lane.hpp"

#include <gtest/gtest.h>

namespace whisker::perception {
namespace {

constexpr Length kRadius = 90_mm;

/// A lane along heading 0 from the origin, 96 mm wide on each side of its middle, with clear ground up to
/// here.
Lane clear_to(Length end) {
  Lane lane;
  lane.configure(96_mm, 90_mm);
  lane.open({});
  for (Length x = 0_mm; x < end - 150_mm; x = x + 5_mm) lane.mark_around({x, 0_mm}, 150_mm);
  return lane;
}

TEST(Lane, HoldsAStepOnItsMiddle) {
  const Lane lane = clear_to(380_mm);
  EXPECT_TRUE(lane.holds({150_mm, 0_mm}, {10_mm, 0_mm}, kRadius));
  EXPECT_TRUE(lane.holds({150_mm, 0_mm}, {-10_mm, 0_mm}, kRadius)) << "and the way back";
}

TEST(Lane, HoldsNoBodyThatReachesBeyondItsEdge) {
  const Lane lane = clear_to(380_mm);
  EXPECT_FALSE(lane.holds({150_mm, 10_mm}, {10_mm, 0_mm}, kRadius));
  EXPECT_FALSE(lane.holds({150_mm, -(10_mm)}, {10_mm, 0_mm}, kRadius));
}

TEST(Lane, HoldsNoStepOntoGroundThatIsNotClear) {
  const Lane lane = clear_to(250_mm);
  EXPECT_TRUE(lane.holds({100_mm, 0_mm}, {10_mm, 0_mm}, kRadius));
  EXPECT_FALSE(lane.holds({170_mm, 0_mm}, {10_mm, 0_mm}, kRadius));
}

TEST(Lane, HoldsNoStepBeyondItsEnd) {
  const Lane lane = clear_to(500_mm);
  EXPECT_FALSE(lane.holds({300_mm, 0_mm}, {10_mm, 0_mm}, kRadius));
}

/// An echo 200 mm ahead in a cone of 10 degrees: the cells before it and beside it stay clear.
TEST(Lane, AnEchoTakesBackTheCellsThatItMayComeFrom) {
  Lane lane = clear_to(380_mm);
  lane.take_back({{0_mm, 0_mm}, Angle{}, 5_deg}, 200_mm, 200_mm);
  EXPECT_FALSE(lane.is_clear({205_mm, 0_mm}));
  EXPECT_TRUE(lane.is_clear({180_mm, 0_mm}));
  EXPECT_TRUE(lane.is_clear({230_mm, 0_mm}));
  EXPECT_TRUE(lane.is_clear({205_mm, 50_mm}));
  lane.take_back({{200_mm, -(300_mm)}, 90_deg, 5_deg}, 100_mm, 100_mm);
  EXPECT_TRUE(lane.is_clear({200_mm, -(90_mm)})) << "an echo from beside the lane takes nothing of it";
}

TEST(Lane, ForgetsGroundAfterTwoSpans) {
  Lane lane = clear_to(380_mm);
  lane.age();
  EXPECT_TRUE(lane.is_clear({150_mm, 0_mm}));
  lane.age();
  EXPECT_FALSE(lane.is_clear({150_mm, 0_mm}));
  EXPECT_FALSE(lane.holds({150_mm, 0_mm}, {10_mm, 0_mm}, kRadius));
}

}  // namespace
}  // namespace whisker::perception
