// Ground that a chain of readings marks clear is free, and a turn on the spot marks the rim clear.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "host/run/spec.hpp"
#include "host/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/perception/cells.hpp"
#include "tests/perception/cluttered.hpp"

namespace whisker::test {
namespace {

using perception::Beam;
using sim::Vec2;
using worlds::Random;

constexpr double kTurn = 2 * 3.14159265358979323846;
constexpr double kPole = 0.0005;   // m, radius
constexpr double kTouch = 1e-7;    // m, from the body to an obstacle that all but touches it
constexpr int kDisplaced = 299;    // um; rounding to whole micrometres adds less than one
constexpr double kRim = 0.000301;  // m

Vec2 vec(const Vec& v) { return {metres(v.x), metres(v.y)}; }
Vec2 towards(double angle) { return {std::cos(angle), std::sin(angle)}; }
Angle tenths(int n) { return Angle::turns(n, 3600); }

Params draw_any_robot(Random& random) {
  Params p;
  p.body.radius = millimetres(20 + random.index(130));
  p.body.margin = millimetres(random.index(30));
  p.body.track = p.body.radius * 3 / 2;
  p.skirt.cell = millimetres(5 + random.index(36));
  p.thesis.base_step = 100_mm;
  p.thesis.small_step = 50_mm;
  if (random.chance(0.5)) p.wheels.counts_per_metre = 1000000;
  RangefinderParams& r = p.rangefinders;
  const auto cone = [&] { return tenths(20 + random.index(random.chance(0.1) ? 580 : 380)); };
  const auto beside = [&](double low, double high) {
    return Length::from_raw(static_cast<int32_t>(p.body.radius.raw() * random.uniform(low, high)));
  };
  r.max_range = millimetres(500 + random.index(1500));
  r.cone = cone();
  r.side_angle = tenths(50 + random.index(800));
  if (random.chance(0.5)) r.offset = beside(0, 1.3);
  if (random.chance(0.5)) return p;
  for (int i = 0; i < 3; ++i) {
    BeamParams& own = r.beams[i];
    own.x = beside(-0.5, 1.1);
    own.y = beside(-0.8, 0.8);
    own.cone = cone();
    own.angle = direction_of(tenths(600 * (1 - i) + random.index(500) - 250));
  }
  return p;
}

/// A robot that needs chains.
Params draw_robot(Random& random) {
  for (;;) {
    const Params p = draw_any_robot(random);
    if (check(p) == ParamFault::none && rim_sweep(p).needed) return p;
  }
}

/// The pose after a turn and then a straight drive, rad and m.
Pose after(const Pose& pose, double turned, double driven) {
  return {pose.at + polar(pose.heading, Length::from_raw(static_cast<int32_t>(driven * 1e6))),
          pose.heading + Angle::from_raw(static_cast<uint32_t>(std::llround(turned / kTurn * 0x1p32)))};
}

/// The drive during this turn that moves the axis only this far at this distance from the apex, m.
double sway(const Mount& m, const Pose& pose, double turned, Length distance, double moved) {
  const Beam from = perception::beam_of(m, pose);
  const auto moves = [&](double driven) {
    const Beam to = perception::beam_of(m, after(pose, turned, driven));
    return metres(arc(to.axis - from.axis, distance) - across(to.apex - from.apex, to.axis));
  };
  return (moved - moves(0)) / (moves(0.01) - moves(0)) * 0.01;
}

std::vector<Pose> draw_walk(const Params& p, Random& random) {
  const double cone = 2 * radians(mount(p.rangefinders, random.index(3)).half_cone);
  const double longest = metres(p.body.radius) * 0.2;
  const auto any = [&](int32_t limit) {
    return Length::from_raw(static_cast<int32_t>(random.uniform(-limit, limit)));
  };
  std::vector<Pose> walk{{{any(500000), any(500000)}, Angle::from_raw(static_cast<uint32_t>(random.bits()))}};
  const int steps = 4 + random.index(30);
  const bool turns = random.chance(0.9);
  const bool drives = !turns || random.chance(0.6);
  const Mount side = mount(p.rangefinders, 2 * random.index(2));
  // The edges of a side beam hardly move at the rim of the body, but near the apex they do.
  const bool balanced = random.chance(0.4);
  double turn = 0;
  double drive = 0;
  for (int i = 0; i < steps; ++i) {
    if (i == 0 || random.chance(0.1)) {
      turn = turns ? random.uniform(-1.1, 1.1) * cone * (random.chance(0.5) ? 0.5 : 1) : 0;
      drive = drives ? random.uniform(-longest, longest) : 0;
    }
    if (random.chance(0.05)) turn = -turn;
    double turned = turn * (random.chance(0.7) ? 1 : random.uniform(0, 1.2));
    double driven = drive * (random.chance(0.7) ? 1 : random.uniform(0, 1.2));
    if (random.chance(0.1)) turned = random.uniform(-0.01, 0.01);
    if (balanced && random.chance(0.3)) {
      turned = random.uniform(-0.12, 0.12);
      driven = sway(side, walk.back(), turned, rim_sweep(p).radius, random.uniform(-0.0006, 0.0006));
      driven = std::clamp(driven, -longest * 3, longest * 3);
    }
    walk.push_back(after(walk.back(), turned, driven));
  }
  return walk;
}

bool outside(const Params& p, const std::vector<Pose>& walk, Vec2 at, double radius) {
  return std::all_of(walk.begin(), walk.end(), [&](const Pose& pose) {
    const Vec2 off = at - vec(pose.at);
    return std::hypot(off.x, off.y) > metres(rim_sweep(p).radius) + radius;
  });
}

/// Positive to the left of this edge of the beam; side is 1 for its left edge, else -1.
double left_of(const Beam& beam, int side, Vec2 at) {
  return sim::cross(towards(radians(beam.axis) + side * radians(beam.half_cone)), at - vec(beam.apex));
}

/// A point that only one reading sees, although the cone sweeps over it: if that one is wrongly clear, none
/// does.
bool draw_seen_once(const Params& p, const std::vector<Pose>& walk, Vec2& at, Random& random) {
  const int steps = static_cast<int>(walk.size());
  for (int attempt = 0; attempt < 200; ++attempt) {
    const size_t then = static_cast<size_t>(2 + random.index(steps - 2));
    const Mount m = mount(p.rangefinders, random.index(3));
    const int way = random.chance(0.5) ? 1 : -1;
    const Beam past = perception::beam_of(m, walk[then]);
    const size_t middle = random.chance(0.5) ? 1 : 2;
    const Beam seen = perception::beam_of(m, walk[then - middle]);
    const Beam before = perception::beam_of(m, walk[then - (3 - middle)]);
    const double reach = metres(p.body.radius) * random.uniform(0, 2.5);
    at = vec(seen.apex) + towards(radians(seen.axis) + random.uniform(-1, 1) * radians(m.half_cone)) * reach;
    if (way * left_of(past, -way, at) < 0 && way * left_of(before, way, at) > 0 && outside(p, walk, at, 0)) {
      return true;
    }
  }
  return false;
}

/// Where a chain is weakest: near the point behind which two readings see nothing between their cones, and on
/// their edges.
Vec2 draw_point(const Params& p, const std::vector<Pose>& walk, double radius, Random& random) {
  const int steps = static_cast<int>(walk.size());
  const double body = metres(rim_sweep(p).radius);
  Vec2 at;
  if (radius == 0 && random.chance(0.5) && draw_seen_once(p, walk, at, random)) return at;
  for (int attempt = 0; attempt < 30; ++attempt) {
    const int first = random.index(steps);
    const int then = std::min(steps - 1, first + 1 + random.index(4) / 3);
    const Mount m = mount(p.rangefinders, random.index(3));
    const Beam old = perception::beam_of(m, walk[static_cast<size_t>(first)]);
    const Beam now = perception::beam_of(m, walk[static_cast<size_t>(then)]);
    const double half = radians(m.half_cone) * (random.chance(0.5) ? 1 : -1);
    const Vec2 lead = towards(radians(old.axis) + half);
    const Vec2 trail = towards(radians(now.axis) - half);
    const Vec2 apex = vec(now.apex);
    const double sine = std::abs(sim::cross(trail, lead));
    if (sine < 1e-3 || random.chance(0.01)) {
      at = apex + trail * (body * random.uniform(0, 3));
      break;
    }
    const Vec2 gap = apex + trail * (sim::cross(vec(old.apex) - apex, lead) / sim::cross(trail, lead));
    // An obstacle of this radius has no part in either cone if it lies this far behind.
    const double tip = radius / std::sin(std::asin(sine) / 2);
    const double hair = std::pow(10.0, random.uniform(-5, -2)) * (random.chance(0.9) ? 1 : -1);
    const double behind = tip + (random.chance(0.7) ? hair : random.uniform(0, body));
    const Vec2 between = lead + trail;
    const Vec2 back = between * (-1 / std::hypot(between.x, between.y));
    const double aside = random.chance(0.7) ? 0 : random.uniform(-1, 1) * std::tan(std::asin(sine) / 2);
    at = gap + back * behind + Vec2{-back.y, back.x} * (aside * (behind - tip));
    const double ahead = sim::dot(at - apex, between);
    if (ahead > 0 && std::hypot(at.x - apex.x, at.y - apex.y) < 4 * body && outside(p, walk, at, radius))
      break;
  }
  if (random.chance(0.1))
    at = at + towards(random.uniform(0, kTurn)) * std::pow(10.0, random.uniform(-9, -2.5));
  return at;
}

/// The point, or the point near it at which an obstacle of this radius all but touches the body.
Vec2 beside_body(const Params& p, const std::vector<Pose>& walk, Vec2 at, double radius) {
  const double nearest = metres(rim_sweep(p).radius) + radius + kTouch;
  for (int pass = 0; pass < 2; ++pass) {
    for (const Pose& pose : walk) {
      const Vec2 off = at - vec(pose.at);
      const double d = std::hypot(off.x, off.y);
      if (d < nearest && d > 0) at = vec(pose.at) + off * (nearest / d);
    }
  }
  return at;
}

void add_obstacle(Cluttered& world, const Params& p, const std::vector<Pose>& walk, Random& random) {
  Cluttered one;
  const Vec2 body = vec(walk[static_cast<size_t>(random.index(static_cast<int>(walk.size())))].at);
  const int kind = random.index(8);
  const double radius = kind < 2 ? kPole : kind == 2 ? random.uniform(0.001, 0.1) : 0;
  const Vec2 at = beside_body(p, walk, draw_point(p, walk, radius, random), radius);
  if (radius > 0) {
    one.discs.push_back({at, radius});
  } else if (kind < 6) {
    one.segments.push_back({at, at});
  } else if (kind == 6) {
    one.segments.push_back({at, at + (at - body) * random.uniform(0.001, 2)});
  } else {
    one.segments.push_back({at, draw_point(p, walk, 0, random)});
  }
  for (const Pose& pose : walk) {
    if (sim::clearance(one.view(), vec(pose.at), 0, metres(rim_sweep(p).radius)) <= 0) return;
  }
  world.discs.insert(world.discs.end(), one.discs.begin(), one.discs.end());
  world.segments.insert(world.segments.end(), one.segments.begin(), one.segments.end());
}

/// Moves the world so that its first obstacle lies in a corner of a cell, which the chain proves last.
void align(Cluttered& world, std::vector<Pose>& walk, int32_t cell_um, double slack, Random& random) {
  if (world.discs.empty() && world.segments.empty()) return;
  const bool disc = !world.discs.empty();
  const Vec2 at = disc ? world.discs[0].center : world.segments[0].a;
  const double reach = disc ? world.discs[0].radius : 0;
  const auto shift = [&](double x) {
    const double inset = slack - reach + std::pow(10.0, random.uniform(-6, -2.5));
    const double wanted = random.chance(0.5) ? inset : cell_um * 1e-6 - inset;
    const double now = std::fmod(x, cell_um * 1e-6);
    return static_cast<int32_t>(std::lround((wanted - now) * 1e6));
  };
  const Vec by{Length::from_raw(shift(at.x)), Length::from_raw(shift(at.y))};
  for (Pose& pose : walk) pose.at = pose.at + by;
  for (sim::Disc& d : world.discs) d.center = d.center + vec(by);
  for (sim::Segment& s : world.segments) s = {s.a + vec(by), s.b + vec(by)};
}

enum class Fault { none, false_clear, displaced };

/// One beam, from exact readings to the local grid, like Perception.
class Eye {
 public:
  Eye(Fault fault, Random& random) : fault_(fault), random_(random) {}

  void see(perception::ConeObservation seen, const Params& p, perception::LocalGrid& grid,
           perception::LocalGrid& unchained) {
    const Length far = max_range(p.rangefinders, seen.number);
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
  for (std::uint64_t seed = 1; seed <= test::effort(20000, 200000); ++seed) {
    Random random(seed);
    const Params p = draw_robot(random);
    const double cell = metres(patch_cell(p));
    std::vector<Pose> walk = draw_walk(p, random);
    Cluttered world;
    const int obstacles = 1 + random.index(1 + random.index(5));
    for (int i = 0; i < obstacles; ++i) add_obstacle(world, p, walk, random);
    if (random.chance(0.7)) align(world, walk, patch_cell(p).raw(), slack, random);
    if (world.discs.empty() && world.segments.empty()) continue;
    ++worlds_seen;
    const bool aimed = random.chance(0.5);
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
    for_each_clear(grid, at, patch_cell(p).raw(), [&](int column, int row) {
      ++clear;
      const Vec corner{Length::from_raw(column * patch_cell(p).raw()),
                       Length::from_raw(row * patch_cell(p).raw())};
      chained += unchained.is_clear(corner + Vec{patch_cell(p) / 2, patch_cell(p) / 2}) ? 0 : 1;
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
  p.skirt.cell = 13_mm;
  p.thesis.base_step = 100_mm;
  p.thesis.small_step = 50_mm;
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
  const int32_t cell = patch_cell(p).raw();
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
  const double side = metres(patch_cell(p));
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
  for (std::uint64_t seed = 1; seed <= test::effort(2000, 20000); ++seed) {
    Random random(seed);
    Params p = draw_robot(random);
    p.rangefinders.rate_hz = 5 + random.index(96);
    p.conditioning.stale_after = 500_ms;
    bool narrow = false;
    for (int i = 0; i < 3; ++i) narrow = narrow || beam_cone(p.rangefinders, i).raw() < (5_deg).raw();
    // The window reaches 13 cells behind the body.
    const bool within = rim_sweep(p).radius + patch_cell(p) * 4 < patch_cell(p) * 13;
    // A larger cell at the rim reaches below the middle of the body, where no chain begins.
    const bool small = patch_cell(p) * 5 <= rim_sweep(p).radius * 2;
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
