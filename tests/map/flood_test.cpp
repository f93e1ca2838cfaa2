// The flood by whole rows against one that goes cell by cell, in random maps.
#include "firmware/map/flood.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "tests/effort.hpp"
#include "tests/map/room.hpp"

namespace whisker::map {
namespace {

constexpr int kNever = -1;
constexpr int32_t kWhole = INT32_MAX;

/// Levels cell by cell, as far as the way inside the window and over the border that faces the goal leads.
class Oracle {
 public:
  Oracle(const Map& map, const Flood::Task& task)
      : map_(map),
        task_(task),
        levels_(static_cast<std::size_t>(map.shape().columns() * map.shape().rows), kNever) {
    if (map.holds(task.goal)) level(task.goal) = 0;
    int idle = 0;
    for (int l = 1; idle < 400; ++l) idle = pass(l) ? 0 : idle + 1;
  }
  int at(Place p) const { return levels_[index(p)]; }

 private:
  std::size_t index(Place p) const { return static_cast<std::size_t>(p.y * map_.shape().columns() + p.x); }
  int& level(Place p) { return levels_[index(p)]; }
  bool open(Place p) const {
    if (!map_.holds(p)) return false;
    const State s = map_.at(p);
    if (p == task_.body) return true;
    return s != State::occupied && !(task_.strict && (s == State::suspect || test::cramped(map_, p)));
  }
  bool enters(Place p, int l) const {
    const Place g = task_.goal;
    const Place last{map_.shape().columns() - 1, map_.shape().rows - 1};
    const int dx = std::abs(p.x - g.x);
    const int dy = std::abs(p.y - g.y);
    if (map_.holds(g) || std::max(dx, dy) > l || dx + dy > l + l / 2) return false;
    return (p.x == 0 && g.x < 0) || (p.y == 0 && g.y < 0) || (p.x == last.x && g.x > last.x) ||
           (p.y == last.y && g.y > last.y);
  }
  bool follows(Place p, int l) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Place q = p + Place{dx, dy};
        if (q == p || !open(q) || at(q) != l - 1) continue;
        if (dx == 0 || dy == 0) return true;
        if (l % 2 == 0 && open(p + Place{dx, 0}) && open(p + Place{0, dy})) return true;
      }
    }
    return false;
  }
  bool pass(int l) {
    std::vector<Place> news;
    for (int y = 0; y < map_.shape().rows; ++y) {
      for (int x = 0; x < map_.shape().columns(); ++x) {
        const Place p{x, y};
        if (at(p) == kNever && open(p) && (enters(p, l) || follows(p, l))) news.push_back(p);
      }
    }
    for (const Place p : news) level(p) = l;
    return !news.empty();
  }

  const Map& map_;
  Flood::Task task_;
  std::vector<int> levels_;
};

/// A map, and a way to be found in it.
struct Case {
  explicit Case(unsigned seed) : random(seed), room(shape(seed)) {
    room.scatter(random, std::uniform_real_distribution<double>(0, 0.45)(random));
    const int columns = room.map.shape().columns();
    const int rows = room.map.shape().rows;
    const auto draw = [&](int low, int high) {
      return std::uniform_int_distribution<int>(low, high)(random);
    };
    task.body = {draw(0, columns - 1), draw(0, rows - 1)};
    task.goal = seed % 2 == 0 ? Place{draw(0, columns - 1), draw(0, rows - 1)}
                              : Place{draw(-90, columns + 90), draw(-90, rows + 90)};
    task.strict = draw(0, 1) == 1;
  }
  static Shape shape(unsigned seed) {
    constexpr Shape kShapes[] = {
        {1, 50, 100_mm}, {2, 57, 100_mm}, {3, 33, 100_mm}, {2, 64, 50_mm}, {3, 37, micrometres(66700)}};
    return kShapes[seed % 5];
  }
  std::mt19937 random;
  test::Room room;
  Flood::Task task;
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

TEST(Flood, HasTheLevelsOfOneCellByCell) {
  int reached = 0;
  each_case([&](Case& c) {
    const Oracle oracle(c.room.map, c.task);
    const int body = oracle.at(c.task.body);
    if (body == kNever) return;
    ++reached;
    Flood flood;
    flood.begin(c.room.map, c.task);
    ASSERT_TRUE(flood.run(c.room.map, kWhole));
    ASSERT_EQ(flood.level(), body);
    for (int y = 0; y < c.room.map.shape().rows; ++y) {
      for (int x = 0; x < c.room.map.shape().columns(); ++x) {
        const Place p{x, y};
        const int level = oracle.at(p);
        const bool due = level != kNever && level <= flood.levels();
        ASSERT_EQ(flood.phase(c.room.map, p), due ? level % 3 : kNever) << x << ", " << y;
      }
    }
  });
  EXPECT_GT(reached, static_cast<int>(test::effort(30)));
}

TEST(Flood, DescendsByOneLevelAStep) {
  int steps = 0;
  each_case([&](Case& c) {
    const Oracle oracle(c.room.map, c.task);
    if (oracle.at(c.task.body) == kNever) return;
    Flood flood;
    flood.begin(c.room.map, c.task);
    flood.run(c.room.map, kWhole);
    Place p = c.task.body;
    Place on;
    while (flood.next(c.room.map, p, c.task.goal, on)) {
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

TEST(Flood, SpreadOverTicksIsTheWhole) {
  each_case([](Case& c) {
    Flood flood;
    flood.begin(c.room.map, c.task);
    flood.run(c.room.map, kWhole);
    const int32_t level = flood.level();
    const std::vector<Word> whole = c.room.storage;
    Flood parts;
    parts.begin(c.room.map, c.task);
    std::uniform_int_distribution<int32_t> draw(1, 300);
    int ticks = 1;
    for (; !parts.run(c.room.map, draw(c.random)); ++ticks) ASSERT_LT(ticks, 200000);
    EXPECT_EQ(parts.level(), level);
    EXPECT_EQ(c.room.storage, whole);
  });
}

TEST(Flood, IsTheWholeOneOfTheMapThatItEndsWithWhereCellsOpenMeanwhile) {
  int opened = 0;
  each_case(
      [&](Case& c) {
        Map& map = c.room.map;
        const auto blocked = [&map] {
          int n = 0;
          for (int i = 0; i < map.shape().size(); ++i) n += __builtin_popcount(map.blocking()[i]);
          return n;
        };
        Flood parts;
        parts.begin(map, c.task);
        const int at_first = blocked();
        std::uniform_int_distribution<int32_t> words(1, 300);
        std::uniform_int_distribution<int32_t> column(0, map.shape().columns() - 1);
        std::uniform_int_distribution<int32_t> row(0, map.shape().rows - 1);
        std::uniform_int_distribution<uint32_t> heading;
        while (!parts.run(map, words(c.random))) {
          ground::Proof clear;
          clear.from.at = map.middle({column(c.random), row(c.random)});
          clear.from.heading = Angle::from_raw(heading(c.random));
          clear.free = 2_m;
          map.mark(clear, true);
        }
        opened += at_first - blocked();
        const int32_t level = parts.level();
        const std::vector<Word> in_parts = c.room.storage;
        Flood whole;
        whole.begin(map, c.task);
        whole.run(map, kWhole);
        EXPECT_EQ(level, whole.level());
        EXPECT_EQ(in_parts, c.room.storage);
      },
      1000);
  EXPECT_GT(opened, 1000);
}

TEST(Flood, GoesAroundOutsideTheWindowAtAPrice) {
  test::Room room({2, 57, 100_mm});
  for (int y = 0; y < 57; ++y) room.map.set({30, y}, State::occupied);
  Flood::Task task;
  task.body = {20, 28};
  task.goal = {40, 28};
  Flood flood;
  flood.begin(room.map, task);
  ASSERT_TRUE(flood.run(room.map, kWhole));
  ASSERT_TRUE(flood.reached());
  EXPECT_GT(flood.level(), 40 + 20);
  Place p = task.body;
  while (flood.next(room.map, p, task.goal, p)) {
  }
  EXPECT_TRUE(p.x == 0 || p.y == 0 || p.y == 56);
}

TEST(Flood, SaysThatThereIsNoWay) {
  test::Room room({2, 57, 100_mm});
  for (int i = -3; i <= 3; ++i) {
    for (const Place p : {Place{i, -3}, Place{i, 3}, Place{-3, i}, Place{3, i}}) {
      room.map.set(Place{30, 30} + p, State::occupied);
    }
  }
  for (const bool within : {true, false}) {
    Flood::Task task;
    task.body = within ? Place{30, 30} : Place{10, 10};
    task.goal = within ? Place{10, 10} : Place{30, 30};
    Flood flood;
    flood.begin(room.map, task);
    ASSERT_TRUE(flood.run(room.map, kWhole));
    EXPECT_FALSE(flood.reached());
  }
}

TEST(Flood, BlocksAtSuspectsOnlyIfAsked) {
  test::Room room({2, 57, 100_mm});
  for (int y = 0; y < 57; ++y) room.map.set({30, y}, State::suspect);
  Flood::Task task;
  task.body = {20, 28};
  task.goal = {40, 28};
  Flood flood;
  flood.begin(room.map, task);
  flood.run(room.map, kWhole);
  EXPECT_EQ(flood.level(), 20);
  task.strict = true;
  flood.begin(room.map, task);
  flood.run(room.map, kWhole);
  EXPECT_GT(flood.level(), 40);
}

TEST(Flood, TakesAtMostSoManyWordsATickAndOneRowMore) {
  // Of a word's work, all that can be seen from outside is how many ticks a flood takes: at least its rows.
  test::Room room({2, 57, 100_mm});
  Flood::Task task;
  task.body = {2, 2};
  task.goal = {60, 50};
  Flood flood;
  flood.begin(room.map, task);
  int ticks = 1;
  while (!flood.run(room.map, 100)) ++ticks;
  EXPECT_GT(ticks, flood.levels() * 2 / 100);
  EXPECT_LT(ticks, flood.levels() * 57 * 2 / 100 + 1);
}

}  // namespace
}  // namespace whisker::map
