#include "host/lab/baselines/deflection_laws.hpp"

#include <gtest/gtest.h>

namespace whisker::baselines {
namespace {

planning::View seen(int left_mm, int front_mm, int right_mm) {
  planning::View view;
  const int mm[] = {left_mm, front_mm, right_mm};
  for (int i = 0; i < hal::kBeams; ++i)
    view.moving_scan.beam[i] = {millimetres(mm[i]), perception::Validity::ok};
  return view;
}

double degrees(int left_mm, int front_mm, int right_mm) {
  RepulsionDeflection law;
  planning::Decision decision;
  return law.deflect(seen(left_mm, front_mm, right_mm), Angle{}, Params{}, decision).wrapped() *
         (360 / 4294967296.0);
}

TEST(RepulsionDeflection, IsStraightWhereNothingIsNear) { EXPECT_EQ(degrees(2000, 2000, 2000), 0); }

TEST(RepulsionDeflection, TurnsAwayFromTheNearerSideAndTheMoreTheNearer) {
  EXPECT_GT(degrees(2000, 2000, 400), 0);
  EXPECT_GT(degrees(2000, 2000, 200), degrees(2000, 2000, 400));
  EXPECT_LT(degrees(400, 2000, 2000), 0);
}

TEST(RepulsionDeflection, IsTheMirrorOfItself) {
  for (int left = 100; left <= 2000; left += 190) {
    for (int right = left + 50; right <= 2000; right += 230) {
      for (int front = 100; front <= 2000; front += 475) {
        EXPECT_NEAR(degrees(left, front, right), -degrees(right, front, left), 1e-6);
      }
    }
  }
}

TEST(RepulsionDeflection, PassesWhatIsAheadOnTheWiderSideAndIsBounded) {
  EXPECT_GT(degrees(1500, 300, 1200), 0);
  EXPECT_LT(degrees(1200, 300, 1500), 0);
  EXPECT_NEAR(degrees(2000, 0, 0), 45, 1e-6);
}

TEST(NoDeflection, NeverBends) {
  NoDeflection law;
  planning::Decision decision;
  EXPECT_EQ(law.deflect(seen(100, 100, 300), Angle{}, Params{}, decision), Angle{});
}

}  // namespace
}  // namespace whisker::baselines
