// The guide's cost per tick does not depend on the goal's distance: number of cells on the lines that it
// traces, counted with the linker's --wrap (see CMakeLists.txt).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <random>

#include "firmware/math/region.hpp"
#include "firmware/planning/global/map_planner.hpp"
#include "tests/planning/ground.hpp"

namespace {
int g_cells = 0;
}

// The wrapped functions by their mangled names; the guide calls one of them for each cell of a line.
extern "C" {
int __real__ZNK7whisker8planning9Wavefront5phaseERKNS0_7GridMapENS0_4CellE(
    const whisker::planning::Wavefront*, const whisker::planning::GridMap&, whisker::planning::Cell);
int __wrap__ZNK7whisker8planning9Wavefront5phaseERKNS0_7GridMapENS0_4CellE(
    const whisker::planning::Wavefront* wavefront, const whisker::planning::GridMap& map,
    whisker::planning::Cell p) {
  ++g_cells;
  return __real__ZNK7whisker8planning9Wavefront5phaseERKNS0_7GridMapENS0_4CellE(wavefront, map, p);
}
bool __real__ZNK7whisker8planning9Wavefront7blockedERKNS0_7GridMapENS0_4CellE(
    const whisker::planning::Wavefront*, const whisker::planning::GridMap&, whisker::planning::Cell);
bool __wrap__ZNK7whisker8planning9Wavefront7blockedERKNS0_7GridMapENS0_4CellE(
    const whisker::planning::Wavefront* wavefront, const whisker::planning::GridMap& map,
    whisker::planning::Cell p) {
  ++g_cells;
  return __real__ZNK7whisker8planning9Wavefront7blockedERKNS0_7GridMapENS0_4CellE(wavefront, map, p);
}
}

namespace whisker::planning {
namespace {

constexpr Length kRange = 3_m;  // WavefrontPlanner's horizon

struct Cost {
  int worst = 0;
  int advised = 0;
};

/// Short drives in the open while walls appear: the path is first straight to the goal, then another one.
template <int kBytes>
Cost cost_of(Vec from, Vec to) {
  Params params;
  perception::LocalGrid local_grid;
  local_grid.configure(params);
  View view;
  view.local_grid = &local_grid;
  auto map = std::make_unique<MapOf<kBytes>>(params);
  Cost cost;
  std::mt19937 random(1);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  // A plan of a large map takes some seconds.
  constexpr int kDrive = kBytes > 8192 ? 2000 : 400;
  for (int tick = 0; tick < 15 * kDrive; ++tick) {
    const int since = tick % kDrive;
    if (since == 0) {
      view.pose = {from, bearing(to - from)};
      local_grid.reset(view.pose);
      map->guide.start(view, {to, 100_mm});
    }
    if (since > 100 && since % 20 == 0) {
      const Vec way{millimetres(draw(-100, 100)), millimetres(draw(-100, 100))};
      view.pose.at = view.pose.at + way;
      view.travelled_um += static_cast<uint32_t>(norm(way).raw());
      view.pose.heading = test::degrees(draw(0, 359));
      local_grid.move_to(view.pose);
      view.observed = 7;
      for (int i = 0; i < hal::kBeams; ++i) {
        const bool hit = draw(0, 2) == 0;
        view.observations[i] = {perception::beam_of(mount(params.rangefinders, i), view.pose), 0,
                                hit ? millimetres(draw(200, 1500)) : 2_m, hit};
      }
    }
    g_cells = 0;
    local_grid.begin_tick();
    map->guide.observe(view);
    local_grid.work().begin_rest();
    map->guide.ponder(view);
    view.observed = 0;
    cost.worst = std::max(cost.worst, g_cells);
    Vec place;
    const GlobalPlanner::Advice advice = map->guide.advise(view, norm(to - view.pose.at), place);
    if (advice == GlobalPlanner::Advice::place) ++cost.advised;
  }
  return cost;
}

template <int kBytes>
void expect_bounded() {
  SCOPED_TRACE(kBytes);
  constexpr planning::GridShape kShape = map_shape(kBytes);
  const int steps = kRange.raw() / kShape.cell.raw();
  // A line to each position within the horizon, and two through the window.
  const int bound = steps * 2 * steps + 2 * (kShape.columns() + kShape.rows);
  const Vec corner{kPlaceLimit, kPlaceLimit};
  const Vec opposite{-kPlaceLimit, -kPlaceLimit};
  const Cost near = cost_of<kBytes>({}, {10_m, Length{}});
  for (const Vec to : {Vec{10_m, Length{}}, Vec{100_m, 30_m}, Vec{kPlaceLimit, Length{}}, corner}) {
    const Cost cost = cost_of<kBytes>({}, to);
    EXPECT_LE(cost.worst, bound) << to.x.raw();
    EXPECT_GT(cost.advised, 3000) << to.x.raw();
  }
  const Cost farthest = cost_of<kBytes>(opposite, corner);
  EXPECT_LE(farthest.worst, bound);
  EXPECT_GT(farthest.advised, 3000);
  EXPECT_GT(near.worst, steps) << "it looked for no way: nothing was counted";
  std::printf("%d bytes: at most %d cells a tick at 10 m, %d at the farthest goal; bound %d\n", kBytes,
              near.worst, farthest.worst, bound);
}

TEST(FarGoal, CostsATickNoMoreThanANearOne) {
  expect_bounded<1024>();
  expect_bounded<2048>();
  expect_bounded<16384>();
}

}  // namespace
}  // namespace whisker::planning
