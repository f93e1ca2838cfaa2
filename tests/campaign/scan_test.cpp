
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/harness/run/planners.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/campaign/mission.hpp"
#include "host/lab/campaign/worlds.hpp"
#include "host/lab/scanner/reference_path.hpp"

namespace whisker::campaign {
namespace {

Scenario scenario(worlds::Kind kind, std::uint64_t seed) {
  worlds::Options options;
  options.seed = seed;
  return worlds::generate(kind, options);
}

Row row(worlds::Kind kind, std::uint64_t seed) {
  Row row = scan(scenario(kind, seed));
  row.world = worlds::name(kind);
  return row;
}

TEST(Scan, TheRowTellsOfTheTripOfThisRobotsRange) {
  Scenario s = scenario(worlds::Kind::rooms, 3);
  for (const Length range : {2_m, 500_mm}) {
    s.robot.rangefinders.max_range = range;
    const Row row = scan(s);
    const scanner::ReferencePath reference =
        scanner::drive(make_world(s), s.start.at, s.goal.at, kWayRadius, range.raw() * 1e-6);
    EXPECT_EQ(row.verdict, Verdict::reached);
    EXPECT_EQ(row.seed, 3U);
    EXPECT_NEAR(row.path_m, reference.driven_m, 6e-7);
    EXPECT_NEAR(row.shortest_m.value_or(0), reference.shortest_m.value_or(1), 6e-7);
  }
}

TEST(Scan, ItsSummaryHasNoFigureThatIsNotItsOwn) {
  const Summary s = summarize({row(worlds::Kind::u_trap, 1), row(worlds::Kind::u_trap, 2)});
  const auto json = nlohmann::json::parse(scan_json(s));
  EXPECT_EQ(json["missions"], 2);
  EXPECT_EQ(json["reached"]["value"], 1);
  EXPECT_GE(json["ratio"]["p50"]["value"], 0.999);
  EXPECT_FALSE(json.contains("contact") || json.contains("s_per_m") || json.contains("stops_per_m"));
  const auto all = nlohmann::json::parse(summary_json(s));
  for (const auto& [key, value] : json.items()) EXPECT_EQ(all[key], value) << key;
  EXPECT_EQ(scan_words(s).find("s/m"), std::string::npos);
  EXPECT_NE(scan_words(s).find("u-trap"), std::string::npos);
}

TEST(Scan, AGoalWithoutAWayIsASuccessIfItSaysSo) {
  const Summary s = summarize({row(worlds::Kind::enclosed, 1), row(worlds::Kind::enclosed, 2)});
  EXPECT_EQ(s.success.value, 1);
  EXPECT_FALSE(s.ratio_p50);
}

// Worlds in which the robots of host/robots met what real rangefinders do.

const std::atomic<bool> kGoesOn{false};

Row driven(const char* robot, worlds::Kind kind, const worlds::Options& options, std::uint64_t seed) {
  Mission m = mission(Generated{kind, options, seed}, 0);
  apply_robot_file(m.scenario, std::string(WHISKER_SOURCE_DIR "/host/robots/") + robot);
  return drive(m.scenario, kDefaultPlanner, kGoesOn);
}

// A side beam that loses walls at an angle shows the side of a disc late: its first echo had come from
// farther than two radii, and the flank touched what lay beside the cone.
TEST(LostWalls, TheFlankKeepsOffWhatLiesBesideAnEcho) {
  worlds::Options options;
  options.discs = 50;
  for (const std::uint64_t seed : {UINT64_C(1300138), UINT64_C(1300401)}) {
    const Row row = driven("layout-45.toml", worlds::Kind::discs, options, seed);
    EXPECT_EQ(row.verdict, Verdict::reached) << "seed " << seed << ": " << row.detail;
  }
}

// Echoes that were short by noise took back the ground between the flank and a wall, until no way was left.
TEST(NoisyWalls, AnEchoOfTheWallBesideTheFlankLeavesAWay) {
  worlds::Options options;
  options.noise = true;
  for (const std::uint64_t seed : {UINT64_C(1300334), UINT64_C(1300251)}) {
    const Row row = driven("vl53l1x.toml", worlds::Kind::rooms, options, seed);
    EXPECT_TRUE(says_reached(row.verdict)) << "seed " << seed << ": " << row.detail;
  }
}

}  // namespace
}  // namespace whisker::campaign
