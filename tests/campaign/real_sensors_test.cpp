// Worlds in which the robots of host/robots met what real rangefinders do.
#include <gtest/gtest.h>

#include "host/campaign/mission.hpp"
#include "host/campaign/worlds.hpp"
#include "host/run/planners.hpp"
#include "host/scenario/load.hpp"

namespace whisker::campaign {
namespace {

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
  for (const std::uint64_t seed : {UINT64_C(1300250), UINT64_C(1300334)}) {
    const Row row = driven("vl53l1x.toml", worlds::Kind::rooms, options, seed);
    EXPECT_TRUE(says_reached(row.verdict)) << "seed " << seed << ": " << row.detail;
  }
}

}  // namespace
}  // namespace whisker::campaign
