// Ground that a chain of readings marks clear is free, and a turn on the spot marks the rim clear.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "host/harness/run/spec.hpp"
#include "tests/effort.hpp"
#include "tests/perception/cells.hpp"
#include "tests/perception/chain_worlds.hpp"
#include "tests/perception/cluttered.hpp"

namespace whisker::test {
namespace {

using sim::Vec2;
using worlds::Random;

constexpr double kTurn = 2 * 3.14159265358979323846;
constexpr int kDisplaced = 299;    // um; rounding to whole micrometres adds less than one
constexpr double kRim = 0.000301;  // m

enum class Fault { none, false_clear, displaced };

/// One beam, from exact readings to the local grid, like Perception.
class Eye {
 public:
  Eye(Fault fault, Random& random) : fault_(fault), random_(random) {}

  void see(perception::ConeObservation seen, const Params& p, perception::LocalGrid& grid,
           perception::LocalGrid& unchained) {
    const Length far = p.rangefinders.max_range;
    bool clear = !seen.hit;
    if (fault_ == Fault::false_clear) {
      ++since_;
      const bool new_one = seen.hit && seen.free + 5_mm < last_four_[0];
      if (seen.hit && since_ >= 5 && random_.chance(new_one ? 0.7 : 1.0 / 7)) {
        since_ = 0;
        seen.free = far;
        clear = true;
      }
      std::rotate(last_four_, last_four_ + 3, last_four_ + 4);
      last_four_[0] = seen.free;
      if (++count_ < 4) return;
      seen.free = *std::min_element(last_four_, last_four_ + 4);
      seen.hit = seen.free < far;
    }
    const perception::EarlierObservation* const before = clear ? &last_ : nullptr;
    if (!clear || seen_) {
      grid.mark(seen, before);
      unchained.mark(seen, before);
      grid.chain(seen, before);
    }
    last_ = {seen.beam.apex, seen.beam.axis, seen.free};
    seen_ = true;
  }

 private:
  Fault fault_;
  Random& random_;
  Length last_four_[4];
  int count_ = 0;
  int since_ = 5;
  bool seen_ = false;
  perception::EarlierObservation last_;
};

/// The pose that odometry believes.
Pose believed(const Params& p, Pose pose, int beam, bool odd, bool aimed, Fault fault, Random& random) {
  if (fault != Fault::displaced) return pose;
  // Across the axis, and to the other side at every other reading: both edges of a gap then err.
  const Angle across = pose.heading + mount(p.rangefinders, beam).axis + (odd ? 90_deg : 270_deg);
  const Angle any = Angle::from_raw(static_cast<uint32_t>(random.bits()));
  pose.at = pose.at + polar(aimed ? across : any, micrometres(kDisplaced));
  return pose;
}

void search(Fault fault) {
  const double slack = fault == Fault::displaced ? kRim : 0;
  int worlds_seen = 0;
  int clear = 0;
  int chained = 0;
  int unsound = 0;
  std::uint64_t first_unsound = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(3334, 200000); ++seed) {
    Random random(seed);
    const Params p = draw_robot(random);
    const double cell = metres(grid_cell(p));
    std::vector<Pose> walk = draw_walk(p, random);
    Cluttered world;
    const int obstacles = 1 + random.index(1 + random.index(5));
    for (int i = 0; i < obstacles; ++i) add_obstacle(world, p, walk, fault == Fault::false_clear, random);
    if (random.chance(0.7)) align(world, walk, grid_cell(p).raw(), slack, random);
    if (world.discs.empty() && world.segments.empty()) continue;
    ++worlds_seen;
    const bool aimed = random.chance(0.8);
    const bool late = random.chance(0.3);
    perception::LocalGrid grid;
    perception::LocalGrid unchained;
    for (perception::LocalGrid* g : {&grid, &unchained}) {
      g->configure(p);
      g->reset(walk.front());
    }
    Eye eyes[] = {{fault, random}, {fault, random}, {fault, random}};
    Pose at = walk.front();
    Time now;
    for (size_t i = 0; i < walk.size(); ++i) {
      const size_t here = late && i + 1 < walk.size() ? i + 1 : i;
      at = believed(p, walk[here], random.index(3), i % 2 != 0, aimed, fault, random);
      grid.move_to(at);
      unchained.move_to(at);
      for (int beam = 0; beam < 3; ++beam) {
        perception::ConeObservation seen = look(p, world, walk[i], beam);
        seen.beam = perception::beam_of(mount(p.rangefinders, beam),
                                        believed(p, walk[i], beam, i % 2 != 0, aimed, fault, random));
        seen.taken = now;
        eyes[beam].see(seen, p, grid, unchained);
      }
      now = now + milliseconds(random.chance(0.02) ? 460 : 50);
    }
    bool hidden = false;
    for_each_clear(grid, at, grid_cell(p).raw(), [&](int column, int row) {
      ++clear;
      const Vec corner{Length::from_raw(column * grid_cell(p).raw()),
                       Length::from_raw(row * grid_cell(p).raw())};
      chained += unchained.is_clear(corner + Vec{grid_cell(p) / 2, grid_cell(p) / 2}) ? 0 : 1;
      hidden = hidden || occupied(square(column, row, cell, slack), world.view(), Shift{});
    });
    if (hidden && unsound++ == 0) first_unsound = seed;
  }
  std::printf("%d worlds, %d clear cells, %d of them by chains only\n", worlds_seen, clear, chained);
  EXPECT_EQ(unsound, 0) << "worlds; the first has the seed " << first_unsound;
  EXPECT_GT(worlds_seen, static_cast<int>(test::effort(10000)));
  EXPECT_GT(chained / worlds_seen, 2);
}

// Each of two readings has one edge that is farther: the second has the farther apex, the first the farther
// axis. The first one alone sees a point, and is wrongly clear.
TEST(ChainSoundness, AFalseClearReadingIsNoEvidenceWhileTheBodySways) {
  Params p;
  p.body.radius = 66_mm;
  p.body.track = 100_mm;
  p.rangefinders.max_range = 1052_mm;
  p.rangefinders.cone = tenths(363);
  p.rangefinders.side_angle = tenths(484);
  p.rangefinders.offset = micrometres(66411);
  ASSERT_EQ(check(p), ParamFault::none);
  const auto at = [](int x_um, int y_um, int tenths_of_degree) {
    return Pose{{micrometres(x_um), micrometres(y_um)}, tenths(tenths_of_degree)};
  };
  const Pose walk[] = {at(-7000, -279000, 1096), at(-7000, -279000, 1151), at(2000, -301000, 1219),
                       at(2000, -301000, 1350),  at(-6905, -292137, 1309), at(-6905, -292137, 1441)};
  Cluttered world;
  const Vec2 hidden{-0.109340994, -0.302721114};
  const Vec2 seen_last{-0.191402806, -0.328560476};
  world.segments = {{hidden, hidden}, {seen_last, seen_last}};
  perception::LocalGrid grid;
  grid.configure(p);
  grid.reset(walk[0]);
  for (int i = 1; i < 4; ++i) grid.move_to(walk[i]);
  const perception::ConeObservation wrong = look(p, world, walk[3], 0);
  ASSERT_TRUE(wrong.hit);
  const perception::EarlierObservation before{wrong.beam.apex, wrong.beam.axis, p.rangefinders.max_range};
  for (int i = 4; i < 6; ++i) {
    grid.move_to(walk[i]);
    const perception::ConeObservation seen = look(p, world, walk[i], 0);
    ASSERT_EQ(seen.hit, i == 5);
    grid.mark(seen, seen.hit ? nullptr : &before);
    grid.chain(seen, seen.hit ? nullptr : &before);
  }
  EXPECT_FALSE(grid.is_clear({micrometres(-109341), micrometres(-302721)}));
}

/// Cells that touch the ring between the body and two cells beyond the swept radius, and are not clear after
/// a turn on the spot with nothing in range.
int left_over(const Params& p, Random& random) {
  const int32_t cell = grid_cell(p).raw();
  Pose pose{{Length::from_raw(random.index(cell)), Length::from_raw(random.index(cell))},
            Angle::from_raw(static_cast<uint32_t>(random.bits()))};
  perception::LocalGrid grid;
  perception::LocalGrid unchained;
  grid.configure(p);
  grid.reset(pose);
  unchained.configure(p);
  Eye eyes[] = {{Fault::none, random}, {Fault::none, random}, {Fault::none, random}};
  const double step = turn_rate(p).raw() * 1e-6 / p.rangefinders.rate_hz * (random.chance(0.5) ? 1 : -1);
  Time now;
  for (double turned = 0; turned < 1.25 * kTurn; turned += std::abs(step)) {
    pose = after(pose, step, 0);
    grid.move_to(pose);
    for (int beam = 0; beam < 3; ++beam) {
      perception::ConeObservation seen = look(p, Cluttered{}, pose, beam);
      seen.taken = now;
      eyes[beam].see(seen, p, grid, unchained);
    }
    now = now + milliseconds(1000 / p.rangefinders.rate_hz);
  }
  const double side = metres(grid_cell(p));
  const double outer = metres(rim_sweep(p).radius) + 2 * side;
  const int reach = static_cast<int>(outer / side) + 2;
  int missed = 0;
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const Vec centre{Length::from_raw(column * cell + cell / 2), Length::from_raw(row * cell + cell / 2)};
      if (!touches(square(column, row, side), sim::Disc{vec(pose.at), outer})) continue;
      missed += grid.is_clear(centre) ? 0 : 1;
    }
  }
  return missed;
}

TEST(ChainReach, ATurnOnTheSpotClearsTheRim) {
  int robots = 0;
  int incomplete = 0;
  std::uint64_t first = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(334, 20000); ++seed) {
    Random random(seed);
    Params p = draw_robot(random);
    p.rangefinders.rate_hz = 5 + random.index(96);
    p.conditioning.stale_after = 500_ms;
    bool narrow = false;
    for (int i = 0; i < 3; ++i) narrow = narrow || beam_cone(p.rangefinders, i).raw() < (5_deg).raw();
    // The window reaches 13 cells behind the body.
    const bool within = rim_sweep(p).radius + grid_cell(p) * 4 < grid_cell(p) * 13;
    // A larger cell at the rim reaches below the middle of the body, where no chain begins.
    const bool small = grid_cell(p) * 5 <= rim_sweep(p).radius * 2;
    if (narrow || !within || !small || check(p) != ParamFault::none) continue;
    ++robots;
    const int missed = left_over(p, random);
    if (missed > 0 && incomplete++ == 0) first = seed;
  }
  std::printf("%d robots\n", robots);
  EXPECT_EQ(incomplete, 0) << "robots; the first has the seed " << first;
  EXPECT_GT(robots, static_cast<int>(test::effort(500)));
}

TEST(ChainSoundness, ExactReadings) { search(Fault::none); }
TEST(ChainSoundness, FalseClears) { search(Fault::false_clear); }
TEST(ChainSoundness, DisplacedPoses) { search(Fault::displaced); }

}  // namespace
}  // namespace whisker::test
