#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "host/harness/scenario/csv.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/nesting.hpp"
#include "host/harness/scenario/text.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string message_for(const std::string& file) {
  return message_of<InputError>([&] { load_scenario(file); });
}

TEST(ScenarioFile, ThatIsMissingIsReportedInOneLine) {
  EXPECT_EQ(message_for("/nowhere/at/all.toml"),
            "/nowhere/at/all.toml:1:1: cannot open the file: No such file or directory");
}

TEST(ScenarioFile, ThatIsADirectoryIsReportedInOneLine) {
  EXPECT_EQ(message_for("/tmp"), "/tmp:1:1: cannot read the file: Is a directory");
}

TEST(ScenarioFile, WithALineBreakInItsNameIsStillReportedInOneLine) {
  EXPECT_THAT(message_for("no\nwhere"), StartsWith("no?where:1:1: cannot open"));
}

TEST(ScenarioFile, LargerThan16MiBIsRefused) {
  const TemporaryFile file(std::string((16U << 20) + 1, '#'));
  EXPECT_EQ(message_for(file.path()), file.path() + ":1:1: the file is larger than 16 MiB");
}

TEST(ScenarioFile, OfExactly16MiBIsRead) {
  const TemporaryFile file(std::string(16U << 20, '#'));
  EXPECT_THAT(message_for(file.path()), HasSubstr("[start] is missing"));
}

TEST(ScenarioFile, WithoutAnEndIsRefusedAtTheSizeLimit) {
  EXPECT_EQ(message_for("/dev/zero"), "/dev/zero:1:1: the file is larger than 16 MiB");
}

TEST(ScenarioFile, ThatNestsTooDeeplyIsRefusedAndDoesNotOverflowTheStack) {
  const TemporaryFile file("name = " + std::string(100000, '['));
  EXPECT_THAT(message_for(file.path()), StartsWith(file.path() + ":1:"));
}

TEST(ScenarioFile, WithAByteOrderMarkIsRead) {
  const TemporaryFile file(
      "\xEF\xBB\xBFname = \"bom\"\n[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 1\ny_m = 0\n");
  EXPECT_EQ(load_scenario(file.path()).name, "bom");
}

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

// Files that would overflow toml++'s stack are rejected with a message; nesting up to the limit is allowed.

std::string many(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { parse_scenario(text, "f"); });
}

TEST(Nesting, OfKeysArraysAndInlineTablesEndsInWords) {
  constexpr int kTimes = 50000;
  const std::string keys = "f:1:16: a key has more than 8 parts";
  const std::string values = "f:1:13: values are nested more than 8 deep";
  EXPECT_EQ(refusal(many("a.", kTimes) + "a = 1\n"), keys);
  EXPECT_EQ(refusal("[" + many("a.", kTimes) + "a]\n"), "f:1:17: a key has more than 8 parts");
  EXPECT_EQ(refusal(many("a . ", kTimes) + "a = 1\n"), "f:1:31: a key has more than 8 parts");
  EXPECT_EQ(refusal(many("\"a\".", kTimes) + "a = 1\n"), "f:1:32: a key has more than 8 parts");
  EXPECT_EQ(refusal("x = " + many("[", kTimes)), values);
  EXPECT_EQ(refusal("x = " + many("[", kTimes) + many("]", kTimes)), values);
  EXPECT_EQ(refusal("x = " + many("[\n", kTimes)), "f:9:1: values are nested more than 8 deep");
  EXPECT_EQ(refusal("x = " + many("{a = ", kTimes)), "f:1:45: values are nested more than 8 deep");
}

TEST(Nesting, OfSmallFilesIsLeftToTheParser) {
  const auto accepts = [](const std::string& text) { EXPECT_NO_THROW(check_nesting(text, "f")) << text; };
  accepts("a.b.c.d.e.f.g.h = [[[[[[[[1.5, 2.5]]]]]]]]\n");
  accepts(many("x = 1.5\n", 1000));
  accepts("x = [" + many("1.5, ", 1000) + "]\n");
  accepts("x = [" + many("[1.5, 2.5], ", 1000) + "]\n");
  accepts("# " + many("a.[{", 1000) + "\nx = 1\n");
  accepts("x = \"" + many("a.[{", 1000) + "\"\n");
  accepts("x = \"\\\"" + many("a.[{", 1000) + "\"\n");
  accepts("x = '" + many("a.[{\\", 1000) + "'\n");
  accepts("x = \"\"\"" + many("a.[{\n", 1000) + "\"\"\"\n");
  accepts(many("[not closed\n", 1000));
}

TEST(ScenarioFile, InUtf16IsRefusedByItsName) {
  const TemporaryFile file(std::string("\xFF\xFE[\0", 4));
  EXPECT_EQ(message_for(file.path()), file.path() + ":1:1: the text is UTF-16; save it as UTF-8");
}

/// The numbers of the columns a and b, row by row, or what is wrong.
std::string numbers_of(const std::string& text) {
  std::istringstream in(text);
  try {
    CsvReader csv(in, "x.csv");
    const std::size_t a = csv.need("a"), b = csv.need("b");
    std::string all;
    while (csv.next()) {
      const double first = csv.number(a);
      all += toml_number(first) + " " + toml_number(csv.number(b)) + " ";
    }
    return all;
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(Csv, IsReadAsSpreadsheetsWriteIt) {
  for (const char* text : {"a,b\n0.5,-1e3\n",
                           "\xEF\xBB\xBF"
                           "a,b\r\n0.5,-1e3\r\n",
                           "a;b\n0,5;-1000\n", "a;b\n0.5;-1000\n", " b , note, a \n-1000,  x, 0.5 \n",
                           "\"a\",\"b\"\n\"0,5\",-1000\n", "a,b\n\n  \n0.5,-1000"}) {
    EXPECT_EQ(numbers_of(text), "0.5 -1000.0 ") << text;
  }
}

TEST(Csv, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(numbers_of(""), "x.csv:1:1: the file is empty");
  EXPECT_EQ(numbers_of("\xFE\xFF"), "x.csv:1:1: the text is UTF-16; save it as UTF-8");
  EXPECT_EQ(numbers_of("a;c\n"), "x.csv:1:1: no column 'b' in the header");
  EXPECT_EQ(numbers_of("a,b\n\n0,5,1\n"), "x.csv:3:1: 3 fields; the header has 2");
  EXPECT_EQ(numbers_of("a,b\n1,nan\n"), "x.csv:2:2: 'nan' is no number");
  EXPECT_EQ(numbers_of("a,b\n-inf,1\n"), "x.csv:2:1: '-inf' is no number");
  EXPECT_EQ(numbers_of("a,b\n1,1e10\n"), "x.csv:2:2: '1e10' must be from -1e+09 to 1e+09");
  EXPECT_EQ(numbers_of("a;b\n1.234,5;1\n"), "x.csv:2:1: '1.234,5' is no number");
  EXPECT_EQ(numbers_of("a;b\n0,5;1.234\n"),
            "x.csv:2:2: '1.234': other numbers of this file have ',' before their decimals");
  EXPECT_EQ(numbers_of("a,b\n" + std::string(70000, '1')), "x.csv:2:1: a line of more than 65536 bytes");
  std::ifstream folder("/tmp");
  EXPECT_EQ(message_of<InputError>([&] { CsvReader(folder, "/tmp"); }), "/tmp:1:1: cannot read the file");
}

TEST(TomlNumber, IsTheShortestFloatThatReadsBack) {
  EXPECT_EQ(toml_number(0.1), "0.1");
  EXPECT_EQ(toml_number(4), "4.0");
  EXPECT_EQ(toml_number(-0.0), "-0.0");
  EXPECT_EQ(toml_number(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(toml_number(1e-7), "1e-07");
}

TEST(TomlString, EscapesWhatTomlForbids) {
  EXPECT_EQ(toml_string("a\"b\\c\nd\x7F"), R"("a\"b\\c\u000Ad\u007F")");
  EXPECT_EQ(toml_string("10 \xC2\xB5m"), "\"10 \xC2\xB5m\"");
}

TEST(NearestWord, ForgivesSlipsButDoesNotGuess) {
  const std::vector<std::string_view> known{"center", "radius_m", "seed"};
  EXPECT_EQ(nearest_word("centre", known), "center");
  EXPECT_EQ(nearest_word("radius", known), "radius_m");
  EXPECT_EQ(nearest_word("radius_mm", known), "radius_m");
  EXPECT_EQ(nearest_word("sed", known), "seed");
  EXPECT_EQ(nearest_word("weather", known), "");
  EXPECT_EQ(nearest_word("", known), "");
}

TEST(JoinOr, ReadsAsASentence) {
  EXPECT_EQ(join_or({"a"}), "a");
  EXPECT_EQ(join_or({"a", "b"}), "a or b");
  EXPECT_EQ(join_or({"a", "b", "c"}), "a, b or c");
}

}  // namespace
}  // namespace whisker
