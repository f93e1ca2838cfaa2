#include "host/report/svg.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/report/infinity.hpp"
#include "tests/report/xml.hpp"

namespace whisker::report {
namespace {

using whisker::testing::parse_xml;

std::string text_of(const std::string& escaped) {
  return parse_xml("<t a=\"" + escaped + "\">" + escaped + "</t>").text;
}

TEST(Escape, keeps_markup_and_letters_readable_by_a_parser) {
  const std::string text = "a<b> & \"c\" 'd' \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x90\x80";
  EXPECT_EQ(text_of(escape(text)), text);
}

TEST(Escape, replaces_what_xml_forbids) {
  EXPECT_EQ(escape(std::string_view("a\0b", 3)),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(escape("\x1B"), "\xEF\xBF\xBD");
  EXPECT_EQ(escape("\xC3"), "\xEF\xBF\xBD");                                  // cut short
  EXPECT_EQ(escape("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // overlong
  EXPECT_EQ(escape("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // a surrogate
  EXPECT_EQ(escape("\xEF\xBF\xBF"), "\xEF\xBF\xBD");                          // U+FFFF
}

RC_GTEST_PROP(Escape, turns_any_bytes_into_what_a_parser_reads, (const std::string& bytes)) {
  const std::string once = text_of(escape(bytes));
  // The output is text, so escaping it again changes nothing that a reader sees.
  RC_ASSERT(text_of(escape(once)) == once);
}

TEST(Escape, knows_every_character_of_one_and_two_bytes) {
  for (unsigned code = 0; code < 0x800; ++code) {
    std::string c;
    if (code < 0x80) {
      c = static_cast<char>(code);
    } else {
      c = {static_cast<char>(0xC0U | (code >> 6)), static_cast<char>(0x80U | (code & 0x3FU))};
    }
    const bool forbidden = code < 0x20 && code != 9 && code != 10 && code != 13;
    EXPECT_EQ(parse_xml("<t>" + escape(c) + "</t>").text, forbidden ? "\xEF\xBF\xBD" : c) << "code " << code;
  }
}

TEST(Shortened, counts_characters_and_never_cuts_one) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abcd", 3), "ab\xE2\x80\xA6");
  EXPECT_EQ(shortened("\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9", 3), "\xC3\xA9\xC3\xA9\xE2\x80\xA6");
  EXPECT_EQ(shortened("", 3), "");
}

TEST(Number, is_short_and_never_a_word) {
  EXPECT_EQ(number(1), "1");
  EXPECT_EQ(number(1.50), "1.5");
  EXPECT_EQ(number(-0.001), "0");
  EXPECT_EQ(number(100), "100");
  EXPECT_EQ(number(std::nan("")), "0");
  EXPECT_EQ(number(kInfinity), "0");
  EXPECT_EQ(number(-1e30), "-1000000");
}

RC_GTEST_PROP(Number, lies_within_half_a_hundredth, (int thousandths)) {
  const double x = std::remainder(thousandths / 1000.0, 1e6);
  RC_ASSERT(std::fabs(std::stod(number(x)) - x) <= 0.005 + 1e-9);
}

TEST(Decimals, has_no_negative_zero) {
  EXPECT_EQ(decimals(-0.04, 1), "0.0");
  EXPECT_EQ(decimals(-0.06, 1), "-0.1");
  EXPECT_EQ(decimals(-0.0, 0), "0");
}

}  // namespace
}  // namespace whisker::report
