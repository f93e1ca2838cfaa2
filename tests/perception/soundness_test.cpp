// Ground marked clear is free, for a sensor that measures the distance of the nearest object in its cone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "host/harness/run/spec.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/perception/cells.hpp"
#include "tests/perception/cluttered.hpp"
#include "tests/perception/rig.hpp"

namespace whisker::test {
namespace {

using worlds::Random;

constexpr double kTurn = 2 * 3.14159265358979323846;

Params draw_params(Random& random) {
  Params p;
  if (random.chance(0.5)) return p;
  p.body.radius = millimetres(25 + random.index(155));
  p.body.track = p.body.radius * 3 / 2;
  p.rangefinders.cone = Angle::turns(10 + random.index(450), 3600);
  p.rangefinders.side_angle = Angle::turns(50 + random.index(350), 3600);
  p.rangefinders.offset = millimetres(random.chance(0.5) ? random.index(90) : 0);
  return p;
}

Pose draw_pose(Random& random) {
  const auto length = [&] { return Length::from_raw(random.index(2000000) - 1000000); };
  // Headings on the axes and their neighbours are the raster's special cases.
  const Angle heading = random.chance(0.3) ? Angle::turns(random.index(8), 8) +
                                                 Angle::from_raw(static_cast<uint32_t>(random.index(3)) - 1U)
                                           : Angle::from_raw(static_cast<uint32_t>(random.bits()));
  return {{length(), length()}, heading};
}

/// Near the body, or where the rule is weakest: cell corners, cone edges, and tiny distances from them.
sim::Vec2 draw_point(const Params& p, const Pose& pose, Random& random) {
  const double cell = metres(grid_cell(p));
  const sim::Vec2 body{metres(pose.at.x), metres(pose.at.y)};
  const double hair =
      random.chance(0.5) ? 0 : std::pow(10.0, random.uniform(-9, -3)) * (random.chance(0.5) ? 1 : -1);
  const double reach = metres(p.body.radius) + std::pow(random.uniform(0, 1), 2) * 20 * cell;
  switch (random.index(3)) {
    case 0: {
      const double to = random.uniform(0, kTurn);
      return body + sim::Vec2{std::cos(to), std::sin(to)} * reach;
    }
    case 1: {
      const double to = random.uniform(0, kTurn);
      const sim::Vec2 near = body + sim::Vec2{std::cos(to), std::sin(to)} * reach;
      return {std::round(near.x / cell) * cell + hair, std::round(near.y / cell) * cell + hair};
    }
    default: {
      const perception::Beam beam = perception::beam_of(mount(p.rangefinders, random.index(3)), pose);
      const double axis = radians(beam.axis);
      const double edge = radians(beam.half_cone) * (random.chance(0.5) ? 1 : -1) + hair;
      const sim::Vec2 apex{metres(beam.apex.x), metres(beam.apex.y)};
      return apex + sim::Vec2{std::cos(axis + edge), std::sin(axis + edge)} * reach;
    }
  }
}

void add_obstacle(Cluttered& world, const Params& p, const Pose& pose, Random& random) {
  const sim::Vec2 at = draw_point(p, pose, random);
  const sim::Vec2 body{metres(pose.at.x), metres(pose.at.y)};
  switch (random.index(5)) {
    case 0: world.discs.push_back({at, 0.0005}); break;
    case 1: world.discs.push_back({at, random.uniform(0.001, 0.2)}); break;
    case 2:
      world.segments.push_back({at, at + (at - body) * random.uniform(0.001, 2)});
      break;  // seen edge-on
    case 3: {
      const double to = random.uniform(0, kTurn);
      world.segments.push_back(
          {at, at + sim::Vec2{std::cos(to), std::sin(to)} * random.uniform(0.0001, 0.5)});
      break;
    }
    default: world.segments.push_back({at, draw_point(p, pose, random)}); break;
  }
}

TEST(Soundness, NoAdversaryHidesInAClearCell) {
  int worlds_seen = 0;
  int clear = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(20000); ++seed) {
    Random random(seed);
    const Params p = draw_params(random);
    perception::LocalGrid local_grid;
    local_grid.configure(p);
    Pose pose = draw_pose(random);
    local_grid.reset(pose);
    Cluttered world;
    const int obstacles = 1 + random.index(6);
    for (int i = 0; i < obstacles; ++i) add_obstacle(world, p, pose, random);
    const sim::Vec2 body{metres(pose.at.x), metres(pose.at.y)};
    // Ground that no beam can prove must be free when the body is placed.
    if (sim::clearance(world.view(), body, 0, metres(rim_sweep(p).radius)) <= 0) continue;
    ++worlds_seen;
    for (int turn = 0; turn < 3; ++turn) {
      for (int beam = 0; beam < 3; ++beam) local_grid.mark(look(p, world, pose, beam));
      pose.heading += Angle::from_raw(static_cast<uint32_t>(random.index(1 << 29)));
      local_grid.move_to(pose);
    }
    for_each_clear(local_grid, pose, grid_cell(p).raw(), [&](int column, int row) {
      ++clear;
      ASSERT_FALSE(occupied(square(column, row, metres(grid_cell(p))), world.view(), Shift{}))
          << "seed " << seed << ": cell " << column << ' ' << row;
    });
    if (HasFatalFailure()) return;
  }
  std::printf("%d worlds, %d clear cells\n", worlds_seen, clear);
  EXPECT_GT(worlds_seen, static_cast<int>(test::effort(5000)));
  EXPECT_GT(clear / worlds_seen, 100);
}

/// Calls f(column, row) for each clear cell of the lane, in its frame: columns along it, row 0 left of its
/// middle.
template <class F>
void for_each_clear_of_lane(const perception::Lane& lane, const Pose& from, F&& f) {
  constexpr int kBeside = perception::Lane::kRows / 2;
  const Length cell = lane.half_width() / kBeside;
  for (int row = -kBeside; row < kBeside; ++row) {
    for (int column = 0; column < perception::kCells; ++column) {
      const Vec centre = from.at + polar(from.heading, cell * column + cell / 2) +
                         polar(from.heading + Angle::turns(1, 4), cell * row + cell / 2);
      if (lane.is_clear(centre)) f(column, row);
    }
  }
}

TEST(Soundness, NoAdversaryHidesOnALane) {
  int worlds_seen = 0;
  int clear = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(20000); ++seed) {
    Random random(seed);
    const Params p = draw_params(random);
    perception::LocalGrid local_grid;
    local_grid.configure(p);
    Pose pose = draw_pose(random);
    local_grid.reset(pose);
    // The body may stand anywhere on the lane, or beside it.
    const double half_width = metres(local_grid.lane().half_width());
    const auto off = [&] {
      return Length::from_raw(static_cast<int32_t>(random.uniform(-1, 1) * half_width * 1e6));
    };
    const Pose from{pose.at + Vec{off(), off()}, draw_pose(random).heading};
    local_grid.open_lane(from);
    const sim::Pose frame{{metres(from.at.x), metres(from.at.y)}, radians(from.heading)};
    Cluttered world;
    const int obstacles = 1 + random.index(6);
    for (int i = 0; i < obstacles; ++i) add_obstacle(world, p, pose, random);
    const sim::Vec2 body{metres(pose.at.x), metres(pose.at.y)};
    if (sim::clearance(world.view(), body, 0, metres(rim_sweep(p).radius)) <= 0) continue;
    ++worlds_seen;
    for (int turn = 0; turn < 3; ++turn) {
      for (int beam = 0; beam < 3; ++beam) local_grid.mark(look(p, world, pose, beam));
      pose.heading += Angle::from_raw(static_cast<uint32_t>(random.index(1 << 29)));
      local_grid.move_to(pose);
    }
    const Shift shift{frame, {}};
    for_each_clear_of_lane(local_grid.lane(), from, [&](int column, int row) {
      ++clear;
      ASSERT_FALSE(
          occupied(square(column, row, half_width * 2 / perception::Lane::kRows), world.view(), shift))
          << "seed " << seed << ": cell " << column << ' ' << row;
    });
    if (HasFatalFailure()) return;
  }
  std::printf("%d worlds, %d clear cells of lanes\n", worlds_seen, clear);
  EXPECT_GT(worlds_seen, static_cast<int>(test::effort(5000)));
  EXPECT_GT(clear / worlds_seen, 50);
}

// The estimated pose differs from the true one by the encoder resolution and the motion between two ticks;
// ground proved a metre of travel ago is off by that much.
class SoundnessIn : public testing::TestWithParam<worlds::Kind> {};

TEST_P(SoundnessIn, MotionHoldsButForAHair) {
  constexpr double kSlack = 0.0005;                                   // m
  const int every = std::getenv("WHISKER_LONG") != nullptr ? 1 : 10;  // ticks
  std::uint64_t clear = 0;
  std::uint64_t touched[2] = {};
  const double slacks[] = {0, kSlack};
  for (std::uint64_t seed = 1; seed <= test::effort(5); ++seed) {
    worlds::Options options;
    options.seed = 900 + seed;
    const Scenario scenario = worlds::generate(GetParam(), options);
    Rig rig(scenario);
    const double cell = metres(grid_cell(scenario.robot));
    int ticks = 0;
    while (rig.plant().time() < 40) {
      const sim::Pose truth = rig.plant().pose();
      if (!rig.step()) break;
      if (++ticks % every != 0) continue;
      const Pose& pose = rig.status().pose;
      const Shift shift{truth, {{metres(pose.at.x), metres(pose.at.y)}, radians(pose.heading)}};
      for_each_clear(*rig.local_grid(), pose, grid_cell(scenario.robot).raw(), [&](int column, int row) {
        ++clear;
        for (int i = 0; i < 2; ++i) {
          if (!occupied(square(column, row, cell, slacks[i]), rig.world(), shift)) break;
          ++touched[i];
        }
      });
      ASSERT_EQ(touched[1], 0U) << worlds::name(GetParam()) << " seed " << options.seed << " at "
                                << rig.plant().time() << " s";
    }
  }
  std::printf("%.0f clear cells; occupied %.0f, without a rim of 0.5 mm %.0f\n", static_cast<double>(clear),
              static_cast<double>(touched[0]), static_cast<double>(touched[1]));
  EXPECT_GT(clear, test::effort(300000));
}

INSTANTIATE_TEST_SUITE_P(Each, SoundnessIn,
                         testing::Values(worlds::Kind::discs, worlds::Kind::poles, worlds::Kind::maze,
                                         worlds::Kind::rooms));

}  // namespace
}  // namespace whisker::test
