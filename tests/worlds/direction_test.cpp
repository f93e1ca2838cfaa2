#include "host/worlds/direction.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace whisker::worlds {
namespace {

TEST(Direction, AgreesWithTheLibraryAllAround) {
  const double pi = std::acos(-1);
  for (int i = -7200; i <= 7200; ++i) {
    const double degrees = i / 10.0;
    const sim::Vec2 v = direction(degrees);
    EXPECT_NEAR(v.x, std::cos(degrees / 180 * pi), 3e-15) << degrees;
    EXPECT_NEAR(v.y, std::sin(degrees / 180 * pi), 3e-15) << degrees;
    EXPECT_NEAR(v.x * v.x + v.y * v.y, 1, 1e-15) << degrees;
  }
}

TEST(Direction, IsExactOnTheAxes) {
  for (int turn = -2; turn <= 2; ++turn) {
    EXPECT_EQ(direction(360 * turn).x, 1);
    EXPECT_EQ(direction(360 * turn + 90).y, 1);
    EXPECT_EQ(direction(360 * turn + 180).x, -1);
    EXPECT_EQ(direction(360 * turn + 270).y, -1);
  }
}

}  // namespace
}  // namespace whisker::worlds
