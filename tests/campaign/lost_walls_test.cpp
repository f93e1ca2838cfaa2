// Sensors that lose walls at an angle: the side of a disc looks clear until late.
#include <gtest/gtest.h>

#include "host/campaign/mission.hpp"
#include "host/campaign/worlds.hpp"
#include "host/run/planners.hpp"
#include "host/scenario/load.hpp"

namespace whisker::campaign {
namespace {

const std::atomic<bool> kGoesOn{false};

worlds::Options fifty_discs() {
  worlds::Options options;
  options.discs = 50;
  return options;
}

// In these worlds, the flank touched a disc whose side lay beside the cone of a side beam: its first echo had
// come from farther than two radii.
TEST(LostWalls, TheFlankKeepsOffWhatLiesBesideAnEcho) {
  for (const std::uint64_t seed : {UINT64_C(1300138), UINT64_C(1300401)}) {
    Mission m = mission(Generated{worlds::Kind::discs, fifty_discs(), seed}, 0);
    apply_robot_file(m.scenario, WHISKER_SOURCE_DIR "/host/robots/layout-45.toml");
    const Row row = drive(m.scenario, kDefaultPlanner, kGoesOn);
    EXPECT_EQ(row.verdict, Verdict::reached) << m.world << " seed " << seed << ": " << row.detail;
  }
}

}  // namespace
}  // namespace whisker::campaign
