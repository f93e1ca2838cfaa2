#include "host/lab/report/run_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "host/lab/report/palette.hpp"
#include "host/lab/report/run_edges.hpp"
#include "tests/report/infinity.hpp"
#include "tests/report/script.hpp"
#include "tests/report/xml.hpp"

namespace whisker::report {
namespace {

using testing::Element;
using ::testing::HasSubstr;
using testing::parse_xml;
using testing::result_of;

constexpr Verdict kVerdicts[] = {Verdict::reached, Verdict::off_goal, Verdict::unreachable,
                                 Verdict::gave_up, Verdict::contact,  Verdict::fault};

struct Drawn {
  std::string text;
  Element root;
};

Drawn draw(const Scenario& scenario, const std::vector<TickRecord>& records, const RunResult& result,
           const RunPicture& options = {}) {
  Drawn drawn;
  drawn.text = run_svg(testing::log_of(scenario, records, result), options);
  drawn.root = parse_xml(drawn.text);
  return drawn;
}

Drawn draw_garden(Verdict verdict) {
  const Scenario scenario = testing::garden();
  const auto records = testing::garden_run(scenario);
  return draw(scenario, records, result_of(verdict, scenario, records));
}

/// Ten minutes at full speed that never go straight and change activity often.
std::vector<TickRecord> ten_restless_minutes() {
  std::mt19937 random(5);
  std::vector<TickRecord> records(60000);
  double x = 1;
  double y = 1;
  double heading = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    heading += (static_cast<double>(random() % 2001) - 1000) / 4000;
    if (x < 0 || x > 4 || y < 0 || y > 4) heading = std::atan2(2 - y, 2 - x);
    x += 0.003 * std::cos(heading);
    y += 0.003 * std::sin(heading);
    TickRecord& r = records[i];
    r.t_s = 0.01 * static_cast<double>(i);
    r.x_m = x;
    r.y_m = y;
    r.heading_rad = heading;
    r.mode = planning::Mode::stepping;
    r.why = static_cast<planning::Why>((i / 50) % planning::kWhys);
    r.looked = true;
  }
  return records;
}

TEST(RunSvg, is_well_formed_with_plain_coordinates_for_each_verdict) {
  for (const Verdict verdict : kVerdicts) {
    const Drawn drawn = draw_garden(verdict);
    EXPECT_EQ(drawn.root.name, "svg");
    EXPECT_EQ(testing::odd_coordinate(drawn.root), "");
  }
}

TEST(RunSvg, says_what_a_robot_off_the_goal_believes) {
  const Drawn drawn = draw_garden(Verdict::off_goal);
  EXPECT_THAT(drawn.root.by_class("verdict").at(0)->text, HasSubstr("believes it is there; is "));
  EXPECT_THAT(drawn.root.by_class("verdict").at(0)->text, HasSubstr(" m off, after 22."));
}

TEST(RunSvg, has_the_name_and_the_verdict_as_text) {
  const Drawn drawn = draw_garden(Verdict::reached);
  EXPECT_EQ(drawn.root.by_class("name").at(0)->text, "garden: four discs, a wall & <a mover>");
  EXPECT_THAT(drawn.root.by_class("verdict").at(0)->text, HasSubstr("reached in 22."));
  EXPECT_THAT(drawn.root.by_name("title").at(0)->text, HasSubstr("reached in 22."));
}

TEST(RunSvg, marks_a_contact_exactly_when_there_was_one) {
  for (const Verdict verdict : kVerdicts) {
    const Drawn drawn = draw_garden(verdict);
    EXPECT_EQ(drawn.root.by_class("contact").size(), verdict == Verdict::contact ? 1U : 0U);
  }
}

TEST(RunSvg, puts_the_contact_where_the_robot_last_was) {
  const Drawn drawn = draw_garden(Verdict::contact);
  const Element* mark = drawn.root.by_class("contact").at(0)->by_name("circle").at(0);
  const Element* body = drawn.root.by_class("end").at(0)->by_name("circle").at(0);
  EXPECT_EQ(mark->number("cx"), body->number("cx"));
  EXPECT_EQ(mark->number("cy"), body->number("cy"));
}

/// Page coordinates of a small disc, which the picture shows as a circle in the same order.
std::vector<const Element*> discs_of(const Drawn& drawn) {
  return drawn.root.by_class("obstacles").at(0)->by_name("circle");
}

RC_GTEST_PROP(RunSvg, has_equal_axes_and_keeps_places_in_worlds_from_one_to_fifty_metres, ()) {
  const double size = *rc::gen::inRange(10, 500) / 10.0;
  const auto coordinate = rc::gen::map(rc::gen::inRange(-1000, 1001), [&](int k) { return k * size / 2000; });
  Scenario scenario;
  scenario.goal.at = {size, *coordinate};
  for (int i = 0; i < 6; ++i) scenario.discs.push_back({{*coordinate, *coordinate}, size / 30});
  const Drawn drawn = draw(scenario, {}, {});
  const auto circles = discs_of(drawn);
  RC_ASSERT(circles.size() == 6U);
  const double scale = circles[0]->number("r") / scenario.discs[0].radius;
  for (std::size_t i = 1; i < 6; ++i) {
    const sim::Vec2 world = scenario.discs[i].center - scenario.discs[0].center;
    const double x = circles[i]->number("cx") - circles[0]->number("cx");
    const double y = circles[0]->number("cy") - circles[i]->number("cy");
    // Coordinates have two decimals, and so has the radius from which the scale is computed.
    const double slack = 0.011 + 0.006 / circles[0]->number("r") * std::fmax(std::fabs(x), std::fabs(y));
    RC_ASSERT(std::fabs(x - world.x * scale) <= slack);
    RC_ASSERT(std::fabs(y - world.y * scale) <= slack);
  }
}

TEST(RunSvg, of_ten_restless_minutes_stays_below_300_kilobytes) {
  Scenario scenario = testing::garden();
  const auto records = ten_restless_minutes();
  const Drawn drawn = draw(scenario, records, result_of(Verdict::gave_up, scenario, records));
  EXPECT_LT(drawn.text.size(), 300000U);
  EXPECT_GT(drawn.root.by_class("path").at(0)->children.size(), 2U);
}

TEST(RunSvg, without_a_record_shows_the_world) {
  const Drawn drawn = draw(testing::garden(), {}, {});
  EXPECT_EQ(discs_of(drawn).size(), 4U);
  EXPECT_EQ(drawn.root.by_class("start").size(), 1U);
  EXPECT_EQ(drawn.root.by_class("end").size(), 0U);
  EXPECT_EQ(drawn.root.by_class("looks").size(), 0U);
  EXPECT_TRUE(drawn.root.by_class("path").at(0)->children.empty());
}

TEST(RunSvg, of_a_contact_before_the_first_record_marks_the_start) {
  RunResult result;
  result.verdict = Verdict::contact;
  const Drawn drawn = draw(testing::garden(), {}, result);
  EXPECT_EQ(drawn.root.by_class("contact").at(0)->by_name("circle").at(0)->number("cx"),
            drawn.root.by_class("start").at(0)->by_name("circle").at(0)->number("cx"));
}

TEST(RunSvg, widens_its_frame_for_a_robot_that_left_the_bounds) {
  const Scenario scenario = testing::garden();
  const auto records = testing::follow(scenario, {{{-3, 0.4}}});
  const Drawn drawn = draw(scenario, records, result_of(Verdict::fault, scenario, records));
  const Element* frame = drawn.root.by_class("frame").at(0);
  const Element* end = drawn.root.by_class("end").at(0)->by_name("circle").at(0);
  EXPECT_GT(end->number("cx") - end->number("r"), frame->number("x"));
}

TEST(RunSvg, keeps_the_way_in_sight_in_a_world_far_larger) {
  Scenario scenario = testing::garden();
  const auto records = testing::garden_run(scenario);
  const RunResult result = result_of(Verdict::reached, scenario, records);
  const double scale = discs_of(draw(scenario, records, result)).at(0)->number("r");
  scenario.walls.push_back({{-800, 20}, {900, 20}});
  scenario.discs.push_back({{-600, 0}, 500});
  const Drawn drawn = draw(scenario, records, result);
  EXPECT_GT(discs_of(drawn).at(0)->number("r"), scale / 5);
  const Element* frame = drawn.root.by_class("frame").at(0);
  for (const char* body : {"start", "end"}) {
    const Element* circle = drawn.root.by_class(body).at(0)->by_name("circle").at(0);
    EXPECT_GT(circle->number("cx"), frame->number("x"));
    EXPECT_LT(circle->number("cx"), frame->number("x") + frame->number("width"));
  }
}

TEST(RunSvg, survives_numbers_that_no_page_holds) {
  const Scenario scenario = testing::garden();
  auto records = testing::garden_run(scenario);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  records[10].x_m = nan;
  records[20].y_m = kInfinity;
  records[30].x_m = -1e300;
  records[40].heading_rad = nan;
  for (TickRecord& r : records) r.t_s = 1e15;
  records.back().heading_rad = kInfinity;
  RunResult result;
  result.time_s = nan;
  result.min_clearance_m = -kInfinity;
  const Drawn drawn = draw(scenario, records, result);
  EXPECT_EQ(testing::odd_coordinate(drawn.root), "");
  EXPECT_THAT(drawn.text, HasSubstr("3 records without a position left out"));
}

TEST(RunSvg, shows_no_beam_for_a_lost_reading) {
  const Scenario scenario = testing::garden();
  auto records = testing::garden_run(scenario);
  for (TickRecord& r : records) r.ranges.beam[hal::kFront].status = hal::RangeStatus::stale;
  const Drawn drawn = draw(scenario, records, result_of(Verdict::reached, scenario, records));
  EXPECT_EQ(drawn.root.by_class("cones").at(0)->by_name("path").size(), 2U);
}

TEST(RunSvg, moves_the_mover_to_where_it_is_at_the_end) {
  const Scenario scenario = testing::garden();
  const auto records = testing::garden_run(scenario);
  const Drawn drawn = draw(scenario, records, result_of(Verdict::reached, scenario, records));
  const double scale = discs_of(drawn).at(0)->number("r") / 0.25;
  const double x = discs_of(drawn)[0]->number("cx") + (1.45 + 0.05 * records.back().t_s - 1.15) * scale;
  EXPECT_NEAR(drawn.root.by_class("mover").at(0)->number("cx"), x, 0.3);
}

TEST(RunSvg, keeps_a_name_of_any_bytes_well_formed) {
  Scenario scenario = testing::garden();
  scenario.name = std::string(500, '<') + "\xFF\x01";
  EXPECT_NO_THROW(draw(scenario, {}, {}));
  scenario.name = "\xFF\x01]]>&";
  EXPECT_NO_THROW(draw(scenario, {}, {}, {"sub & title <"}));
}

Element drawn(const Scenario& scenario, const std::vector<TickRecord>& records) {
  const RunResult result = testing::result_of(Verdict::gave_up, scenario, records);
  return testing::parse_xml(run_svg(testing::log_of(scenario, records, result)));
}

TEST(RunEdges, lists_the_first_eight_boundaries_and_counts_the_others) {
  Scenario scenario;
  std::vector<testing::Leg> legs;
  for (int i = 0; i < 21; ++i) {
    const double x = i;
    legs.push_back({{x, 0.5}, planning::Mode::following, planning::Why::edge});
    legs.push_back({{x + 0.5, 0}});
  }
  const auto records = testing::follow(scenario, legs);
  const Element root = drawn(scenario, records);
  const auto words = root.texts_of_class("legend");
  EXPECT_THAT(words, ::testing::IsSupersetOf({"boundary 8", "and 13 more boundaries"}));
  EXPECT_THAT(words, ::testing::Not(::testing::Contains("boundary 9")));
  EXPECT_EQ(root.by_class("hit").size(), 22U) << "and one in the legend";
}

}  // namespace
}  // namespace whisker::report
