#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "firmware/planning/global/map_planner.hpp"
#include "host/harness/run/core_pilot.hpp"
#include "host/harness/run/map_picture.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/worlds/generate.hpp"

namespace whisker {
namespace {

using planning::Cell;
using planning::CellState;

Scenario rooms(std::uint64_t seed, double time_limit_s) {
  worlds::Options options;
  options.seed = seed;
  Scenario scenario = worlds::generate(worlds::Kind::rooms, options);
  scenario.time_limit_s = time_limit_s;
  return scenario;
}

/// Few obstacles.
Scenario open_field() {
  worlds::Options options;
  options.discs = 3;
  return worlds::generate(worlds::Kind::discs, options);
}

RunOptions with_map() {
  RunOptions options;
  options.planner = PlannerKind::map;
  return options;
}

TEST(RecordingGuide, ChangesNothing) {
  const Scenario scenario = rooms(4, 60);
  RunOptions plain;
  plain.pilot = [](const Scenario& s, PlannerKind, sim::Plant& plant) {
    const auto map = std::make_shared<planning::TableMapPlanner<2048>>(s.robot, fuzzy::kDefaultTable);
    return std::make_unique<CorePilot>(s, RecordedPlanner{{map, &map->planner}}, plant);
  };
  EXPECT_EQ(run(scenario, with_map()).hash, run(scenario, plain).hash);
}

TEST(RecordingGuide, TellsAtEachTickWhatLeads) {
  int places = 0, goals = 0;
  for (const Scenario& scenario : {rooms(4, 60), open_field()}) {
    RunOptions options = with_map();
    std::vector<TickRecord> records;
    options.watch = [&](const Moment& moment) { records.push_back(moment.record); };
    run(scenario, options);
    for (const TickRecord& r : records) {
      ASSERT_NE(r.guide, Guidance::unknown) << r.t_s;
      if (r.mode == planning::Mode::surveying) {
        EXPECT_EQ(r.guide, Guidance::none) << r.t_s;
      }
      if (r.mode == planning::Mode::searching || r.mode == planning::Mode::following) {
        EXPECT_EQ(r.guide, Guidance::none) << r.t_s;
      }
      if (r.guide == Guidance::goal) {
        ++goals;
        EXPECT_NEAR(r.way_x_m, scenario.goal.at.x, 1e-6);
        EXPECT_NEAR(r.way_y_m, scenario.goal.at.y, 1e-6);
      }
      if (r.guide == Guidance::place) {
        ++places;
        EXPECT_LT(std::hypot(r.way_x_m - r.est_x_m, r.way_y_m - r.est_y_m), 4.5) << r.t_s;
      }
    }
  }
  EXPECT_GT(places, 500);
  EXPECT_GT(goals, 50);
}

TEST(RecordingGuide, IsNotThereWithoutAMap) {
  RunOptions options;
  options.planner = PlannerKind::boundary;
  std::vector<TickRecord> records;
  options.watch = [&](const Moment& moment) {
    records.push_back(moment.record);
    EXPECT_EQ(moment.guide, nullptr);
  };
  run(rooms(4, 5), options);
  for (const TickRecord& r : records) ASSERT_EQ(r.guide, Guidance::unknown);
}

/// The path steps over sides and corners, never into a cell that is known to be occupied. It ends at the
/// goal, where it leaves the window, or before what has come into its way since it was planned.
void expect_a_way(const MapPicture& picture, Cell from, Cell goal) {
  for (const Cell p : picture.way) {
    ASSERT_LE(std::abs(p.x - from.x), 1);
    ASSERT_LE(std::abs(p.y - from.y), 1);
    ASSERT_FALSE(p == from);
    from = p;
  }
  const bool border =
      from.x == 0 || from.y == 0 || from.x == picture.columns - 1 || from.y == picture.rows - 1;
  bool stopped = false;
  for (int i = 0; i < 9 && !border; ++i) {
    stopped = stopped || picture.at(from.x + i % 3 - 1, from.y + i / 3 - 1) >= planning::CellState::suspect;
  }
  EXPECT_TRUE(from == goal || border || stopped) << from.x << ' ' << from.y;
}

TEST(MapPicture, HasTheCellsAndThePlansWay) {
  const Scenario scenario = rooms(4, 60);
  RunOptions options = with_map();
  MapWatch watch(scenario.robot);
  int pictures = 0, ways = 0;
  options.watch = [&](const Moment& moment) {
    ASSERT_NE(moment.guide, nullptr);
    if (!watch.look(moment.guide)) return;
    ++pictures;
    const MapPicture& picture = *watch.last();
    const planning::GridMap& map = moment.guide->inside().map();
    ASSERT_TRUE(moment.guide->inside().planned());
    ASSERT_EQ(picture.corner, map.corner());
    ASSERT_DOUBLE_EQ(picture.cell_m, 0.1);
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.columns; ++x) ASSERT_EQ(picture.at(x, y), map.at({x, y}));
    if (picture.way.empty()) return;
    ++ways;
    expect_a_way(picture, map.place(moment.guide->body()), map.place(moment.guide->goal()));
  };
  run(scenario, options);
  EXPECT_GT(pictures, 300);
  EXPECT_GT(ways, 100);
}

TEST(MapWatch, TakesAPictureEveryTenthOfASecondOrWhenThePlanIsMade) {
  for (const PlannerKind planner : {PlannerKind::map, core_planner("map", 16384)}) {
    const Scenario scenario = rooms(2, 40);
    RunOptions options = with_map();
    options.planner = planner;
    MapWatch watch(scenario.robot);
    double last = 0;
    bool taken = false;
    options.watch = [&](const Moment& moment) {
      const double t = moment.record.t_s;
      const bool due = t == 0 || t - last > 0.0999;
      taken = due && moment.guide->inside().planned();
      ASSERT_EQ(watch.look(moment.guide), taken) << t;
      if (taken) last = t;
    };
    run(scenario, options);
    // A plan of 16 KB takes seconds.
    EXPECT_GT(last, 30);
  }
}

TEST(Planner, HasAMapOfTheSizeThatItsKindSays) {
  for (const PlannerKind kind : planners()) {
    const Params params;
    const RecordedPlanner made = make_recorded_planner(kind, params);
    ASSERT_NE(made.planner, nullptr) << name(kind);
    ASSERT_EQ(made.guide != nullptr, kind.map_bytes > 0) << name(kind);
    if (made.guide == nullptr) continue;
    const planning::GridShape shape = planning::map_shape(kind.map_bytes);
    EXPECT_EQ(made.guide->inside().map().shape().rows, shape.rows);
    EXPECT_EQ(made.guide->inside().map().shape().words, shape.words);
  }
}

}  // namespace
}  // namespace whisker
