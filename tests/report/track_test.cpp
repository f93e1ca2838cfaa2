#include "host/lab/report/track.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "host/lab/report/palette.hpp"
#include "tests/report/infinity.hpp"
#include "tests/report/script.hpp"

namespace whisker::report {
namespace {

using planning::Mode;
using planning::Why;
using sim::Vec2;

TickRecord tick(Mode mode, Why why, int danger = 0) {
  TickRecord r;
  r.mode = mode;
  r.why = why;
  r.danger_count = static_cast<std::uint8_t>(danger);
  return r;
}

double to_segment(Vec2 p, Vec2 a, Vec2 b) {
  // By search, not by projection: independent of the code under test.
  double best = kInfinity;
  for (int i = 0; i <= 2000; ++i) {
    const Vec2 q = a + (b - a) * (i / 2000.0);
    best = std::fmin(best, std::hypot(p.x - q.x, p.y - q.y));
  }
  return best;
}

TEST(Doing, of_a_step_follows_its_reason) {
  EXPECT_EQ(doing(tick(Mode::stepping, Why::target_free)), Doing::free);
  EXPECT_EQ(doing(tick(Mode::stepping, Why::table)), Doing::table);
  EXPECT_EQ(doing(tick(Mode::stepping, Why::narrow)), Doing::probing);
  for (const Why why : {Why::target_blocked, Why::exit_left, Why::exit_right, Why::same_side})
    EXPECT_EQ(doing(tick(Mode::stepping, why)), Doing::danger) << planning::name(why);
}

TEST(Doing, outside_a_step_follows_the_mode_whatever_the_reason) {
  for (int w = 0; w < planning::kWhys; ++w) {
    const Why why = static_cast<Why>(w);
    EXPECT_EQ(doing(tick(Mode::steering, why)), Doing::table);
    EXPECT_EQ(doing(tick(Mode::probing, why)), Doing::probing);
    EXPECT_EQ(doing(tick(Mode::searching, why)), Doing::danger);
    EXPECT_EQ(doing(tick(Mode::following, why)), Doing::danger);
    EXPECT_EQ(doing(tick(Mode::facing, why)), Doing::free);
  }
}

TEST(Doing, is_danger_whenever_the_danger_counter_runs) {
  for (int m = 0; m < planning::kModes; ++m)
    for (int w = 0; w < planning::kWhys; ++w)
      EXPECT_EQ(doing(tick(static_cast<Mode>(m), static_cast<Why>(w), 1)), Doing::danger);
}

TEST(TrackSummary, adds_up_to_the_path_and_counts_what_happened) {
  const Scenario scenario = testing::garden();
  const auto records = testing::garden_run(scenario);
  const TrackSummary s = summarise(records);
  double sum = 0;
  for (const double metres : s.metres) {
    EXPECT_GT(metres, 0.1);
    sum += metres;
  }
  EXPECT_NEAR(sum, s.total_m, 1e-9);
  EXPECT_NEAR(s.total_m, testing::result_of(Verdict::reached, scenario, records).path_m, 1e-9);
  EXPECT_EQ(s.danger_entries, 1);
  EXPECT_EQ(s.longest_danger, 5);
  EXPECT_EQ(s.looks, 16);
  EXPECT_EQ(s.without_place, 0);
}

TEST(TrackSummary, leaves_out_records_without_a_place) {
  auto records = testing::garden_run(testing::garden());
  const double total = summarise(records).total_m;
  records[100].x_m = std::numeric_limits<double>::quiet_NaN();
  records[200].y_m = kInfinity;
  records[300].x_m = 1e12;
  const TrackSummary s = summarise(records);
  EXPECT_EQ(s.without_place, 3);
  EXPECT_NEAR(s.total_m, total, 0.01);
}

RC_GTEST_PROP(Simplified, stays_within_the_tolerance_and_keeps_the_ends, ()) {
  const auto steps = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(-20, 21), rc::gen::inRange(-20, 21)));
  const double tolerance = *rc::gen::inRange(1, 50) / 1000.0;
  std::vector<Vec2> points = {{0, 0}};
  for (const auto& [x, y] : steps) points.push_back(points.back() + Vec2{x / 1000.0, y / 1000.0});
  const std::vector<Vec2> kept = simplified(points, tolerance);
  RC_ASSERT(kept.size() >= std::min<std::size_t>(points.size(), 2));
  RC_ASSERT(kept.front().x == points.front().x && kept.front().y == points.front().y);
  RC_ASSERT(kept.back().x == points.back().x && kept.back().y == points.back().y);
  // The kept points are points of the path in order; the points between two of them are close to their line.
  std::size_t at = 0;
  for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
    while (points[at].x != kept[k + 1].x || points[at].y != kept[k + 1].y) {
      RC_ASSERT(at < points.size());
      ++at;
    }
  }
  for (const Vec2 p : points) {
    double nearest = kept.size() == 1 ? std::hypot(p.x - kept[0].x, p.y - kept[0].y) : kInfinity;
    for (std::size_t k = 0; k + 1 < kept.size(); ++k)
      nearest = std::fmin(nearest, to_segment(p, kept[k], kept[k + 1]));
    RC_ASSERT(nearest <= tolerance + 0.0006);
  }
}

TEST(Pieces, join_and_cover_the_path_from_start_to_end) {
  const auto records = testing::garden_run(testing::garden());
  const std::vector<Piece> all = pieces(records, 5e-4, 10000);
  ASSERT_EQ(all.size(), 9U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_GE(all[i].points.size(), 2U);
    if (i == 0) continue;
    EXPECT_NE(all[i].doing, all[i - 1].doing);
    EXPECT_EQ(all[i].points.front().x, all[i - 1].points.back().x);
    EXPECT_EQ(all[i].points.front().y, all[i - 1].points.back().y);
  }
  EXPECT_EQ(all.back().points.back().x, records.back().x_m);
  double length = 0;
  for (const Piece& piece : all)
    for (std::size_t i = 1; i < piece.points.size(); ++i)
      length +=
          std::hypot(piece.points[i].x - piece.points[i - 1].x, piece.points[i].y - piece.points[i - 1].y);
  EXPECT_NEAR(length, summarise(records).total_m, 1e-3);
}

TEST(Pieces, of_a_straight_drive_need_two_points) {
  Scenario scenario;
  const std::vector<Piece> all = pieces(testing::follow(scenario, {{{3, 4}}}), 5e-4, 10000);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].points.size(), 2U);
}

TEST(Pieces, of_a_standing_robot_are_none) {
  EXPECT_TRUE(pieces({}, 5e-4, 100).empty());
  EXPECT_TRUE(pieces(std::vector<TickRecord>(50), 5e-4, 100).empty());
}

TEST(Pieces, keep_to_the_most_points_allowed) {
  std::vector<TickRecord> records(20000);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].x_m = 0.001 * static_cast<double>(i);
    records[i].y_m = i % 2 == 0 ? 0.0 : 0.004;
  }
  const std::vector<Piece> all = pieces(records, 5e-4, 3000);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_LE(all[0].points.size(), 3000U);
}

TEST(MoverPosition, goes_there_and_back) {
  const std::vector<Vec2> path = {{0, 0}, {2, 0}, {2, 1}};
  const auto at = [&](double driven) { return mover_position(path, {1, 0}, driven); };
  const std::pair<double, Vec2> expected[] = {{0, {1, 0}}, {1, {2, 0}},     {1.5, {2, 0.5}},
                                              {2, {2, 1}}, {2.5, {2, 0.5}}, {4, {1, 0}},
                                              {5, {0, 0}}, {6, {1, 0}},     {6.5, {1.5, 0}}};
  for (const auto& [driven, place] : expected) {
    EXPECT_NEAR(at(driven).x, place.x, 1e-12) << driven;
    EXPECT_NEAR(at(driven).y, place.y, 1e-12) << driven;
  }
}

TEST(MoverPosition, without_a_way_to_go_is_its_centre) {
  EXPECT_EQ(mover_position({}, {1, 2}, 5).y, 2);
  EXPECT_EQ(mover_position({{1, 2}}, {1, 2}, 5).y, 2);
  EXPECT_EQ(mover_position({{1, 2}, {1, 2}}, {1, 2}, 5).y, 2);
}

double lightness(const std::string& colour) {
  double linear[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    linear[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return 116 * std::cbrt(0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]) - 16;
}

TEST(Looks, of_two_classes_differ_in_lightness_for_grey_print) {
  for (int a = 0; a < kDoings; ++a)
    for (int b = a + 1; b < kDoings; ++b)
      EXPECT_GT(std::fabs(lightness(kLooks[a].colour) - lightness(kLooks[b].colour)), 12.0)
          << kLooks[a].name << " and " << kLooks[b].name;
}

}  // namespace
}  // namespace whisker::report
