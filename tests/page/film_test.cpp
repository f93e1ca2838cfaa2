#include "host/page/film.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "host/run/clear_cells.hpp"
#include "host/run/runner.hpp"
#include "host/worlds/generate.hpp"

namespace whisker::page {
namespace {

using Cells = std::set<std::pair<std::int64_t, std::int64_t>>;

std::int64_t below(double x, double cell) { return static_cast<std::int64_t>(std::floor(x / cell + 1e-6)); }

Length centre(std::int64_t cell, const Params& params) {
  const std::int32_t um = patch_cell(params).raw();
  return Length::from_raw(static_cast<std::int32_t>(cell * um + um / 2));
}

/// All clear cells, in a window larger than the local grid.
Cells clear_cells(const perception::LocalGrid& local_grid, const Params& params, std::int64_t x,
                  std::int64_t y) {
  Cells cells;
  for (std::int64_t j = y - 40; j <= y + 40; ++j) {
    for (std::int64_t i = x - 40; i <= x + 40; ++i) {
      if (local_grid.is_clear({centre(i, params), centre(j, params)})) cells.emplace(i, j);
    }
  }
  return cells;
}

Scenario discs() {
  worlds::Options options;
  options.seed = 5;
  options.noise = true;
  Scenario scenario = worlds::generate(worlds::Kind::discs, options);
  scenario.time_limit_s = 20;
  return scenario;
}

TEST(Film, ShowsTheCellsThatThePatchHas) {
  const Scenario scenario = discs();
  const double cell = patch_cell(scenario.robot).raw() * 1e-6;
  Film film(scenario.robot);
  Frames frames;
  std::array<std::uint32_t, Film::kSide * 2> picture{};
  std::size_t tick = 0, change = 0, pictures = 0;
  RunOptions options;
  options.watch = [&](const Moment& moment) {
    if (moment.local_grid == nullptr || tick++ % 40 != 0) return;
    const TickRecord& r = moment.record;
    const Vec at{Length::from_raw(static_cast<std::int32_t>(std::lround(r.est_x_m * 1e6))),
                 Length::from_raw(static_cast<std::int32_t>(std::lround(r.est_y_m * 1e6)))};
    film.add(tick - 1, at, *moment.local_grid, frames);
    for (; change < frames.words.size(); ++change) {
      picture[static_cast<std::size_t>(frames.words[change])] ^=
          static_cast<std::uint32_t>(frames.bits[change]);
    }
    const std::int64_t x = below(r.est_x_m, cell), y = below(r.est_y_m, cell);
    Cells shown;
    for (std::int64_t j = y - kPatchReach; j <= y + kPatchReach; ++j) {
      for (std::int64_t i = x - kPatchReach; i <= x + kPatchReach; ++i) {
        const auto column = static_cast<std::uint64_t>(i) % Film::kSide;
        const auto row = static_cast<std::uint64_t>(j) % Film::kSide;
        if ((picture[2 * row + column / 32] >> (column % 32) & 1U) != 0) shown.emplace(i, j);
      }
    }
    ASSERT_EQ(shown, clear_cells(*moment.local_grid, scenario.robot, x, y)) << "tick " << tick - 1;
    ++pictures;
  };
  run(scenario, options);
  EXPECT_GT(pictures, 20U);
  EXPECT_EQ(frames.ticks.size(), pictures);
  EXPECT_GT(frames.words.size(), 500U);
}

}  // namespace
}  // namespace whisker::page
