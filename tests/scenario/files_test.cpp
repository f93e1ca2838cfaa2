#include <gmock/gmock.h>

#include "host/scenario/load.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

using testing::HasSubstr;
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

}  // namespace
}  // namespace whisker
