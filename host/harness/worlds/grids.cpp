#include <array>
#include <numeric>
#include <utility>

#include "host/harness/worlds/draw.hpp"

namespace whisker::worlds {
namespace {

using sim::Vec2;

constexpr double kThick = 0.02;

/// The standing walls between the cells of a square grid.
class CellWalls {
 public:
  explicit CellWalls(int side) : side_(side), walls_(static_cast<std::size_t>(2 * side * side), true) {}
  int side() const { return side_; }
  /// The wall between cell (x, y) and its neighbour to the right, or above.
  std::vector<bool>::reference right_of(int x, int y) { return walls_[index(x, y, 0)]; }
  std::vector<bool>::reference above(int x, int y) { return walls_[index(x, y, 1)]; }
  std::vector<bool>::reference between(int x, int y, int dx, int dy) {
    if (dx != 0) return right_of(dx > 0 ? x : x - 1, y);
    return above(x, dy > 0 ? y : y - 1);
  }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < side_ && y < side_; }

 private:
  std::size_t index(int x, int y, int which) const {
    return static_cast<std::size_t>((y * side_ + x) * 2 + which);
  }
  int side_;
  std::vector<bool> walls_;
};

/// Opens the walls along a random depth-first walk through every cell.
void carve(CellWalls& walls, Random& random) {
  const int side = walls.side();
  std::vector<bool> seen(static_cast<std::size_t>(side * side), false);
  std::vector<std::pair<int, int>> way{{0, 0}};
  seen[0] = true;
  while (!way.empty()) {
    const auto [x, y] = way.back();
    std::array<std::pair<int, int>, 4> open{};
    int ways = 0;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      if (!walls.contains(x + dx, y + dy)) continue;
      if (seen[static_cast<std::size_t>((y + dy) * side + x + dx)]) continue;
      open[static_cast<std::size_t>(ways++)] = {dx, dy};
    }
    if (ways == 0) {
      way.pop_back();
      continue;
    }
    const auto [dx, dy] = open[static_cast<std::size_t>(random.index(ways))];
    walls.between(x, y, dx, dy) = false;
    seen[static_cast<std::size_t>((y + dy) * side + x + dx)] = true;
    way.emplace_back(x + dx, y + dy);
  }
}

void remove_some(CellWalls& walls, Random& random, double share) {
  for (int y = 0; y < walls.side(); ++y) {
    for (int x = 0; x < walls.side(); ++x) {
      if (walls.right_of(x, y) && random.chance(share)) walls.right_of(x, y) = false;
      if (walls.above(x, y) && random.chance(share)) walls.above(x, y) = false;
    }
  }
}

void add_bar(Scenario& s, Vec2 a, Vec2 b) {
  s.polygons.emplace_back();
  for (const Vec2 p : bar(a, b, kThick)) s.polygons.back().push_back(tidy(p));
}

/// Each straight run of standing walls becomes one solid. The centre of cell (0, 0) is the origin.
void add_walls(Scenario& s, CellWalls& walls, double cell) {
  const int side = walls.side();
  for (int line = 0; line + 1 < side; ++line) {
    const double across = (line + 0.5) * cell;
    for (const bool upright : {true, false}) {
      for (int i = 0; i < side;) {
        const auto stands = [&](int k) -> bool {
          return upright ? walls.right_of(line, k) : walls.above(k, line);
        };
        int end = i;
        while (end < side && stands(end)) ++end;
        if (end > i) {
          const double from = (i - 0.5) * cell;
          const double to = (end - 0.5) * cell;
          if (upright) {
            add_bar(s, {across, from}, {across, to});
          } else {
            add_bar(s, {from, across}, {to, across});
          }
        }
        i = end + 1;
      }
    }
  }
}

constexpr int kRooms = 3;
constexpr double kRoom = 2.5;

/// A wall between two rooms with these numbers, from `a` to `b`.
struct RoomWall {
  Vec2 a, b;
  int room, other;
};

std::vector<RoomWall> room_walls() {
  std::vector<RoomWall> walls;
  for (int y = 0; y < kRooms; ++y) {
    for (int x = 0; x < kRooms; ++x) {
      const int room = y * kRooms + x;
      const Vec2 corner{(x + 1) * kRoom, (y + 1) * kRoom};
      if (x + 1 < kRooms) walls.push_back({{corner.x, corner.y - kRoom}, corner, room, room + 1});
      if (y + 1 < kRooms) walls.push_back({{corner.x - kRoom, corner.y}, corner, room, room + kRooms});
    }
  }
  return walls;
}

template <class T>
void shuffle(std::vector<T>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) {
    std::swap(items[i - 1], items[static_cast<std::size_t>(random.index(static_cast<int>(i)))]);
  }
}

void add_door(Scenario& s, Random& random, const RoomWall& wall) {
  constexpr double kPost = 0.1;  // of wall that remains between a door and a corner
  const double width = random.uniform(0.3, 0.6);
  const double begin = random.uniform(kPost, kRoom - kPost - width);
  // A wall extends half its thickness beyond its ends; the door keeps its width.
  const Vec2 along = (wall.b - wall.a) * (1 / kRoom);
  add_bar(s, wall.a, wall.a + along * (begin - kThick / 2));
  add_bar(s, wall.a + along * (begin + width + kThick / 2), wall.b);
}

Vec2 place_in_room(Random& random, int x, int y) {
  constexpr double kInset = 0.3;
  const double px = random.uniform(x * kRoom + kInset, (x + 1) * kRoom - kInset);
  return tidy(Vec2{px, random.uniform(y * kRoom + kInset, (y + 1) * kRoom - kInset)});
}

}  // namespace

void draw_maze(Scenario& s, Random& random) {
  const int side = 5 + random.index(4);
  const double cell = tidy(random.uniform(0.7, 1.0));
  CellWalls walls(side);
  carve(walls, random);
  remove_some(walls, random, random.uniform(0, 0.3));
  s.start.at = {0, 0};
  s.goal.at = tidy(Vec2{(side - 1) * cell, (side - 1) * cell});
  s.bounds = Bounds{tidy(Vec2{-cell / 2, -cell / 2}), tidy(Vec2{(side - 0.5) * cell, (side - 0.5) * cell})};
  add_walls(s, walls, cell);
}

void draw_contest_maze(Scenario& s, Random& random) {
  constexpr int kSide = 32;
  constexpr double kCell = 0.54;
  CellWalls walls(kSide);
  carve(walls, random);
  remove_some(walls, random, random.uniform(0, 0.3));
  s.start.at = {0, 0};
  s.goal.at = tidy(Vec2{kSide / 2 * kCell, kSide / 2 * kCell});
  s.bounds =
      Bounds{tidy(Vec2{-kCell / 2, -kCell / 2}), tidy(Vec2{(kSide - 0.5) * kCell, (kSide - 0.5) * kCell})};
  add_walls(s, walls, kCell);
}

void draw_rooms(Scenario& s, Random& random, const Options& o) {
  s.start.at = place_in_room(random, 0, 0);
  s.goal.at = place_in_room(random, kRooms - 1, kRooms - 1);
  s.bounds = Bounds{{0, 0}, {kRooms * kRoom, kRooms * kRoom}};
  std::vector<RoomWall> walls = room_walls();
  shuffle(walls, random);
  // Connected rooms share a number: a wall between two different numbers gets a door.
  std::array<int, kRooms * kRooms> joined{};
  std::iota(joined.begin(), joined.end(), 0);
  for (const RoomWall& wall : walls) {
    const int number = joined[static_cast<std::size_t>(wall.room)];
    const int other = joined[static_cast<std::size_t>(wall.other)];
    for (int& n : joined) n = n == other ? number : n;
    if (number != other || random.chance(0.3)) {
      add_door(s, random, wall);
    } else {
      add_bar(s, wall.a, wall.b);
    }
  }
  add_discs(s, random, {o.discs.value_or(4), 0.08, 0.25, 0, kRooms * kRoom});
}

}  // namespace whisker::worlds
