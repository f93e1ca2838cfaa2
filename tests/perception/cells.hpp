/// Compares cells of the local grid with obstacles, exactly, in double.
#pragma once

#include "firmware/perception/local_grid.hpp"
#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/world.hpp"

namespace whisker::test {

/// A closed square; empty if max < min.
struct Square {
  sim::Vec2 min;
  sim::Vec2 max;
};

/// Cell (column, row) of the world for cells of this size, reduced by `slack` metres at each side.
Square square(int column, int row, double cell_m, double slack = 0);

bool touches(const Square& s, const sim::Disc& disc);
bool touches(const Square& s, const sim::Segment& segment);

/// Maps a true position into the frame of the local grid, whose estimated pose is `believed`.
struct Shift {
  sim::Pose truth;
  sim::Pose believed;
  sim::Vec2 operator()(sim::Vec2 p) const;
};

/// The obstacle that touches the square, if any; movers are ignored.
bool occupied(const Square& s, const sim::WorldView& world, const Shift& shift);

/// Calls f(column, row) for each clear cell of the window around the pose.
template <class F>
void for_each_clear(const perception::LocalGrid& local_grid, const Pose& pose, int32_t cell_um, F&& f) {
  const auto middle = [&](Length x) { return static_cast<int>(x.raw() / cell_um); };
  for (int row = middle(pose.at.y) - 20; row <= middle(pose.at.y) + 20; ++row) {
    for (int column = middle(pose.at.x) - 20; column <= middle(pose.at.x) + 20; ++column) {
      const Vec centre{Length::from_raw(column * cell_um + cell_um / 2),
                       Length::from_raw(row * cell_um + cell_um / 2)};
      if (local_grid.is_clear(centre)) f(column, row);
    }
  }
}

}  // namespace whisker::test
