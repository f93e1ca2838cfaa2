#include "host/scenario/bearing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whisker {
namespace {

TEST(Bearing, AgreesWithTheLibraryAllAround) {
  for (int i = -3600; i <= 3600; ++i) {
    const double angle = i * (3.14159265358979 / 3600);
    for (const double radius : {1e-4, 1.0, 11.3, 2800.0}) {
      const sim::Vec2 to{radius * std::cos(angle), radius * std::sin(angle)};
      EXPECT_NEAR(bearing({0, 0}, to), std::atan2(to.y, to.x), 1e-15) << i;
    }
  }
}

TEST(Bearing, IsExactOnTheAxes) {
  const double pi = std::acos(-1);
  EXPECT_EQ(bearing({1, 1}, {5, 1}), 0);
  EXPECT_EQ(bearing({1, 1}, {1, 5}), pi / 2);
  EXPECT_EQ(bearing({1, 1}, {-5, 1}), pi);
  EXPECT_EQ(bearing({1, 1}, {1, -5}), -pi / 2);
}

TEST(Bearing, OfNoWayAtAllIsZero) { EXPECT_EQ(bearing({2, 3}, {2, 3}), 0); }

}  // namespace
}  // namespace whisker
