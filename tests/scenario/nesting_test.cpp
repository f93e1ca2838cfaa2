// Files that would overflow toml++'s stack are rejected with a message; nesting up to the limit is allowed.
#include <gmock/gmock.h>

#include <string>

#include "host/scenario/load.hpp"
#include "host/scenario/nesting.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

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

}  // namespace
}  // namespace whisker
