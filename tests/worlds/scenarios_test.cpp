// The hand-made scenarios.
#include <gtest/gtest.h>

#include <filesystem>

#include "host/scenario/load.hpp"
#include "host/scenario/world.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/reach.hpp"

namespace whisker::worlds {
namespace {

TEST(HandMadeScenarios, LoadAndHaveAPath) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WHISKER_SOURCE_DIR "/host/worlds/scenarios")) {
    const Scenario s = load_scenario(entry.path().string());
    EXPECT_TRUE(path_proven(make_world(s), s.start.at, s.goal.at, kPassableRadius)) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 4);
}

}  // namespace
}  // namespace whisker::worlds
