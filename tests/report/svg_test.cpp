#include "host/lab/report/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/lab/report/layout_svg.hpp"
#include "tests/report/infinity.hpp"
#include "tests/report/xml.hpp"

namespace whisker::report {
namespace {

using testing::Element;
using testing::parse_xml;

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

LayoutChart chart() {
  LayoutChart c;
  c.title = "Where to mount <three> sensors";
  c.subtitle = "8 missions a point";
  c.rule_angle_deg = 42.5;
  c.margin_deg = 5;
  c.lines = {{"offset 0 m",
              {{30, 0.5, 20, true, false}, {40, 1, std::nullopt, false, false}, {50, 1, 10, false, true}}},
             {"offset 0.08 m", {{30, 0.25, 40, false, false}, {50, 0.75, 30, false, false}}}};
  return c;
}

double x_of(const Element& frame, double angle) {
  return frame.number("x") + (angle - 27.5) / 25 * frame.number("width");
}

TEST(LayoutSvg, IsWellFormedWithPlainCoordinatesAndALegend) {
  const std::string text = layout_svg(chart());
  const Element root = parse_xml(text);
  EXPECT_EQ(testing::odd_coordinate(root), "");
  EXPECT_EQ(text, layout_svg(chart()));
  EXPECT_EQ(root.by_name("title").at(0)->text, "Where to mount <three> sensors");
  EXPECT_THAT(root.texts_of_class("legend"),
              ::testing::ElementsAre("offset 0 m", "offset 0.08 m", "a mission ended in contact",
                                     "best layout", "A + cone/2 + L = 90 at 42.5 degrees",
                                     "left of the line: some walls ahead give no echo",
                                     "less than 5 degrees to spare"));
}

TEST(LayoutSvg, MarksTheAngleOfTheRuleInBothPlots) {
  const Element root = parse_xml(layout_svg(chart()));
  const auto frames = root.by_class("frame"), rules = root.by_class("rule"), bands = root.by_class("margin");
  ASSERT_EQ(frames.size(), 2U);
  ASSERT_EQ(rules.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(rules[i]->number("x1"), x_of(*frames[i], 42.5), 0.02);
    EXPECT_EQ(rules[i]->number("x1"), rules[i]->number("x2"));
    EXPECT_NEAR(bands[i]->number("x") + bands[i]->number("width"), x_of(*frames[i], 47.5), 0.02);
  }
}

TEST(LayoutSvg, SaysInWordsWhereTheRuleLiesLeftOfTheChart) {
  LayoutChart c = chart();
  c.rule_angle_deg = -2.5;
  const Element root = parse_xml(layout_svg(c));
  EXPECT_TRUE(root.by_class("rule").empty());
  EXPECT_EQ(root.by_class("rule-note").at(0)->text,
            "A + cone/2 + L = 90 at -2.5 degrees, left of the chart: every layout here sees all walls ahead");
}

TEST(LayoutSvg, DrawsALineForEachOffsetWithGapsWhereNoTimeIsKnown) {
  const Element root = parse_xml(layout_svg(chart()));
  const auto lines = root.by_class("layout");
  ASSERT_EQ(lines.size(), 4U);
  const auto pieces = [&](std::size_t i) {
    const std::string& d = lines[i]->attributes.at("d");
    return std::count(d.begin(), d.end(), 'M');
  };
  EXPECT_EQ(pieces(0), 1);
  EXPECT_EQ(pieces(2), 2) << "time: the point without one parts the line";
  EXPECT_EQ(root.by_class("contact").size(), 2U);
  const auto best = root.by_class("best"), frames = root.by_class("frame");
  ASSERT_EQ(best.size(), 2U);
  EXPECT_NEAR(best[1]->number("cx"), x_of(*frames[1], 50), 0.02);
  const double top = 1.12 * 40, y = frames[1]->number("y") + (1 - 10 / top) * frames[1]->number("height");
  EXPECT_NEAR(best[1]->number("cy"), y, 0.02);
}

}  // namespace
}  // namespace whisker::report
