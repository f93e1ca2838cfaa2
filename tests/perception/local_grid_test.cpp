#include "firmware/perception/local_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <set>
#include <utility>
#include <vector>

#include "host/harness/run/spec.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/perception/cells.hpp"

namespace whisker::test {
namespace {

using worlds::Random;

constexpr int kAround = 24;  // cells, beyond the window
constexpr double kCell = 0.02;

double metres(Length l) { return l.raw() * 1e-6; }
using Cell = std::pair<int, int>;

Vec centre(Cell cell) { return {millimetres(20 * cell.first + 10), millimetres(20 * cell.second + 10)}; }
Cell cell_of(Vec at) {
  return {static_cast<int>(std::floor(metres(at.x) / kCell)),
          static_cast<int>(std::floor(metres(at.y) / kCell))};
}

std::set<Cell> clear_around(const perception::LocalGrid& local_grid, Vec at) {
  std::set<Cell> clear;
  const Cell here = cell_of(at);
  for (int y = here.second - kAround; y <= here.second + kAround; ++y) {
    for (int x = here.first - kAround; x <= here.first + kAround; ++x) {
      if (local_grid.is_clear(centre({x, y}))) clear.insert({x, y});
    }
  }
  return clear;
}

perception::ConeObservation observation(Pose from, Angle axis, Length free, bool hit = true) {
  perception::ConeObservation p;
  p.beam = perception::beam_of({{}, axis, Params{}.rangefinders.cone}, from);
  p.beam.half_cone = Angle::from_raw(p.beam.half_cone.raw() / 2);
  p.free = free;
  p.hit = hit;
  return p;
}

double distance(Cell cell, Vec at) {
  const Vec c = centre(cell);
  return std::hypot(metres(c.x) - metres(at.x), metres(c.y) - metres(at.y));
}

/// Distance from the farthest corner of the cell, and from its nearest point.
double farthest(Cell cell, Vec at) {
  const Vec c = centre(cell);
  return std::hypot(std::fabs(metres(c.x) - metres(at.x)) + kCell / 2,
                    std::fabs(metres(c.y) - metres(at.y)) + kCell / 2);
}
double nearest(Cell cell, double x, double y) {
  const Vec c = centre(cell);
  return std::hypot(std::fmax(std::fabs(metres(c.x) - x) - kCell / 2, 0),
                    std::fmax(std::fabs(metres(c.y) - y) - kCell / 2, 0));
}

// Beyond kScatterRange, the end of a wall may give no echo.
TEST(LocalGrid, ATurnOfANarrowBeamThatLosesWallsClearsNothingFar) {
  Params p;
  p.body.radius = 330_mm;
  p.rangefinders.cone = 12_deg;
  p.rangefinders.incidence = 50_deg;
  ASSERT_NE(reach(p).past, Angle{}) << "readings are chained";
  perception::LocalGrid grid;
  grid.configure(p);
  grid.reset({});
  perception::EarlierObservation before{};
  for (std::int32_t tick = 0; tick < 180; ++tick) {
    const Pose pose{{}, 1_deg * (tick * 2)};
    grid.move_to(pose);
    perception::ConeObservation seen;
    seen.beam = perception::beam_of(mount(p.rangefinders, hal::kFront), pose);
    seen.number = hal::kFront;
    seen.free = 2_m;
    seen.taken = Time::from_raw(static_cast<std::uint32_t>(tick * 50));
    if (tick > 0) {
      grid.mark(seen, &before);
      grid.chain(seen, &before);
    }
    before = {seen.beam.apex, seen.beam.axis, seen.free};
  }
  int near = 0;
  for (std::int32_t mm = 350; mm < 1200; mm += 5) {
    for (std::int32_t around = 0; around < 360; around += 2) {
      const bool is_clear = grid.is_clear(polar(1_deg * around, millimetres(mm)));
      if (mm > 500 + metres(mount(p.rangefinders, hal::kFront).apex.x) * 1000 + 120) {
        EXPECT_FALSE(is_clear) << mm << " mm at " << around;
      } else {
        near += is_clear ? 1 : 0;
      }
    }
  }
  EXPECT_GT(near, 100);
}

// At the edge of the cone there is always a cell that is not clear. On a lane, whose clear ground may hold
// what such sensors do not see, it must not explain the echo.
TEST(LocalGrid, OnALaneOnlyWhatStandsBesideItExplainsAnEcho) {
  for (const Angle incidence : {40_deg, 90_deg}) {
    Params p;
    p.rangefinders.side_angle = Angle::turns(375, 3600);
    p.rangefinders.cone = 36_deg;
    p.rangefinders.incidence = incidence;
    perception::LocalGrid grid;
    grid.configure(p);
    grid.reset({});
    grid.open_lane({{-(50_mm), 0_mm}, Angle{}});
    perception::ConeObservation left;
    left.beam = perception::beam_of(mount(p.rangefinders, hal::kLeft), {});
    left.number = hal::kLeft;
    left.free = 200_mm;
    grid.mark(left);
    const Vec seen{75_mm, 70_mm};
    ASSERT_TRUE(grid.lane().is_clear(seen));
    grid.revoke(left.beam, 180_mm, 180_mm);
    EXPECT_TRUE(grid.lane().is_clear(seen)) << "it may come from beside the lane";
    grid.revoke(left.beam, 103_mm, 103_mm);
    EXPECT_EQ(grid.lane().is_clear(seen), incidence == 90_deg);
  }
}

TEST(LocalGrid, KnowsOnlyTheGroundUnderTheBodyAtFirst) {
  for (std::uint64_t seed = 1; seed <= test::effort(300); ++seed) {
    Random random(seed);
    const Pose pose{{Length::from_raw(random.index(2000000000) - 1000000000),
                     Length::from_raw(random.index(2000000000) - 1000000000)},
                    Angle::from_raw(static_cast<std::uint32_t>(random.bits()))};
    const Params params;
    perception::LocalGrid local_grid;
    local_grid.configure(params);
    local_grid.reset(pose);
    const std::set<Cell> clear = clear_around(local_grid, pose.at);
    EXPECT_GT(clear.size(), 40U);
    // Each lies completely under the body.
    for (const Cell& cell : clear) ASSERT_LE(farthest(cell, pose.at), 0.09);
  }
}

// Rows and columns that leave the window are forgotten, the others are kept, and no bit wraps around the
// torus.
TEST(LocalGrid, AMovingWindowNeitherLeaksNorLoses) {
  for (std::uint64_t seed = 1; seed <= test::effort(300); ++seed) {
    Random random(seed);
    perception::LocalGrid local_grid;
    local_grid.configure(Params{});
    Length travel;
    Pose pose{{millimetres(random.index(4000) - 2000), millimetres(random.index(4000) - 2000)},
              Angle::turns(random.index(8), 8)};
    local_grid.reset(pose);
    std::set<Cell> before = clear_around(local_grid, pose.at);
    for (int step = 0; step < 30; ++step) {
      const int reach = random.chance(0.1) ? 1500 : 60;
      const Vec way{millimetres(random.index(2 * reach + 1) - reach),
                    millimetres(random.index(2 * reach + 1) - reach)};
      pose.at = pose.at + way;
      travel += norm(way);
      local_grid.move_to(pose);
      const std::set<Cell> moved = clear_around(local_grid, pose.at);
      for (const Cell& cell : moved) {
        ASSERT_TRUE(before.count(cell) == 1 || distance(cell, pose.at) < 0.09)
            << "seed " << seed << " step " << step << ": a leak at " << cell.first << ' ' << cell.second;
      }
      for (const Cell& cell : before) {
        const bool near = std::fabs(metres(centre(cell).x) - metres(pose.at.x)) < 0.25 &&
                          std::fabs(metres(centre(cell).y) - metres(pose.at.y)) < 0.25;
        const bool young = travel < derived::kAgeTravel;
        ASSERT_TRUE(!near || !young || moved.count(cell) == 1)
            << "seed " << seed << " step " << step << ": lost";
      }
      local_grid.mark(
          observation(pose, Angle::from_raw(static_cast<std::uint32_t>(random.bits())), 2_m, false));
      before = clear_around(local_grid, pose.at);
    }
  }
}

/// A local grid with random clear ground around a body at rest.
perception::LocalGrid draw_local_grid(Random& random, const Pose& pose) {
  perception::LocalGrid local_grid;
  local_grid.configure(Params{});
  local_grid.reset(pose);
  const int looks = random.index(30);
  for (int i = 0; i < looks; ++i) {
    local_grid.mark(observation(pose, Angle::from_raw(static_cast<std::uint32_t>(random.bits())),
                                millimetres(100 + random.index(300))));
  }
  return local_grid;
}

Pose draw_pose(Random& random) {
  return {{Length::from_raw(random.index(1000000)), Length::from_raw(random.index(1000000))},
          random.chance(0.3) ? Angle::turns(random.index(8), 8)
                             : Angle::from_raw(static_cast<std::uint32_t>(random.bits()))};
}

bool nothing(const perception::Obstacles& found) { return found.unknown == 0 && found.suspect == 0; }

TEST(LocalGrid, AlongCountsWhatIsNotClearOnTheWay) {
  constexpr int kSamples = 150;
  constexpr double kRounding = 0.0006;
  constexpr double kAbeam = 80 * kCell / 256;
  int blocked = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(3000); ++seed) {
    Random random(seed);
    const Pose pose = draw_pose(random);
    const perception::LocalGrid local_grid = draw_local_grid(random, pose);
    const Length length = millimetres(random.index(150));
    const Length radius = millimetres(20 + random.index(90));
    const perception::Obstacles found = local_grid.along(pose.at, pose.heading, length, radius);
    const double heading = radians(pose.heading);
    int surely = 0;
    int perhaps = 0;
    const Cell here = cell_of(pose.at);
    for (int y = here.second - 13; y <= here.second + 13; ++y) {
      for (int x = here.first - 13; x <= here.first + 13; ++x) {
        if (local_grid.is_clear(centre({x, y}))) continue;
        const double dx = metres(centre({x, y}).x) - metres(pose.at.x);
        const double dy = metres(centre({x, y}).y) - metres(pose.at.y);
        const double ahead = dx * std::cos(heading) + dy * std::sin(heading);
        double off = 1;
        for (int i = 0; i <= kSamples; ++i) {
          const double on = metres(length) * i / kSamples;
          off = std::fmin(off, nearest({x, y}, metres(pose.at.x) + on * std::cos(heading),
                                       metres(pose.at.y) + on * std::sin(heading)));
        }
        const double by = std::fmin(metres(radius) - off, ahead - kAbeam);
        if (by > kRounding) ++surely;
        if (by > -kRounding) ++perhaps;
      }
    }
    ASSERT_GE(found.unknown + found.suspect, surely) << "seed " << seed;
    ASSERT_LE(found.unknown + found.suspect, perhaps) << "seed " << seed;
    if (found.unknown > 0) {
      ASSERT_FALSE(local_grid.is_clear(pose.at + found.nearest_unknown)) << "seed " << seed;
    }
    blocked += nothing(found) ? 0 : 1;
  }
  EXPECT_GT(blocked, 300);
  EXPECT_LT(blocked, 2900);
}

/// The centres of the suspect cells, in metres from the body.
std::vector<sim::Vec2> suspects_around(const perception::LocalGrid& local_grid, Vec at) {
  std::vector<sim::Vec2> suspects;
  const Cell here = cell_of(at);
  for (int y = here.second - kAround; y <= here.second + kAround; ++y) {
    for (int x = here.first - kAround; x <= here.first + kAround; ++x) {
      const Vec to = centre({x, y});
      if (local_grid.suspects_along(to - Vec{10_mm, 0_mm}, {}, 10_mm, 1_mm, 1) == 0) continue;
      suspects.push_back({metres(to.x) - metres(at.x), metres(to.y) - metres(at.y)});
    }
  }
  return suspects;
}

/// How far a disc goes in this direction until it meets such a cell: at most if slack > 0, at least if < 0.
double way_of(const std::vector<sim::Vec2>& suspects, double direction, double horizon, double slack) {
  const double cover = metres(cell_cover(Params{}));
  const double radius = metres(reach(Params{}).planning) + cover;
  double way = horizon;
  for (const sim::Vec2& at : suspects) {
    const double along = at.x * std::cos(direction) + at.y * std::sin(direction);
    const double beside = std::fabs(at.y * std::cos(direction) - at.x * std::sin(direction));
    if (along < (slack > 0 ? 80 * kCell / 256 : 0) + slack || beside > radius + cover - slack) continue;
    const double chord = std::sqrt(std::fmax(0, radius * radius - std::pow(std::fmax(0, beside + slack), 2)));
    way = std::fmin(way, std::fmax(0, along + slack - chord));
  }
  return way;
}

TEST(LocalGrid, WaysEndWhereADiscMeetsASuspectCell) {
  constexpr double kRounding = 0.0006;
  int met = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(3000); ++seed) {
    Random random(seed);
    const Pose pose = draw_pose(random);
    perception::LocalGrid local_grid = draw_local_grid(random, pose);
    for (int i = random.index(5); i > 0; --i) {
      const Vec there{millimetres(random.index(700) - 350), millimetres(random.index(700) - 350)};
      local_grid.block(pose.at + there, millimetres(random.index(60)));
    }
    const Length horizon = millimetres(100 + random.index(300));
    const perception::Ways ways = local_grid.ways(pose.at, pose.heading, horizon);
    const std::vector<sim::Vec2> suspects = suspects_around(local_grid, pose.at);
    const double course = radians(pose.heading);
    const auto between = [&](Length found, std::initializer_list<int> degrees) {
      double least = 0, most = 0;
      for (const int off : degrees) {
        const double direction = course + off * 3.14159265358979323846 / 180;
        least = std::fmax(least, way_of(suspects, direction, metres(horizon), -kRounding));
        most = std::fmax(most, way_of(suspects, direction, metres(horizon), kRounding));
      }
      EXPECT_GE(metres(found), least - kRounding) << "seed " << seed;
      EXPECT_LE(metres(found), most + kRounding) << "seed " << seed;
    };
    between(ways.ahead, {0});
    between(ways.left, {30, 60});
    between(ways.right, {-30, -60});
    double nearest = 60, surely = 60;
    for (const sim::Vec2& at : suspects) {
      const double ahead = at.x * std::cos(course) + at.y * std::sin(course);
      if (ahead > -kRounding) nearest = std::fmin(nearest, std::hypot(at.x, at.y));
      if (ahead > kRounding && std::hypot(at.x, at.y) < metres(horizon))
        surely = std::fmin(surely, std::hypot(at.x, at.y));
    }
    EXPECT_GE(metres(ways.nearest), 0.92 * nearest - kRounding) << "seed " << seed;
    EXPECT_LE(metres(ways.nearest), surely + kRounding) << "seed " << seed;
    met += ways.ahead < horizon - 1_mm ? 1 : 0;
  }
  EXPECT_GT(met, 30);
}

TEST(LocalGrid, ApproachesTellsWhatComesNearer) {
  constexpr double kRounding = 0.0005;
  const double kBody = metres(Params{}.body.radius + guard_slack(Params{}));
  int vetoed = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(3000); ++seed) {
    Random random(seed);
    const Pose pose = draw_pose(random);
    const perception::LocalGrid local_grid = draw_local_grid(random, pose);
    const Length step = micrometres(100 + random.index(60000));
    const Length radius = millimetres(50 + random.index(60));
    const double heading = radians(pose.heading);
    const double ahead = std::fmax(80 * kCell / 256, metres(step) / 2);
    bool surely = false;
    bool perhaps = false;
    const Cell here = cell_of(pose.at);
    for (int y = here.second - 13; y <= here.second + 13; ++y) {
      for (int x = here.first - 13; x <= here.first + 13; ++x) {
        if (local_grid.is_clear(centre({x, y}))) continue;
        const double dx = metres(centre({x, y}).x) - metres(pose.at.x);
        const double dy = metres(centre({x, y}).y) - metres(pose.at.y);
        const double off = nearest({x, y}, metres(pose.at.x) + metres(step) * std::cos(heading),
                                   metres(pose.at.y) + metres(step) * std::sin(heading));
        const double by =
            std::fmin(metres(radius) - off, dx * std::cos(heading) + dy * std::sin(heading) - ahead);
        surely = surely || by > kRounding;
        // Of a suspect cell abeam, what the body itself would cover.
        const double covers = std::fmin(kBody - off, dx * std::cos(heading) + dy * std::sin(heading) -
                                                         (metres(step) / 2 - kCellCover * kCell / 256));
        perhaps = perhaps || by > -kRounding || covers > -kRounding;
      }
    }
    const bool answer = local_grid.approaches(pose.at, polar(pose.heading, step), radius);
    ASSERT_TRUE(!surely || answer) << "seed " << seed;
    ASSERT_TRUE(perhaps || !answer) << "seed " << seed;
    vetoed += answer ? 1 : 0;
  }
  EXPECT_GT(vetoed, 300);
  EXPECT_LT(vetoed, 2900);
}

// Seen once, then left behind or turned away from.
TEST(LocalGrid, AClearCellLivesForOneToTwoSpans) {
  const Params params;
  const Length span = derived::kAgeTravel;
  perception::LocalGrid local_grid;
  local_grid.configure(params);
  Pose pose;
  local_grid.reset(pose);
  local_grid.mark(observation(pose, Angle{}, 2_m, false));
  const Vec seen{200_mm, 0_mm};
  ASSERT_TRUE(local_grid.is_clear(seen));
  // Back and forth, so that the body's margin never comes near the cell.
  Length travel{};
  while (travel < span) {
    pose.at.y = pose.at.y == 0_mm ? 10_mm : 0_mm;
    local_grid.move_to(pose);
    travel += 10_mm;
    ASSERT_TRUE(local_grid.is_clear(seen)) << metres(travel);
  }
  while (travel < span * 2) {
    pose.at.y = pose.at.y == 0_mm ? 10_mm : 0_mm;
    local_grid.move_to(pose);
    travel += 10_mm;
  }
  EXPECT_FALSE(local_grid.is_clear(seen));
  EXPECT_TRUE(local_grid.is_clear(pose.at));
}

TEST(LocalGrid, TurningAgesToo) {
  perception::LocalGrid local_grid;
  local_grid.configure(Params{});
  Pose pose;
  local_grid.reset(pose);
  local_grid.mark(observation(pose, Angle{}, 2_m, false));
  const Vec seen{200_mm, 0_mm};
  for (int i = 0; i < 33; ++i) {
    pose.heading += 10_deg;
    local_grid.move_to(pose);
    ASSERT_TRUE(local_grid.is_clear(seen));
  }
  for (int i = 0; i < 40; ++i) {
    pose.heading += 10_deg;
    local_grid.move_to(pose);
  }
  EXPECT_FALSE(local_grid.is_clear(seen));
}

// The ground beside the driven path stays clear for at least a span after the body passed.
TEST(LocalGrid, TheWayBackStaysOpen) {
  const Params params;
  perception::LocalGrid local_grid;
  local_grid.configure(params);
  Pose pose;
  local_grid.reset(pose);
  for (int i = 0; i < 24; ++i) local_grid.mark(observation(pose, 15_deg * i, 2_m, false));
  const Length reach = local_grid.reach().planning;
  while (pose.at.x < 5_m) {
    pose.at.x += 5_mm;
    local_grid.move_to(pose);
    for (int i = -4; i <= 4; ++i) local_grid.mark(observation(pose, 15_deg * i, 2_m, false));
    if (pose.at.x > 300_mm) {
      ASSERT_TRUE(nothing(local_grid.along(pose.at, 180_deg, 100_mm, reach))) << metres(pose.at.x);
    }
  }
}

TEST(LocalGrid, DoubtTakesBackWhatMayBeReachedAndSparesTheBody) {
  const Params params;
  perception::LocalGrid local_grid;
  local_grid.configure(params);
  const Pose pose;
  local_grid.reset(pose);
  const std::set<Cell> under = clear_around(local_grid, pose.at);
  for (int i = 0; i < 24; ++i) local_grid.mark(observation(pose, 15_deg * i, 2_m, false));
  perception::ConeObservation p = observation(pose, Angle{}, 200_mm);
  local_grid.doubt(p, 210_mm);
  EXPECT_TRUE(local_grid.doubting());
  for (const Cell& cell : under) EXPECT_TRUE(local_grid.is_clear(centre(cell)));
  // Lag 50 ms, braking 300 ms, latency 20 ms, two readings 40 ms, a tick 10 ms: 0.42 s at 0.3 m/s.
  for (int mm = 200 - 126 + 25; mm < 290; mm += 5)
    EXPECT_FALSE(local_grid.is_clear({millimetres(mm), 0_mm})) << mm;
  EXPECT_TRUE(local_grid.is_clear({-200_mm, 0_mm}));
  EXPECT_TRUE(local_grid.is_clear({0_mm, 220_mm}));
  // For one second no echo clears ground that near; afterwards it does.
  p.taken = Time::from_raw(900);
  local_grid.mark(p);
  EXPECT_FALSE(local_grid.is_clear({150_mm, 0_mm}));
  p.taken = Time::from_raw(1100);
  local_grid.mark(p);
  EXPECT_TRUE(local_grid.is_clear({150_mm, 0_mm}));
  EXPECT_FALSE(local_grid.doubting());
}

}  // namespace
}  // namespace whisker::test
