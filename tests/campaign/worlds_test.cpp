#include "host/campaign/worlds.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "host/scenario/error.hpp"
#include "host/scenario/write.hpp"
#include "tests/campaign/rows.hpp"

namespace whisker::campaign {
namespace {

Scenario generated(std::uint64_t seed) {
  worlds::Options options;
  options.seed = seed;
  options.discs = 5;
  return worlds::generate(worlds::Kind::discs, options);
}

TEST(Generated, MissionsHaveOneSeedAfterTheOther) {
  Generated worlds{worlds::Kind::discs, {}, 40};
  worlds.options.discs = 5;
  for (const std::uint64_t i : {0U, 1U, 7U}) {
    const Mission m = mission(worlds, i);
    EXPECT_EQ(m.seed, 40 + i);
    EXPECT_EQ(m.world, "discs --discs 5");
    EXPECT_EQ(to_toml(m.scenario), to_toml(generated(40 + i)));
  }
}

TEST(Generated, TheArgumentsNameEveryOption) {
  worlds::Options options;
  EXPECT_EQ(arguments(worlds::Kind::u_trap, options), "u-trap");
  options = {1, 0, true, true};
  EXPECT_EQ(arguments(worlds::Kind::enclosed, options), "enclosed --discs 0 --box --noise");
  options = {1, {}, false, true, 5e-05};
  EXPECT_EQ(arguments(worlds::Kind::maze, options), "maze --noise --wheel-scale-sigma 5e-05");
}

TEST(FilesOfAFolder, AreItsScenarioFilesInOrderOfName) {
  const Folder folder;
  folder.file("b.toml", to_toml(generated(7)));
  folder.file("a.toml", to_toml(generated(8)));
  folder.file("notes.txt", "no scenario");
  Files files = load_folder(folder.path(""));
  ASSERT_EQ(files.names.size(), 2U);
  EXPECT_EQ(mission(files, 0).seed, 8U);
  EXPECT_EQ(mission(files, 1).seed, 7U) << "its own";
  EXPECT_EQ(mission(files, 1).world, files.names[1]);
  files.first_seed = 100;
  EXPECT_EQ(mission(files, 0).scenario.seed, 100U);
  EXPECT_EQ(mission(files, 3).scenario.seed, 103U);
  EXPECT_EQ(mission(files, 3).world, files.names[1]) << "each file in turn";
}

TEST(FilesOfAFolder, AreRefusedIfAnyIsWrong) {
  const Folder folder;
  EXPECT_THROW(load_folder(folder.path("")), std::invalid_argument) << "none at all";
  folder.file("a.toml", to_toml(generated(8)));
  folder.file("b.toml", "nonsense");
  EXPECT_THROW(load_folder(folder.path("")), InputError);
  folder.file("b.toml", to_toml(generated(8)));
  folder.file("c\n.toml", to_toml(generated(8)));
  EXPECT_THROW(load_folder(folder.path("")), std::invalid_argument);
}

}  // namespace
}  // namespace whisker::campaign
