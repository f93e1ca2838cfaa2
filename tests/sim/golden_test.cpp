#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>

#include "tests/sim/scripted_drive.hpp"

namespace whisker::sim {
namespace {

// golden.txt: one seed and its hash per line. A change there changes every simulated run, so it must be
// intended.
TEST(Golden, TheScriptedDriveComesOutTheSameEverywhere) {
  std::ifstream golden(std::filesystem::path(WHISKER_SOURCE_DIR) / "tests/sim/golden.txt");
  std::uint64_t seed = 0, hash = 0;
  int lines = 0;
  while (golden >> std::dec >> seed >> std::hex >> hash) {
    EXPECT_EQ(scripted_drive(seed), hash)
        << "seed " << seed << std::hex << " gives 0x" << scripted_drive(seed);
    ++lines;
  }
  EXPECT_EQ(lines, 2);
}

TEST(Golden, TheSameSeedGivesTheSameBits) { EXPECT_EQ(scripted_drive(77), scripted_drive(77)); }

TEST(Golden, AnotherSeedGivesOtherBits) { EXPECT_NE(scripted_drive(77), scripted_drive(78)); }

}  // namespace
}  // namespace whisker::sim
