#include "host/report/layout_svg.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/report/xml.hpp"

namespace whisker::report {
namespace {

using testing::Element;
using testing::parse_xml;

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
