// Properties in every world: the path is free, no known path is shorter, and symmetries of the world do not
// change its length.
#include "host/lab/paths/shortest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "host/harness/worlds/reach.hpp"
#include "tests/paths/oracle.hpp"

namespace whisker::paths {
namespace {

using sim::Vec2;

constexpr double kRadii[] = {0.05, 0.10, 0.125, 0.16, 0.22};

struct Case {
  World world;
  Vec2 from, to;
  std::string name;
};

std::vector<Case> cases(int count) {
  std::vector<Case> all;
  for (const worlds::Kind kind : worlds::kKinds) {
    for (int seed = 1; seed <= count; ++seed) {
      worlds::Options options;
      options.seed = static_cast<std::uint64_t>(seed);
      if (kind == worlds::Kind::discs && seed % 2 == 0) {
        options.discs = 75;
        options.box = true;
      }
      const Scenario s = worlds::generate(kind, options);
      all.push_back({make_world(s), s.start.at, s.goal.at, s.name});
    }
  }
  return all;
}

/// Discs and walls on the points and lines of a lattice: many touch, are collinear or coincide.
Case lattice(int seed) {
  worlds::Random random(static_cast<std::uint64_t>(seed));
  constexpr int kSide = 6;
  const auto point = [&] { return Vec2{1.0 * random.index(kSide), 1.0 * random.index(kSide)}; };
  const double radii[] = {0.1, 0.25, 0.375, 0.4, 0.5, 0.7, 1.4};
  Case c{{}, {-0.5, -0.5}, {kSide - 0.5, kSide - 0.5}, "lattice " + std::to_string(seed)};
  for (int i = random.index(14); i > 0; --i) c.world.discs.push_back({point(), radii[random.index(7)]});
  for (int i = random.index(14); i > 0; --i) {
    const Vec2 a = point();
    const Vec2 b = random.chance(0.7) ? a + (random.chance(0.5) ? Vec2{1, 0} : Vec2{0, 1}) : point();
    c.world.segments.push_back({a, b});
  }
  if (random.chance(0.3)) c.from = point();
  return c;
}

Vec2 heading_at_end(const Leg& leg) {
  if (leg.turn_rad == 0) return (leg.to - leg.from) * (1 / distance(leg.from, leg.to));
  const Vec2 out = (leg.to - leg.around.center) * ((leg.turn_rad > 0 ? 1 : -1) / leg.around.radius);
  return {-out.y, out.x};
}

Vec2 heading_at_begin(const Leg& leg) {
  return heading_at_end({leg.to, leg.from, leg.around, -leg.turn_rad}) * -1;
}

Vec2 along(const Leg& leg, double share) {
  if (leg.turn_rad == 0) return leg.from + (leg.to - leg.from) * share;
  const Vec2 arm = leg.from - leg.around.center;
  const double angle = leg.turn_rad * share;
  return leg.around.center + Vec2{arm.x * std::cos(angle) - arm.y * std::sin(angle),
                                  arm.x * std::sin(angle) + arm.y * std::cos(angle)};
}

void expect_gone(const Case& c, const Way& way, double radius) {
  double length = 0;
  Vec2 at = c.from;
  for (std::size_t i = 0; i < way.legs.size(); ++i) {
    const Leg& leg = way.legs[i];
    EXPECT_LT(distance(at, leg.from), 1e-9);
    EXPECT_LT(distance(along(leg, 1), leg.to), 1e-8);
    at = leg.to;
    length += length_m(leg);
    if (i > 0 && length_m(leg) > 1e-6 && length_m(way.legs[i - 1]) > 1e-6) {
      const Vec2 kink = heading_at_begin(leg) - heading_at_end(way.legs[i - 1]);
      EXPECT_LT(std::sqrt(sim::dot(kink, kink)), 1e-5) << "leg " << i;
    }
    constexpr int kSamples = 40;
    for (int k = 0; k <= kSamples; ++k) {
      const Vec2 p = along(leg, k / static_cast<double>(kSamples));
      ASSERT_GT(gap(c.world, p), radius - 1e-8) << "leg " << i << " at " << p.x << ", " << p.y;
    }
  }
  if (!way.legs.empty()) {
    EXPECT_LT(distance(at, c.to), 1e-9);
  }
  EXPECT_NEAR(length, way.length_m, 1e-9);
}

TEST(Shortest, CanBeGoneAndIsNotBeatenByAGrid) {
  int compared = 0;
  for (const Case& c : cases(3)) {
    for (const double radius : {0.05, 0.125}) {
      SCOPED_TRACE(c.name + ", radius " + std::to_string(radius));
      const auto way = shortest_way(c.world, c.from, c.to, radius);
      if (way) expect_gone(c, *way, radius);
      const auto other = some_way(c.world, c.from, c.to, radius);
      if (!other) continue;
      ASSERT_TRUE(way);
      EXPECT_LE(way->length_m, *other + 1e-9);
      EXPECT_GE(way->length_m, distance(c.from, c.to) - 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 30);
}

TEST(Shortest, ExistsWhereTheFloodProvesAWayAndNotWhereItRulesOneOut) {
  int proven = 0, ruled_out = 0;
  for (const Case& c : cases(8)) {
    for (const double radius : kRadii) {
      const bool there = shortest_path(c.world, c.from, c.to, radius).has_value();
      const bool yes = worlds::path_proven(c.world, c.from, c.to, radius);
      const bool no = worlds::path_ruled_out(c.world, c.from, c.to, 0, radius);
      EXPECT_TRUE(there || !yes) << c.name << ", radius " << radius;
      EXPECT_FALSE(there && no) << c.name << ", radius " << radius;
      proven += yes ? 1 : 0;
      ruled_out += no ? 1 : 0;
    }
  }
  EXPECT_GT(proven, 100);
  EXPECT_GT(ruled_out, 40);
}

TEST(Shortest, HoldsInALatticeWhereMuchTouches) {
  int ways = 0, compared = 0;
  for (int seed = 1; seed <= 600; ++seed) {
    const Case c = lattice(seed);
    // Gaps of twice the first radius are frequent: that body just fits, the second does not.
    for (const double radius : {0.1, 0.1001}) {
      SCOPED_TRACE(c.name + ", radius " + std::to_string(radius));
      const auto way = shortest_way(c.world, c.from, c.to, radius);
      const auto back = shortest_way(c.world, c.to, c.from, radius);
      ASSERT_EQ(way.has_value(), back.has_value());
      if (way) {
        ++ways;
        expect_gone(c, *way, radius);
        EXPECT_NEAR(way->length_m, back->length_m, 1e-9);
      }
      if (seed > 40) continue;
      const auto other = some_way(c.world, c.from, c.to, radius);
      if (!other) continue;
      ASSERT_TRUE(way);
      EXPECT_LE(way->length_m, *other + 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(ways, 400);
  EXPECT_GT(compared, 40);
}

TEST(Shortest, IsTheSameBackwards) {
  for (const Case& c : cases(20)) {
    const auto there = shortest_path(c.world, c.from, c.to, 0.1);
    const auto back = shortest_path(c.world, c.to, c.from, 0.1);
    ASSERT_EQ(there.has_value(), back.has_value()) << c.name;
    if (there) {
      EXPECT_NEAR(*there, *back, 1e-9) << c.name;
    }
  }
}

TEST(Shortest, GrowsWithTheBody) {
  for (const Case& c : cases(20)) {
    double before = distance(c.from, c.to) - 1e-9;
    bool there = true;
    for (const double radius : kRadii) {
      const auto length = shortest_path(c.world, c.from, c.to, radius);
      EXPECT_FALSE(length && !there) << c.name << ", radius " << radius;
      there = length.has_value();
      if (!length) continue;
      EXPECT_GE(*length, before - 1e-9) << c.name << ", radius " << radius;
      before = *length;
    }
  }
}

TEST(Shortest, IsTheSameInAWorldThatIsTurnedMovedOrMirrored) {
  const auto moved = [](const Case& c, double angle, double mirror) {
    const auto at = [&](Vec2 p) {
      return Vec2{p.x * std::cos(angle) - p.y * std::sin(angle) + 31.7,
                  mirror * (p.x * std::sin(angle) + p.y * std::cos(angle)) - 12.9};
    };
    Case m{{}, at(c.from), at(c.to), c.name};
    for (const sim::Disc& d : c.world.discs) m.world.discs.push_back({at(d.center), d.radius});
    for (const sim::Segment& s : c.world.segments) m.world.segments.push_back({at(s.a), at(s.b)});
    return m;
  };
  for (const Case& c : cases(12)) {
    const auto plain = shortest_path(c.world, c.from, c.to, 0.1);
    for (const double angle : {0.4, 2.1, 1.5707963267948966}) {
      const Case m = moved(c, angle, angle > 2 ? -1 : 1);
      const auto length = shortest_path(m.world, m.from, m.to, 0.1);
      ASSERT_EQ(length.has_value(), plain.has_value()) << c.name << ", " << angle;
      if (plain) {
        EXPECT_NEAR(*length, *plain, 1e-8) << c.name << ", " << angle;
      }
    }
  }
}

TEST(Shortest, OneMoreObstacleMakesNoWayShorter) {
  for (Case c : cases(10)) {
    const auto before = shortest_path(c.world, c.from, c.to, 0.1);
    const Vec2 middle = (c.from + c.to) * 0.5;
    c.world.discs.push_back({middle, 0.2});
    const auto after = shortest_path(c.world, c.from, c.to, 0.1);
    if (!before) {
      EXPECT_FALSE(after) << c.name;
    }
    if (before && after) {
      EXPECT_GE(*after, *before - 1e-9) << c.name;
    }
  }
}

}  // namespace
}  // namespace whisker::paths
