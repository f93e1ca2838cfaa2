// Compares the wavefront by whole rows with one by single cells, in random maps.
#include "firmware/planning/global/wavefront.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "tests/effort.hpp"
#include "tests/planning/global/room.hpp"

namespace whisker::planning {
namespace {

constexpr int kNever = -1;
constexpr int32_t kWhole = INT32_MAX;

/// Computes levels cell by cell, inside the window and across the border that faces the goal.
class Oracle {
 public:
  Oracle(const GridMap& map, const Wavefront::Task& task)
      : map_(map),
        task_(task),
        levels_(static_cast<std::size_t>(map.shape().columns() * map.shape().rows), kNever) {
    if (map.holds(task.goal)) level(task.goal) = 0;
    int idle = 0;
    for (int l = 1; idle < 400; ++l) idle = pass(l) ? 0 : idle + 1;
  }
  int at(Cell p) const { return levels_[index(p)]; }

 private:
  std::size_t index(Cell p) const { return static_cast<std::size_t>(p.y * map_.shape().columns() + p.x); }
  int& level(Cell p) { return levels_[index(p)]; }
  bool open(Cell p) const {
    if (!map_.holds(p)) return false;
    const CellState s = map_.at(p);
    if (p == task_.body) return true;
    return s != CellState::occupied && !(task_.strict && s == CellState::suspect);
  }
  bool enters(Cell p, int l) const {
    const Cell g = task_.goal;
    const Cell last{map_.shape().columns() - 1, map_.shape().rows - 1};
    const int dx = std::abs(p.x - g.x);
    const int dy = std::abs(p.y - g.y);
    if (map_.holds(g) || std::max(dx, dy) > l || dx + dy > l + l / 2) return false;
    return (p.x == 0 && g.x < 0) || (p.y == 0 && g.y < 0) || (p.x == last.x && g.x > last.x) ||
           (p.y == last.y && g.y > last.y);
  }
  bool follows(Cell p, int l) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell q = p + Cell{dx, dy};
        if (q == p || !open(q) || at(q) != l - 1) continue;
        if (dx == 0 || dy == 0) return true;
        if (l % 2 == 0 && open(p + Cell{dx, 0}) && open(p + Cell{0, dy})) return true;
      }
    }
    return false;
  }
  bool pass(int l) {
    std::vector<Cell> news;
    for (int y = 0; y < map_.shape().rows; ++y) {
      for (int x = 0; x < map_.shape().columns(); ++x) {
        const Cell p{x, y};
        if (at(p) == kNever && open(p) && (enters(p, l) || follows(p, l))) news.push_back(p);
      }
    }
    for (const Cell p : news) level(p) = l;
    return !news.empty();
  }

  const GridMap& map_;
  Wavefront::Task task_;
  std::vector<int> levels_;
};

/// A map, and a task in it.
struct Case {
  explicit Case(unsigned seed) : random(seed), room(shape(seed)) {
    room.scatter(random, std::uniform_real_distribution<double>(0, 0.45)(random));
    const int columns = room.map.shape().columns();
    const int rows = room.map.shape().rows;
    const auto draw = [&](int low, int high) {
      return std::uniform_int_distribution<int>(low, high)(random);
    };
    task.body = {draw(0, columns - 1), draw(0, rows - 1)};
    task.goal = seed % 2 == 0 ? Cell{draw(0, columns - 1), draw(0, rows - 1)}
                              : Cell{draw(-90, columns + 90), draw(-90, rows + 90)};
    task.strict = draw(0, 1) == 1;
  }
  static GridShape shape(unsigned seed) {
    constexpr GridShape kShapes[] = {
        {1, 50, 100_mm}, {2, 57, 100_mm}, {3, 33, 100_mm}, {2, 64, 80_mm}, {3, 37, 125_mm}};
    return kShapes[seed % 5];
  }
  std::mt19937 random;
  test::Room room;
  Wavefront::Task task;
};

template <class Each>
void each_case(const Each& each, std::uint64_t count = 60) {
  for (unsigned seed = 1; seed <= test::effort(count); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case c(seed);
    each(c);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Wavefront, HasTheLevelsOfOneCellByCell) {
  int reached = 0;
  each_case([&](Case& c) {
    const Oracle oracle(c.room.map, c.task);
    const int body = oracle.at(c.task.body);
    if (body == kNever) return;
    ++reached;
    Wavefront wavefront;
    wavefront.begin(c.room.map, c.task);
    ASSERT_TRUE(wavefront.run(c.room.map, kWhole));
    ASSERT_EQ(wavefront.level(), body);
    for (int y = 0; y < c.room.map.shape().rows; ++y) {
      for (int x = 0; x < c.room.map.shape().columns(); ++x) {
        const Cell p{x, y};
        const int level = oracle.at(p);
        const bool due = level != kNever && level <= wavefront.levels();
        ASSERT_EQ(wavefront.phase(c.room.map, p), due ? level % 3 : kNever) << x << ", " << y;
      }
    }
  });
  EXPECT_GT(reached, static_cast<int>(test::effort(30)));
}

TEST(Wavefront, DescendsByOneLevelAStep) {
  int steps = 0;
  each_case([&](Case& c) {
    const Oracle oracle(c.room.map, c.task);
    if (oracle.at(c.task.body) == kNever) return;
    Wavefront wavefront;
    wavefront.begin(c.room.map, c.task);
    wavefront.run(c.room.map, kWhole);
    Cell p = c.task.body;
    Cell on;
    while (wavefront.next(c.room.map, p, c.task.goal, on)) {
      ASSERT_EQ(oracle.at(on), oracle.at(p) - 1);
      p = on;
      ++steps;
    }
    if (c.room.map.holds(c.task.goal)) {
      EXPECT_EQ(p, c.task.goal);
    } else {
      EXPECT_TRUE(p.x == 0 || p.y == 0 || p.x == c.room.map.shape().columns() - 1 ||
                  p.y == c.room.map.shape().rows - 1);
    }
  });
  EXPECT_GT(steps, static_cast<int>(test::effort(500)));
}

TEST(Wavefront, SpreadOverTicksIsTheWhole) {
  each_case([](Case& c) {
    Wavefront wavefront;
    wavefront.begin(c.room.map, c.task);
    wavefront.run(c.room.map, kWhole);
    const int32_t level = wavefront.level();
    const std::vector<GridWord> whole = c.room.storage;
    Wavefront parts;
    parts.begin(c.room.map, c.task);
    std::uniform_int_distribution<int32_t> draw(1, 300);
    int ticks = 1;
    for (; !parts.run(c.room.map, draw(c.random)); ++ticks) ASSERT_LT(ticks, 200000);
    EXPECT_EQ(parts.level(), level);
    EXPECT_EQ(c.room.storage, whole);
  });
}

TEST(Wavefront, IsTheWholeOneOfTheMapThatItEndsWithWhereCellsOpenMeanwhile) {
  int opened = 0;
  int noted = 0;
  each_case(
      [&](Case& c) {
        GridMap& map = c.room.map;
        const auto blocked = [&map] {
          int n = 0;
          for (int i = 0; i < map.shape().size(); ++i) n += __builtin_popcount(map.blocking()[i]);
          return n;
        };
        Wavefront parts;
        parts.begin(map, c.task);
        const int at_first = blocked();
        std::uniform_int_distribution<int32_t> words(1, 300);
        std::uniform_int_distribution<int32_t> column(0, map.shape().columns() - 1);
        std::uniform_int_distribution<int32_t> row(0, map.shape().rows - 1);
        std::uniform_int_distribution<uint32_t> heading;
        while (!parts.run(map, words(c.random))) {
          perception::ConeObservation clear;
          clear.beam.apex = map.middle({column(c.random), row(c.random)});
          clear.beam.axis = Angle::from_raw(heading(c.random));
          clear.beam.half_cone = Angle::from_raw(Params{}.rangefinders.cone.raw() / 2);
          clear.free = 2_m;
          const GridMap::Hold hold = parts.hold();
          map.mark(clear, &hold);
        }
        opened += at_first - blocked();
        const int32_t level = parts.level();
        const std::vector<GridWord> at_end = c.room.storage;
        map.release(parts.hold());
        std::vector<GridWord> in_parts = c.room.storage;
        noted += at_end != in_parts;
        // The cells that open at the end blocked until then.
        const auto planes = [&](const std::vector<GridWord>& from) {
          std::copy_n(from.begin(), 2 * map.shape().size(), in_parts.begin());
        };
        planes(at_end);
        c.room.storage = in_parts;
        Wavefront whole;
        whole.begin(map, c.task);
        whole.run(map, kWhole);
        EXPECT_EQ(level, whole.level());
        EXPECT_EQ(in_parts, c.room.storage);
      },
      1000);
  EXPECT_GT(opened, 1000);
  EXPECT_GT(noted, 100);
}

TEST(Wavefront, GoesAroundOutsideTheWindowAtAPrice) {
  test::Room room({2, 57, 100_mm});
  for (int y = 0; y < 57; ++y) room.map.set({30, y}, CellState::occupied);
  Wavefront::Task task;
  task.body = {20, 28};
  task.goal = {40, 28};
  Wavefront wavefront;
  wavefront.begin(room.map, task);
  ASSERT_TRUE(wavefront.run(room.map, kWhole));
  ASSERT_TRUE(wavefront.reached());
  EXPECT_GT(wavefront.level(), 40 + 20);
  EXPECT_TRUE(wavefront.outside());
  room.map.set({30, 5}, CellState::free);
  Wavefront inside;
  inside.begin(room.map, task);
  ASSERT_TRUE(inside.run(room.map, kWhole));
  EXPECT_TRUE(inside.reached());
  EXPECT_FALSE(inside.outside()) << "a gap within the window";
  room.map.set({30, 5}, CellState::occupied);
  wavefront.begin(room.map, task);
  ASSERT_TRUE(wavefront.run(room.map, kWhole));
  Cell p = task.body;
  while (wavefront.next(room.map, p, task.goal, p)) {
  }
  EXPECT_TRUE(p.x == 0 || p.y == 0 || p.y == 56);
}

TEST(Wavefront, GoesAroundOutsideToABlockedGoalAtTheRim) {
  for (const Cell goal : {Cell{63, 28}, Cell{0, 28}, Cell{40, 0}, Cell{40, 56}, Cell{63, 0}}) {
    SCOPED_TRACE(testing::Message() << goal.x << ", " << goal.y);
    test::Room room({2, 57, 100_mm});
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        if (room.map.holds(goal + Cell{x, y})) room.map.set(goal + Cell{x, y}, CellState::occupied);
      }
    }
    Wavefront::Task task;
    task.body = {20, 28};
    task.goal = goal;
    Wavefront wavefront;
    wavefront.begin(room.map, task);
    ASSERT_TRUE(wavefront.run(room.map, kWhole));
    EXPECT_TRUE(wavefront.reached() && wavefront.outside());
  }
}

TEST(Wavefront, SaysThatThereIsNoWay) {
  test::Room room({2, 57, 100_mm});
  for (int i = -3; i <= 3; ++i) {
    for (const Cell p : {Cell{i, -3}, Cell{i, 3}, Cell{-3, i}, Cell{3, i}}) {
      room.map.set(Cell{30, 30} + p, CellState::occupied);
    }
  }
  for (const bool within : {true, false}) {
    Wavefront::Task task;
    task.body = within ? Cell{30, 30} : Cell{10, 10};
    task.goal = within ? Cell{10, 10} : Cell{30, 30};
    Wavefront wavefront;
    wavefront.begin(room.map, task);
    ASSERT_TRUE(wavefront.run(room.map, kWhole));
    EXPECT_FALSE(wavefront.reached());
  }
}

TEST(Wavefront, BlocksAtSuspectsOnlyIfAsked) {
  test::Room room({2, 57, 100_mm});
  for (int y = 0; y < 57; ++y) room.map.set({30, y}, CellState::suspect);
  Wavefront::Task task;
  task.body = {20, 28};
  task.goal = {40, 28};
  Wavefront wavefront;
  wavefront.begin(room.map, task);
  wavefront.run(room.map, kWhole);
  EXPECT_EQ(wavefront.level(), 20);
  task.strict = true;
  wavefront.begin(room.map, task);
  wavefront.run(room.map, kWhole);
  EXPECT_GT(wavefront.level(), 40);
}

TEST(Wavefront, TakesAtMostSoManyWordsATickAndOneRowMore) {
  // Only the number of ticks is observable. It must correspond to at least the words of the rows read.
  test::Room room({2, 57, 100_mm});
  Wavefront::Task task;
  task.body = {2, 2};
  task.goal = {60, 50};
  Wavefront wavefront;
  wavefront.begin(room.map, task);
  int ticks = 1;
  while (!wavefront.run(room.map, 100)) ++ticks;
  EXPECT_GT(ticks, wavefront.levels() * 2 / 100);
  EXPECT_LT(ticks, wavefront.levels() * 57 * 2 / 100 + 1);
}

}  // namespace
}  // namespace whisker::planning
