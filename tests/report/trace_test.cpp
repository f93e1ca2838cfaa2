#include "host/lab/report/trace.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "tests/report/script.hpp"

namespace whisker::report {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The cells of the only row.
std::vector<std::string> row_of(const TickRecord& record, const Scenario& scenario = {}) {
  const std::vector<std::string> lines = split(trace_csv(testing::log_of(scenario, {record})), '\n');
  EXPECT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines.back(), "");
  return split(lines.at(1), ',');
}

TEST(Trace, without_records_is_its_header) {
  EXPECT_EQ(trace_csv(testing::log_of({}, {})),
            "t_s,x_m,y_m,heading_rad,left_m,front_m,right_m,v_left_mps,v_right_mps,state,why,"
            "t,looked,d,r,sa,sd,cmd_left_mps,cmd_right_mps,est_x_m,est_y_m,est_heading_rad,guide,way_x_m,way_"
            "y_m,pressed,sigma_along_m,sigma_across_m,sigma_heading_rad,bend_rad,pace_mps\n");
}

TEST(Trace, writes_a_record_in_every_detail) {
  TickRecord r;
  r.t_s = 12.34;
  r.x_m = 1.2345678;
  r.y_m = -0.5;
  r.heading_rad = 3.1415926535;
  r.ranges.beam[hal::kLeft] = {1234, hal::RangeStatus::ok, 0, 0};
  r.ranges.beam[hal::kFront] = {0, hal::RangeStatus::clear, 0, 0};
  r.ranges.beam[hal::kRight] = {0, hal::RangeStatus::too_near, 0, 0};
  r.v_left_mps = 0.25;
  r.v_right_mps = -0.123456;
  r.mode = planning::Mode::following;
  r.why = planning::Why::same_side;
  r.danger_count = 7;
  r.looked = true;
  r.d_q7 = 129;
  r.r_q7 = -1024;
  r.sa_q14 = -16384;
  r.sd_q14 = 1;
  r.command = {2501, -3};
  r.est_x_m = 1.2;
  r.est_y_m = -0.4999999;
  r.est_heading_rad = 3.25;
  r.guide = Guidance::place;
  r.way_x_m = 2.05;
  r.way_y_m = -0.35;
  r.pressed = 5;
  r.bend_rad = -0.0698;
  r.pace_mps = 0.175;
  r.sigma = localization::PoseSigma{micrometres(20500), millimetres(110), Angle::turns(1, 4)};
  Scenario scenario;
  scenario.robot.rangefinders.max_range = millimetres(1500);
  scenario.robot.rangefinders.min_range = millimetres(35);
  EXPECT_EQ(split(trace_csv(testing::log_of(scenario, {r})), '\n').at(1),
            "12.340,1.234568,-0.500000,3.141593,1.2340,1.5000,0.0350,0.25000,-0.12346,skirting,same_side,"
            "7,1,1.0078,-8.0000,-1.00000,0.00006,0.25010,-0.00030,1.200000,-0.500000,3.250000,place,2.050000,"
            "-0.350000,5,0.020500,0.110000,1.570796,-0.06980,0.17500");
}

TEST(Trace, leaves_a_lost_range_empty) {
  TickRecord r;
  for (hal::RangeReading& beam : r.ranges.beam) beam = {777, hal::RangeStatus::invalid, 0, 0};
  r.ranges.beam[hal::kFront].status = hal::RangeStatus::stale;
  const auto cells = row_of(r);
  EXPECT_EQ(cells[4], "");
  EXPECT_EQ(cells[5], "");
  EXPECT_EQ(cells[6], "");
}

TEST(Trace, writes_the_reference_robots_clear_and_too_near) {
  TickRecord r;
  r.ranges.beam[0] = {0, hal::RangeStatus::clear, 0, 0};
  r.ranges.beam[1] = {0, hal::RangeStatus::too_near, 0, 0};
  const auto cells = row_of(r);
  EXPECT_EQ(cells[4], "2.0000");
  EXPECT_EQ(cells[5], "0.0200");
}

TEST(Trace, names_every_state_and_reason) {
  for (int m = 0; m < planning::kModes; ++m) {
    TickRecord r;
    r.mode = static_cast<planning::Mode>(m);
    EXPECT_EQ(row_of(r)[9], planning::name(r.mode));
  }
  for (int w = 0; w < planning::kWhys; ++w) {
    TickRecord r;
    r.why = static_cast<planning::Why>(w);
    EXPECT_EQ(row_of(r)[10], planning::name(r.why));
  }
}

TEST(Trace, tells_of_the_guide_what_it_has) {
  TickRecord r;
  r.way_x_m = 1;
  const auto last_three = [&](Guidance guide) {
    r.guide = guide;
    const auto cells = row_of(r);
    return cells.at(22) + "," + cells.at(23) + "," + cells.at(24);
  };
  EXPECT_EQ(last_three(Guidance::unknown), ",,");
  EXPECT_EQ(last_three(Guidance::none), "none,,");
  EXPECT_EQ(last_three(Guidance::goal), "goal,1.000000,0.000000");
  EXPECT_EQ(last_three(Guidance::place), "place,1.000000,0.000000");
  EXPECT_EQ(last_three(Guidance::wait), "wait,,");
}

TEST(Trace, keeps_all_fuzzy_values_apart) {
  // A reader can recover the raw integer from the text.
  for (int raw = -16384; raw <= 16384; raw += 7) {
    TickRecord r;
    r.sa_q14 = r.sd_q14 = static_cast<std::int16_t>(raw);
    r.d_q7 = r.r_q7 = static_cast<std::int16_t>(raw / 16);
    const auto cells = row_of(r);
    ASSERT_EQ(std::lround(std::stod(cells[13]) * 128), raw / 16);
    ASSERT_EQ(std::lround(std::stod(cells[15]) * 16384), raw);
  }
}

RC_GTEST_PROP(Trace, lets_a_judge_read_pose_and_speed_back, (int x, int y, int heading, int speed)) {
  TickRecord r;
  r.x_m = x / 1e7;
  r.y_m = y / 1e7;
  r.heading_rad = heading / 1e7;
  r.v_left_mps = speed / 1e9;
  const auto cells = row_of(r);
  RC_ASSERT(cells.size() == 31U);
  RC_ASSERT(std::fabs(std::stod(cells[1]) - r.x_m) <= 0.6e-6);
  RC_ASSERT(std::fabs(std::stod(cells[2]) - r.y_m) <= 0.6e-6);
  RC_ASSERT(std::fabs(std::stod(cells[3]) - r.heading_rad) <= 0.6e-6);
  RC_ASSERT(std::fabs(std::stod(cells[7]) - r.v_left_mps) <= 0.6e-5);
  for (const std::string& cell : cells) {
    const bool negative_zero =
        cell.rfind("-0.", 0) == 0 && cell.find_first_of("123456789") == std::string::npos;
    RC_ASSERT(!negative_zero);
  }
}

TEST(Trace, has_one_row_of_all_columns_for_each_tick_of_a_run) {
  const Scenario scenario = testing::garden();
  const auto records = testing::garden_run(scenario);
  const std::vector<std::string> lines = split(trace_csv(testing::log_of(scenario, records)), '\n');
  ASSERT_EQ(lines.size(), records.size() + 2);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) ASSERT_EQ(split(lines[i], ',').size(), 31U) << lines[i];
}

TEST(Trace, goes_into_a_file_as_it_is) {
  const std::string path = ::testing::TempDir() + "whisker_trace_test.csv";
  const Scenario scenario = testing::garden();
  const auto records = testing::garden_run(scenario);
  write_trace(path, testing::log_of(scenario, records));
  std::ifstream in(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(text, trace_csv(testing::log_of(scenario, records)));
  std::remove(path.c_str());
}

}  // namespace
}  // namespace whisker::report
