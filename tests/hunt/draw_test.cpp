#include "host/lab/hunt/draw.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>

#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/lab/hunt/geometry.hpp"
#include "host/lab/hunt/premise.hpp"

namespace whisker::hunt {
namespace {

constexpr std::uint64_t kCases = 250;

std::string whole(const Case& c) { return texts(c, "case").toml; }

TEST(Draw, TheSameSeedGivesTheSameCase) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(whole(draw_case(seed).c), whole(draw_case(seed).c)) << seed;
    EXPECT_NE(whole(draw_case(seed).c), whole(draw_case(seed + 1).c)) << seed;
  }
}

TEST(Draw, EveryCaseKeepsThePremiseAndEveryKindIsDrawn) {
  std::set<std::string> families, worlds, drivers;
  std::array<Share, kFamilies> shares;
  for (std::uint64_t seed = 1; seed <= kCases; ++seed) {
    const Drawn drawn = draw_case(seed);
    EXPECT_EQ(check(drawn.c.scenario.robot), ParamFault::none) << seed;
    EXPECT_TRUE(holds_premise(drawn.c.scenario)) << seed;
    EXPECT_TRUE(drawn.c.scenario.movers.empty()) << seed;
    families.insert(name(drawn.robot.family));
    worlds.insert(name(drawn.world));
    drivers.insert(driver(drawn.c));
    shares[static_cast<std::size_t>(drawn.robot.family)].drawn += drawn.robot.families.drawn;
    shares[static_cast<std::size_t>(drawn.robot.family)].accepted += drawn.robot.families.accepted;
  }
  EXPECT_EQ(families.size(), static_cast<std::size_t>(kFamilies));
  EXPECT_EQ(worlds.size(), static_cast<std::size_t>(kWorlds));
  EXPECT_EQ(drivers, (std::set<std::string>{"guard", "map", "skirt", "thesis"}));
  // A family whose draws are nearly always refused would hunt the base robots alone.
  for (int i = 1; i < kFamilies; ++i) {
    const Share share = shares[static_cast<std::size_t>(i)];
    EXPECT_GT(share.accepted * 20, share.drawn) << name(static_cast<Family>(i));
  }
}

/// Except what a user says of the world or of the gyro's error, and what the core does not look at.
TEST(Draw, ReachesEveryKeyAndTheEndsOfMost) {
  const std::vector<ParamEntry> usual = param_list(Params{});
  std::vector<std::set<std::int64_t>> seen(usual.size());
  Dice dice(7);
  for (int i = 0; i < 1000; ++i) {
    Params p;
    change_keys(dice, p, 10);
    const std::vector<ParamEntry> drawn = param_list(p);
    for (std::size_t k = 0; k < drawn.size(); ++k) seen[k].insert(drawn[k].raw);
  }
  std::size_t ends = 0;
  for (std::size_t k = 0; k < usual.size(); ++k) {
    const std::string key = usual[k].key;
    const bool claim =
        key == "straight_walls" || key == "wall_direction_deg" || key == "gyro_scale" || key == "sonar";
    const bool fixed = usual[k].low == usual[k].high;
    EXPECT_EQ(seen[k].size() > 1, !claim && !fixed) << key;
    if (seen[k].count(usual[k].low) + seen[k].count(usual[k].high) > 0) ++ends;
  }
  EXPECT_GT(ends, usual.size() * 2 / 3);
}

TEST(Draw, StartsNearlyTouchAndWorldsLieFarOff) {
  double least = 1, farthest = 0;
  for (std::uint64_t seed = 1; seed <= kCases; ++seed) {
    const Scenario s = draw_case(seed).c.scenario;
    least = std::min(least, nearest(s, s.start.at).distance_m - free_at_start_m(s.robot));
    farthest = std::max(farthest, length(s.start.at));
  }
  EXPECT_GE(least, 0);
  EXPECT_LT(least, 1e-4);
  EXPECT_GT(farthest, 500);
}

TEST(Changed, KeepsThePremiseAndChangesSomething) {
  int changes = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Case before = draw_case(seed).c;
    const Case after = changed(before, ~seed);
    EXPECT_TRUE(holds_premise(after.scenario)) << seed;
    EXPECT_EQ(whole(after), whole(changed(before, ~seed))) << seed;
    if (whole(after) != whole(before)) ++changes;
  }
  EXPECT_GT(changes, 40);
}

TEST(Premise, IsBrokenByANearStartAWorseSensorAndARefusedRobot) {
  Scenario s;
  s.goal.at = {2, 0};
  s.sensor.corner_scatter_m = 1000;
  s.discs = {{{1, 0}, 0.5}};
  EXPECT_TRUE(holds_premise(s));
  Scenario near = s;
  near.discs = {{{0.59, 0}, 0.5}};
  EXPECT_FALSE(holds_premise(near));
  Scenario blind = s;
  blind.sensor.incidence_deg = 89;
  EXPECT_FALSE(holds_premise(blind));
  Scenario narrow = s;
  narrow.sensor.cone_deg = 24;
  EXPECT_FALSE(holds_premise(narrow));
  Scenario refused = s;
  refused.robot.body.track = 1_m;
  EXPECT_FALSE(holds_premise(refused));
  Scenario losing = s;
  losing.robot.rangefinders.incidence = 45_deg;
  losing.sensor.incidence_deg = 45;
  EXPECT_FALSE(holds_premise(losing));
}

}  // namespace
}  // namespace whisker::hunt
