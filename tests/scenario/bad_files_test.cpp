#include <gmock/gmock.h>

#include <fstream>

#include "host/scenario/load.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kMission = "name = \"bad\"\n[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 4\ny_m = 1\n";
constexpr const char* kEvent = "[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 1.0\ny_m = 0.0\n[[event]]\n";

struct BadText {
  std::string name, place, words, text;
};
void PrintTo(const BadText& bad, std::ostream* out) { *out << bad.text; }

std::string unescaped(const std::string& line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char next = line[i] == '\\' ? line.at(++i) : '\0';
    if (next == 'x')
      text += static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16)), i += 2;
    else
      text += next == 'n' ? '\n' : line[i];
  }
  return text;
}

std::string text_of(const std::string& line) {
  if (line.rfind("@mission ", 0) == 0) return kMission + unescaped(line.substr(9));
  if (line.rfind("@event ", 0) == 0) return kEvent + unescaped(line.substr(7));
  return unescaped(line);
}

std::vector<BadText> bad_texts() {
  std::vector<BadText> all;
  std::ifstream in(WHISKER_SOURCE_DIR "/tests/scenario/bad.txt");
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '#') continue;
    const std::size_t message = line.find(" | "), words = line.find(' ', message + 3),
                      text = line.find(" | ", words);
    all.push_back({line.substr(0, message), line.substr(message + 3, words - message - 3),
                   line.substr(words + 1, text - words - 1), text_of(line.substr(text + 3))});
  }
  return all;
}

class BadFile : public testing::TestWithParam<BadText> {};

TEST_P(BadFile, IsRefusedInOneLineAtTheRightPlace) {
  ASSERT_FALSE(GetParam().words.empty());
  const TemporaryFile file(GetParam().text);
  const std::string message = message_of<InputError>([&] { load_scenario(file.path()); });
  EXPECT_THAT(message, StartsWith(file.path() + ":" + GetParam().place + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().words));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(Scenario, BadFile, testing::ValuesIn(bad_texts()),
                         [](const auto& file) { return file.param.name; });

TEST(BadFiles, AreMoreThanOneHundredFifty) { EXPECT_GT(bad_texts().size(), 150U); }

}  // namespace
}  // namespace whisker
