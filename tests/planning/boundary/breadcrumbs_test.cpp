#include "firmware/planning/boundary/breadcrumbs.hpp"

#include <gtest/gtest.h>

#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::in_degrees;

constexpr Length kApart = 40_mm;

TEST(Breadcrumbs, RemembersPlacesApart) {
  Breadcrumbs trail;
  trail.reset({}, kApart);
  int places = 0;
  for (int mm = 1; mm <= 410; ++mm) places += trail.add({millimetres(mm), 0_mm}) ? 1 : 0;
  EXPECT_EQ(places, 10);
  EXPECT_FALSE(trail.add({410_mm, 20_mm})) << "not far from the last one";
}

TEST(Breadcrumbs, LeadsBack) {
  Breadcrumbs trail;
  trail.reset({}, kApart);
  Pose pose{{}, 30_deg};
  for (int mm = 0; mm <= 1000; ++mm) {
    pose.at = polar(30_deg, millimetres(mm));
    trail.add(pose.at);
    if (mm < 300) continue;
    for (int n = 0; n < Breadcrumbs::kPlaces; ++n) {
      const Length back = norm(pose.at - trail.back(n));
      EXPECT_GE(back, kApart * n - 1_mm);
      EXPECT_LE(back, kApart * (n + 1) + 4_mm);
    }
    EXPECT_NEAR(in_degrees(trail.way_back(pose) - 210_deg), 0, 0.1);
  }
}

TEST(Breadcrumbs, LeadsBackRoundACorner) {
  Breadcrumbs trail;
  trail.reset({}, kApart);
  for (int mm = 0; mm <= 300; ++mm) trail.add({millimetres(mm), 0_mm});
  Pose pose{{300_mm, 0_mm}, 90_deg};
  for (int mm = 0; mm <= 60; ++mm) {
    pose.at.y = millimetres(mm);
    trail.add(pose.at);
  }
  const double back = in_degrees(trail.way_back(pose));
  EXPECT_LT(back, -100) << "towards where it was before the corner";
  EXPECT_GT(back, -180);
}

TEST(Breadcrumbs, OfABodyThatHasHardlyMovedLeadsStraightBehind) {
  Breadcrumbs trail;
  trail.reset({1_m, 1_m}, kApart);
  for (int deg = 0; deg < 360; deg += 30) {
    const Pose pose{{1_m + 30_mm, 1_m}, test::degrees(deg)};
    EXPECT_EQ(trail.way_back(pose), pose.heading + 180_deg);
  }
}

}  // namespace
}  // namespace whisker::planning
