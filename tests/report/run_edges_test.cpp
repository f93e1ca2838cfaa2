#include "host/report/run_edges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host/report/run_svg.hpp"
#include "tests/report/script.hpp"
#include "tests/report/xml.hpp"

namespace whisker::report {
namespace {

using testing::Element;

Element drawn(const Scenario& scenario, const std::vector<TickRecord>& records) {
  const RunResult result = testing::result_of(Verdict::gave_up, scenario, records);
  return testing::parse_xml(run_svg(scenario, records, result));
}

TEST(RunEdges, marks_and_numbers_hit_and_leave_points) {
  using planning::Mode;
  using planning::Why;
  Scenario scenario;
  scenario.goal.at = {8, 0};
  const auto records = testing::follow(scenario, {{{1, 0}},
                                                  {{1, 2}, Mode::skirting, Why::edge},
                                                  {{3, 0}},
                                                  {{3, 2}, Mode::skirting, Why::edge},
                                                  {{5, 0}, Mode::going, Why::wall_lost},
                                                  {{5, 2}, Mode::skirting, Why::edge}});
  const Element root = drawn(scenario, records);
  const Element* marks = root.by_class("encounters").at(0);
  EXPECT_EQ(marks->by_class("hit").size(), 3U);
  EXPECT_EQ(marks->by_class("left").size(), 1U);
  EXPECT_EQ(marks->by_class("wall-lost").size(), 1U);
  EXPECT_THAT(root.texts_of_class("encounter-numbers"), ::testing::ElementsAre("1", "1", "2", "2", "3"));
  // 7 m from the goal at the hit point, sqrt(53) = 7.28 m at the leave point.
  EXPECT_THAT(root.texts_of_class("legend"),
              ::testing::IsSupersetOf(
                  {"boundary 1", "7.00 m", "7.28 m", "boundary 3", "-", "lost the wall: on to the goal"}));
}

TEST(RunEdges, lists_the_first_eight_boundaries_and_counts_the_others) {
  Scenario scenario;
  std::vector<testing::Leg> legs;
  for (int i = 0; i < 21; ++i) {
    const double x = i;
    legs.push_back({{x, 0.5}, planning::Mode::skirting, planning::Why::edge});
    legs.push_back({{x + 0.5, 0}});
  }
  const auto records = testing::follow(scenario, legs);
  const Element root = drawn(scenario, records);
  const auto words = root.texts_of_class("legend");
  EXPECT_THAT(words, ::testing::IsSupersetOf({"boundary 8", "and 13 more boundaries"}));
  EXPECT_THAT(words, ::testing::Not(::testing::Contains("boundary 9")));
  EXPECT_EQ(root.by_class("hit").size(), 22U) << "and one in the legend";
}

TEST(RunEdges, marks_none_on_a_path_without_boundaries) {
  const Scenario scenario;
  const auto records = testing::follow(scenario, {{{0.5, 0.5}}});
  const Element root = drawn(scenario, records);
  EXPECT_TRUE(root.by_class("encounters").empty());
  EXPECT_TRUE(root.by_class("hit").empty());
  EXPECT_THAT(root.texts_of_class("legend"), ::testing::Not(::testing::Contains("Distance to the goal")));
}

TEST(RunEdges, draws_the_straight_line_from_start_to_goal) {
  const Scenario scenario = testing::garden();
  const Element root = drawn(scenario, testing::garden_run(scenario));
  const Element* line = root.by_class("straight-way").at(0);
  const Element* start = root.by_class("start").at(0)->by_name("circle").at(0);
  const Element* goal = root.by_class("goal").at(0)->by_name("circle").at(0);
  EXPECT_EQ(line->number("x1"), start->number("cx"));
  EXPECT_EQ(line->number("y1"), start->number("cy"));
  EXPECT_EQ(line->number("x2"), goal->number("cx"));
  EXPECT_EQ(line->number("y2"), goal->number("cy"));
}

}  // namespace
}  // namespace whisker::report
