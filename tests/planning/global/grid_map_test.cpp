// The map's window and the marks of beams in it.
#include "firmware/planning/global/grid_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "firmware/planning/global/raytrace.hpp"
#include "tests/effort.hpp"
#include "tests/planning/global/room.hpp"

namespace whisker::planning {
namespace {

constexpr GridShape kShape{2, 57, 100_mm};
constexpr Vec kFrom{50_mm, 50_mm};  // the centre of a cell

perception::ConeObservation observation(Vec at, Angle axis, Length free, bool hit) {
  perception::ConeObservation p;
  p.beam = perception::beam_of(mount(Params{}.rangefinders, hal::kFront), {at, axis});
  p.free = free;
  p.hit = hit;
  return p;
}

TEST(GridMap, HoldsBodyAndGoalIfBothFit) {
  const Vec body{1_m, 2_m};
  const Vec goal{3_m, Length{} - 1_m};
  test::Room room(kShape, body, goal);
  EXPECT_TRUE(room.map.holds(room.map.place(body)));
  EXPECT_TRUE(room.map.holds(room.map.place(goal)));
}

TEST(GridMap, LeansTowardsAFarGoal) {
  test::Room room(kShape, {}, {20_m, Length{}});
  const Cell body = room.map.place({});
  EXPECT_GE(body.x, kShape.columns() / 6);
  EXPECT_LT(body.x, kShape.columns() / 3);
  EXPECT_NEAR(body.y, kShape.rows / 2, 1);
}

TEST(GridMap, APlaceIsTheOneWhoseMiddleItIs) {
  test::Room room(kShape, {5_m, Length{} - 3_m}, {});
  for (int y = 0; y < kShape.rows; ++y) {
    for (int x = 0; x < kShape.columns(); ++x)
      EXPECT_EQ(room.map.place(room.map.middle({x, y})), (Cell{x, y}));
  }
}

TEST(GridMap, KeepsWhatTheMovedWindowStillHolds) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> draw(-70, 70);
  for (std::size_t i = 0; i < test::effort(60); ++i) {
    test::Room room(kShape);
    room.scatter(random, 0.3);
    for (int y = 5; y < 9; ++y) room.map.set({40, y}, CellState::free);
    std::vector<CellState> before;
    const auto all = [&](auto&& each) {
      for (int y = 0; y < kShape.rows; ++y) {
        for (int x = 0; x < kShape.columns(); ++x) each(Cell{x, y});
      }
    };
    all([&](Cell p) { before.push_back(room.map.at(p)); });
    const Cell corner = room.map.corner();
    const Vec body = room.map.middle({draw(random), draw(random)});
    const bool moved = room.map.follow(body, body);
    const Cell step = room.map.corner() - corner;
    EXPECT_EQ(moved, step != Cell{});
    ASSERT_TRUE(room.map.holds(room.map.place(body)));
    all([&](Cell p) {
      const Cell old = p + step;
      const bool held = old.x >= 0 && old.y >= 0 && old.x < kShape.columns() && old.y < kShape.rows;
      const auto index = static_cast<std::size_t>(old.y * kShape.columns() + old.x);
      EXPECT_EQ(room.map.at(p), held ? before[index] : CellState::unknown);
    });
    if (testing::Test::HasFailure()) return;
  }
}

TEST(GridMap, StandsStillWhileTheBodyIsWellInside) {
  test::Room room(kShape);
  EXPECT_FALSE(room.map.follow({1_m, 1_m}, {2_m, 2_m}));
  EXPECT_TRUE(room.map.follow({3_m, Length{}}, {4_m, Length{}}));
}

TEST(GridMap, ABeamThatSeesNothingFreesTheCellsWithinIt) {
  test::Room room(kShape);
  room.map.mark(observation(kFrom, Angle{}, 2_m, false));
  EXPECT_EQ(room.map.at(room.map.place({1_m, Length{}})), CellState::free);
  EXPECT_EQ(room.map.at(room.map.place({1800_mm, 50_mm})), CellState::free);
  EXPECT_EQ(room.map.at(room.map.place({2100_mm, Length{}})), CellState::unknown);
  EXPECT_EQ(room.map.at(room.map.place({1_m, 500_mm})), CellState::unknown);
  EXPECT_EQ(room.map.at(room.map.place({Length{} - 1_m, Length{}})), CellState::unknown);
}

TEST(GridMap, ANearEchoIsSureAndAFarOneIsNot) {
  test::Room near(kShape);
  near.map.mark(observation(kFrom, Angle{}, 200_mm, true));
  EXPECT_EQ(near.map.at(near.map.place({250_mm, 50_mm})), CellState::occupied);
  test::Room far(kShape);
  far.map.mark(observation(kFrom, Angle{}, 900_mm, true));
  EXPECT_EQ(far.map.at(far.map.place({950_mm, 50_mm})), CellState::suspect);
  EXPECT_EQ(far.map.at(far.map.place({550_mm, 50_mm})), CellState::free);
}

TEST(GridMap, ABeamAlongAWallThatItMayLoseFreesNoneOfIt) {
  const auto after = [](Vec at, Angle axis, bool loses_walls) {
    test::Room room(kShape);
    for (int32_t x = 0; x < 1000; x += 100) {
      room.map.set(room.map.place({millimetres(x + 50), 250_mm}), CellState::occupied);
    }
    room.map.mark(observation(at, axis, 2_m, false), nullptr, loses_walls);
    return room.map.at(room.map.place({550_mm, 250_mm}));
  };
  EXPECT_EQ(after(kFrom, 20_deg, true), CellState::occupied);
  EXPECT_EQ(after(kFrom, 20_deg, false), CellState::free);
  EXPECT_EQ(after({550_mm, -(450_mm)}, 90_deg, true), CellState::free) << "it would see this wall";
}

TEST(GridMap, AnEchoThatFreeCellsAloneExplainTakesThemBack) {
  const auto after = [](CellState beside, bool doubts) {
    test::Room room(kShape);
    for (const Angle axis : {-(20_deg), 0_deg, 20_deg}) {
      room.map.mark(observation(kFrom, axis, 2_m, false));
    }
    room.map.set(room.map.place({950_mm, 150_mm}), beside);
    room.map.mark(observation(kFrom, Angle{}, 900_mm, true), nullptr, doubts);
    return room.map.at(room.map.place({950_mm, 50_mm}));
  };
  EXPECT_EQ(after(CellState::free, true), CellState::suspect);
  EXPECT_EQ(after(CellState::free, false), CellState::free);
  EXPECT_EQ(after(CellState::suspect, true), CellState::free) << "that cell explains the echo";
}

TEST(GridMap, WhatThePatchShowsIsFreeAsFarAsItShowsIt) {
  test::Room room(kShape);
  perception::LocalGrid local_grid;
  local_grid.configure(room.params);
  local_grid.reset({kFrom, {}});
  const auto cell = [&](int32_t x_mm) { return room.map.place({millimetres(x_mm), 50_mm}); };
  const auto copy = [&](Vec body) {
    const int32_t reach = room.map.reach_of(local_grid);
    for (int32_t row = -reach; row <= reach; ++row) room.map.free(local_grid, body, row);
  };
  for (const int32_t x : {50, 150, 250, 350}) room.map.set(cell(x), CellState::occupied);
  copy(kFrom);
  EXPECT_EQ(room.map.at(cell(50)), CellState::free);
  EXPECT_EQ(room.map.at(cell(150)), CellState::occupied);
  // The body drives on: its footprints together clear cells that none of them clears alone.
  for (int32_t x = 50; x <= 200; x += 10) local_grid.move_to({{millimetres(x), 50_mm}, {}});
  copy({200_mm, 50_mm});
  EXPECT_EQ(room.map.at(cell(150)), CellState::free);
  EXPECT_EQ(room.map.at(cell(250)), CellState::occupied);
  EXPECT_EQ(room.map.at(cell(350)), CellState::occupied);
}

TEST(GridMap, WhatIsSeenEmptyIsFreeWhateverItWas) {
  test::Room room(kShape);
  const Cell p = room.map.place({1_m, Length{}});
  room.map.set(p, CellState::occupied);
  room.map.mark(observation({}, Angle{}, 2_m, false));
  EXPECT_EQ(room.map.at(p), CellState::free);
}

TEST(GridMap, WhatAPlanHasComeToStaysBlockedUntilItIsMade) {
  for (const GridShape& shape : {kShape, GridShape{6, 57, 80_mm}}) {
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        test::Room room(shape);
        const Cell p = room.map.place({1_m, Length{}});
        room.map.set(p, CellState::occupied);
        const Cell level = p + Cell{dx, dy};
        GridWord* const plane = dx == dy ? room.map.level_low() : room.map.level_high();
        plane[level.y * shape.words + level.x / kWordBits] = GridWord{1} << (level.x % kWordBits);
        const GridMap::Hold hold{{-1, -1}, {-1, -1}, true};
        room.map.mark(observation({}, Angle{}, 2_m, false), &hold);
        const bool beside = std::abs(dx) <= 1 && std::abs(dy) <= 1;
        EXPECT_EQ(room.map.at(p), beside ? CellState::occupied : CellState::free) << dx << ", " << dy;
        room.map.release(hold);
        EXPECT_EQ(room.map.at(p), CellState::free) << dx << ", " << dy;
      }
    }
  }
}

TEST(GridMap, AnEchoDoesNotTakeBackWhatWasSeenEmpty) {
  test::Room room(kShape);
  room.map.mark(observation({}, Angle{}, 2_m, false));
  room.map.mark(observation({}, Angle{}, 700_mm, true));
  const Cell p = room.map.place({700_mm, 10_mm});
  EXPECT_EQ(room.map.at(p), CellState::free);
}

TEST(GridMap, DoubtsWhatBlocksAndKeepsWhatIsFree) {
  test::Room room(kShape);
  room.map.set({3, 4}, CellState::occupied);
  room.map.set({4, 4}, CellState::suspect);
  room.map.set({5, 4}, CellState::free);
  room.map.doubt_all();
  EXPECT_EQ(room.map.at({3, 4}), CellState::unknown);
  EXPECT_EQ(room.map.at({4, 4}), CellState::unknown);
  EXPECT_EQ(room.map.at({5, 4}), CellState::free);
}

TEST(GridMap, MarksNothingFromOutsideItsWindow) {
  test::Room room(kShape);
  const std::vector<GridWord> before = room.storage;
  room.map.mark(observation({50_m, 50_m}, Angle{}, 2_m, true));
  EXPECT_EQ(room.storage, before);
}

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
