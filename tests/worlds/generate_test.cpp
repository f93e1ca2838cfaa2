#include "host/harness/worlds/generate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "host/harness/scenario/contact.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/world.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/harness/worlds/reach.hpp"

namespace whisker::worlds {
namespace {

/// A large world takes long.
constexpr std::uint64_t seeds(Kind kind) { return kind == Kind::contest_maze ? 4 : 60; }

class EveryKind : public testing::TestWithParam<Kind> {};

TEST_P(EveryKind, LoadsAgainFromItsFile) {
  for (std::uint64_t seed = 0; seed < seeds(GetParam()); ++seed) {
    const std::string text = to_toml(generate(GetParam(), {seed, {}, false, seed % 2 == 0}));
    EXPECT_EQ(to_toml(parse_scenario(text, "world")), text);
  }
}

TEST_P(EveryKind, BeginsFreeAndKeepsItsPromise) {
  for (std::uint64_t seed = 0; seed < seeds(GetParam()); ++seed) {
    const Scenario s = generate(GetParam(), {seed, {}, false, false});
    const World world = make_world(s);
    EXPECT_EQ(start_fault(s), "") << seed;
    if (has_no_way(GetParam())) {
      EXPECT_FALSE(path_proven(world, s.start.at, s.goal.at, kShutRadius)) << seed;
      EXPECT_TRUE(path_ruled_out(world, s.start.at, s.goal.at, s.goal.tolerance_m, kShutRadius)) << seed;
    } else {
      EXPECT_GE(nearest_obstacle(s, s.start.at).distance_m, kPassableRadius) << seed;
      EXPECT_GE(nearest_obstacle(s, s.goal.at).distance_m, kPassableRadius) << seed;
      EXPECT_TRUE(path_proven(world, s.start.at, s.goal.at, kPassableRadius)) << seed;
      EXPECT_FALSE(path_ruled_out(world, s.start.at, s.goal.at, s.goal.tolerance_m, kPassableRadius)) << seed;
    }
  }
}

TEST_P(EveryKind, IsTheSameForTheSameSeedAndAnotherForAnother) {
  std::set<std::string> texts;
  for (std::uint64_t seed = 0; seed < seeds(GetParam()); ++seed) {
    Scenario s = generate(GetParam(), {seed, {}, false, false});
    EXPECT_EQ(to_toml(s), to_toml(generate(GetParam(), {seed, {}, false, false})));
    s.name.clear();
    s.seed = 0;
    texts.insert(to_toml(s));
  }
  EXPECT_EQ(texts.size(), seeds(GetParam()));
}

TEST_P(EveryKind, SaysItsKindAndSeedInItsName) {
  EXPECT_EQ(generate(GetParam(), {42, {}, false, false}).name, std::string(name(GetParam())) + ", seed 42");
  EXPECT_EQ(kind_named(name(GetParam())), GetParam());
}

TEST_P(EveryKind, HasTheReferenceNoiseOnlyIfAsked) {
  const Scenario quiet = generate(GetParam(), {3, {}, false, false});
  Scenario noisy = generate(GetParam(), {3, {}, false, true});
  EXPECT_EQ(noisy.noise.range_sigma_m, 0.01);
  EXPECT_EQ(noisy.noise.range_dropout, 0.02);
  EXPECT_EQ(noisy.noise.range_false_clear, 0.01);
  EXPECT_EQ(noisy.noise.wheel_scale_sigma, 0.0001);
  EXPECT_EQ(noisy.noise.heading_drift_deg_per_sqrt_m, 0.3);
  EXPECT_EQ(generate(GetParam(), {3, {}, false, true, 0.01}).noise.wheel_scale_sigma, 0.01);
  noisy.noise = {};
  noisy.name = quiet.name;
  EXPECT_EQ(to_toml(noisy), to_toml(quiet));
}

INSTANTIATE_TEST_SUITE_P(Worlds, EveryKind, testing::ValuesIn(kAllKinds), [](const auto& kind) {
  std::string words = name(kind.param);
  for (char& c : words) c = c == '-' ? '_' : c;
  return words;
});

TEST(Generate, RefusesOptionsThatAKindDoesNotTake) {
  EXPECT_THROW(generate(Kind::maze, {1, 5, false, false}), std::invalid_argument);
  EXPECT_THROW(generate(Kind::u_trap, {1, {}, true, false}), std::invalid_argument);
  EXPECT_THROW(generate(Kind::rooms, {1, {}, true, false}), std::invalid_argument);
  EXPECT_THROW(generate(Kind::enclosed_at_wall, {1, {}, true, false}), std::invalid_argument);
  EXPECT_THROW(generate(Kind::contest_maze, {1, 5, false, false}), std::invalid_argument);
  EXPECT_THROW(generate(Kind::discs, {1, -1, false, false}), std::invalid_argument);
  EXPECT_THROW(generate(Kind::discs, {1, 201, false, false}), std::invalid_argument);
  EXPECT_THROW(generate(Kind::discs, {std::uint64_t{1} << 63, {}, false, false}), std::invalid_argument);
}

TEST(Generate, RefusesAScaleErrorThatIsNoneOrWithoutNoise) {
  EXPECT_NO_THROW(generate(Kind::discs, {1, {}, false, true, 0.0}));
  EXPECT_THROW(generate(Kind::discs, {1, {}, false, false, 0.0}), std::invalid_argument);
  for (const double sigma : {-1e-9, 1.001, std::nan("")}) {
    EXPECT_THROW(generate(Kind::discs, {1, {}, false, true, sigma}), std::invalid_argument) << sigma;
  }
}

TEST(Generate, RefusesAWidthOutOfRangeOrWithoutAGap) {
  Options o;
  o.gap_m = kGapMin;
  EXPECT_NO_THROW(generate(Kind::gap, o));
  EXPECT_THROW(generate(Kind::gap_at_wall, o), std::invalid_argument);
  for (const double width : {0.0, kGapMin - 0.001, kGapMax + 0.001, std::nan("")}) {
    o.gap_m = width;
    EXPECT_THROW(generate(Kind::disc_gap, o), std::invalid_argument) << width;
  }
}

TEST(Generate, GivesUpAloudWhereNoWorldHasAPath) {
  EXPECT_THROW(generate(Kind::discs, {1, 200, true, false}), std::runtime_error);
}

TEST(Generate, TakesTheLargestSeed) {
  const std::uint64_t seed = (std::uint64_t{1} << 63) - 1;
  EXPECT_EQ(parse_scenario(to_toml(generate(Kind::discs, {seed, {}, false, false})), "world").seed, seed);
}

TEST(KindNamed, KnowsNoOtherNames) {
  EXPECT_FALSE(kind_named("u_trap").has_value());
  EXPECT_FALSE(kind_named("").has_value());
}

}  // namespace
}  // namespace whisker::worlds
