#include "firmware/planning/global/raytrace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/effort.hpp"
#include "tests/planning/global/room.hpp"

namespace whisker::planning {
namespace {

TEST(RecentReadings, GoesFromCellToCellAndStaysOnTheLine) {
  test::Room room({2, 57, 100_mm});
  std::mt19937 random(7);
  std::uniform_int_distribution<int32_t> draw(-2400000, 2400000);
  for (std::size_t i = 0; i < test::effort(2000); ++i) {
    const Vec from{Length::from_raw(draw(random)), Length::from_raw(draw(random))};
    const Vec to{Length::from_raw(draw(random)), Length::from_raw(draw(random))};
    Cell last = room.map.place(from);
    const double length = std::hypot((to - from).x.raw(), (to - from).y.raw());
    ASSERT_TRUE(raytrace(room.map, from, to, [&](Cell p) {
      const Cell step = p - last;
      EXPECT_EQ(std::abs(step.x) + std::abs(step.y), 1);
      last = p;
      const Vec m = room.map.middle(p) - from;
      const Vec d = to - from;
      const double off = std::fabs(double(d.x.raw()) * m.y.raw() - double(d.y.raw()) * m.x.raw()) / length;
      EXPECT_LE(off, 100000 * std::sqrt(0.5) + 1);
      return true;
    }));
    EXPECT_EQ(last, room.map.place(to));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(RecentReadings, StopsWhereItIsTold) {
  test::Room room({2, 57, 100_mm});
  int cells = 0;
  EXPECT_FALSE(raytrace(room.map, {}, {2_m, Length{}}, [&](Cell) { return ++cells < 5; }));
  EXPECT_EQ(cells, 5);
}

}  // namespace
}  // namespace whisker::planning
