// Each file of bad/ begins with `# expect LINE:COLUMN part of the message`.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "host/scenario/load.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> bad_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(WHISKER_SOURCE_DIR "/tests/scenario/bad")) {
    names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class BadFile : public testing::TestWithParam<std::string> {};

TEST_P(BadFile, IsRefusedInOneLineAtTheRightPlace) {
  const std::string file = WHISKER_SOURCE_DIR "/tests/scenario/bad/" + GetParam() + ".toml";
  std::ifstream in(file);
  std::string hash, expect, place, words;
  in >> hash >> expect >> place >> std::ws;
  std::getline(in, words);
  ASSERT_EQ(expect, "expect");
  ASSERT_FALSE(words.empty());

  const std::string message = message_of<InputError>([&] { load_scenario(file); });
  EXPECT_THAT(message, StartsWith(file + ":" + place + ": "));
  EXPECT_THAT(message, HasSubstr(words));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(Scenario, BadFile, testing::ValuesIn(bad_files()),
                         [](const auto& file) { return file.param; });

TEST(BadFiles, AreMoreThanSixty) { EXPECT_GT(bad_files().size(), 60U); }

}  // namespace
}  // namespace whisker
