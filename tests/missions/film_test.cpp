#include "host/harness/run/map_film.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "host/harness/run/clear_cells.hpp"
#include "host/harness/run/film.hpp"
#include "host/harness/run/run_log.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/worlds/generate.hpp"

namespace whisker {
namespace {

using Cells = std::set<std::pair<std::int64_t, std::int64_t>>;

/// Decodes frames as a page does.
class Reader {
 public:
  explicit Reader(const MapPicture& like)
      : columns_(like.columns),
        rows_(like.rows),
        words_(3 * static_cast<std::size_t>(columns_ / 32 * rows_)) {}

  void turn(const MapFrames& frames) {
    const std::size_t frame = shown_++;
    x_ = frames.x.at(frame);
    y_ = frames.y.at(frame);
    for (std::int64_t n = frames.pictures.changes.at(frame); n > 0; --n, ++change_) {
      words_.at(static_cast<std::size_t>(frames.pictures.words.at(change_))) ^=
          static_cast<std::uint32_t>(frames.pictures.bits.at(change_));
    }
  }
  bool bit(std::int64_t plane, std::int64_t x, std::int64_t y) const {
    const std::int64_t column = ((x_ + x) % columns_ + columns_) % columns_;
    const std::int64_t row = ((y_ + y) % rows_ + rows_) % rows_;
    const std::int64_t words = columns_ / 32;
    const auto word = static_cast<std::size_t>((plane * rows_ + row) * words + column / 32);
    return (words_[word] >> (column % 32) & 1U) != 0;
  }
  std::size_t shown() const { return shown_; }

 private:
  std::int64_t columns_, rows_, x_ = 0, y_ = 0;
  std::vector<std::uint32_t> words_;
  std::size_t shown_ = 0, change_ = 0;
};

void expect_same(const Reader& reader, const MapPicture& picture) {
  std::vector<bool> way(picture.cells.size());
  for (const planning::Cell p : picture.way)
    way[static_cast<std::size_t>(p.y * picture.columns + p.x)] = true;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.columns; ++x) {
      const int state = (reader.bit(0, x, y) ? 2 : 0) + (reader.bit(1, x, y) ? 1 : 0);
      ASSERT_EQ(state, static_cast<int>(picture.at(x, y))) << x << ' ' << y;
      ASSERT_EQ(reader.bit(2, x, y), way[static_cast<std::size_t>(y * picture.columns + x)]) << x << ' ' << y;
    }
  }
}

/// Far enough that the window of the smallest map moves repeatedly.
Scenario far() {
  worlds::Options options;
  options.seed = 5;
  options.noise = true;
  Scenario scenario = worlds::generate(worlds::Kind::discs, options);
  scenario.time_limit_s = 60;
  return scenario;
}

RunOptions smallest() {
  RunOptions options;
  options.planner = core_planner("map", 1024);
  return options;
}

TEST(MapFilm, ShowsEveryPictureAsItWas) {
  const Scenario scenario = far();
  RunOptions options = smallest();
  MapWatch watch(scenario.robot);
  MapFilm film;
  MapFrames frames;
  std::optional<Reader> reader;
  std::size_t tick = 0;
  options.watch = [&](const Moment& moment) {
    const bool taken = watch.look(moment.guide);
    if (taken) {
      film.add(tick, *watch.last(), frames);
      if (!reader) reader.emplace(*watch.last());
      reader->turn(frames);
      ASSERT_EQ(frames.pictures.ticks.back(), static_cast<std::int64_t>(tick));
      expect_same(*reader, *watch.last());
    }
    ++tick;
  };
  run(scenario, options);
  ASSERT_TRUE(reader);
  EXPECT_GT(reader->shown(), 200U);
  EXPECT_NE(frames.x.front(), frames.x.back()) << "the window never moved";
}

TEST(MapFilm, IsTheSameWhenItIsCutAndPutTogether) {
  const Scenario scenario = far();
  RunOptions options = smallest();
  RunLog whole({scenario}), cut({scenario});
  std::vector<Ticks> parts;
  std::size_t tick = 0;
  options.watch = [&](const Moment& moment) {
    whole.add(moment);
    cut.add(moment);
    if (++tick % 256 == 0) parts.push_back(cut.take());
  };
  run(scenario, options);
  parts.push_back(cut.take());
  // From a tick within the second part, as a client requests after it lost the connection.
  constexpr std::size_t kFrom = 300;
  Ticks rest;
  rest.append(parts[1], kFrom - 256, 256);
  for (std::size_t i = 2; i < parts.size(); ++i) rest.append(parts[i], 0, 256 * i);
  Ticks expected;
  expected.append(whole.ticks(), kFrom, 0);
  EXPECT_EQ(rest.map.pictures.ticks, expected.map.pictures.ticks);
  EXPECT_EQ(rest.map.pictures.words, expected.map.pictures.words);
  EXPECT_EQ(rest.map.pictures.bits, expected.map.pictures.bits);
  EXPECT_EQ(rest.map.x, expected.map.x);
  EXPECT_EQ(rest.map.y, expected.map.y);
  ASSERT_GT(rest.map.x.size(), 100U);
  EXPECT_GE(rest.map.pictures.ticks.front(), static_cast<std::int64_t>(kFrom));
}

TEST(MapFilm, IsEmptyWithoutAMap) {
  const Scenario scenario = far();
  RunLog log({scenario});
  RunOptions options;
  options.planner = PlannerKind::boundary;
  log.watch(options);
  run(scenario, options);
  EXPECT_TRUE(log.ticks().map.x.empty());
}

std::int64_t below(double x, double cell) { return static_cast<std::int64_t>(std::floor(x / cell + 1e-6)); }

Length centre(std::int64_t cell, const Params& params) {
  const std::int32_t um = grid_cell(params).raw();
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
  const double cell = grid_cell(scenario.robot).raw() * 1e-6;
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
    for (std::int64_t j = y - kGridReach; j <= y + kGridReach; ++j) {
      for (std::int64_t i = x - kGridReach; i <= x + kGridReach; ++i) {
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
}  // namespace whisker
