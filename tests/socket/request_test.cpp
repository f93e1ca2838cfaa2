#include "host/harness/socket/request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace whisker::socket {
namespace {

std::string refusal(const std::string& line, bool first = false) {
  try {
    first ? static_cast<void>(read_opening(line, {})) : static_cast<void>(read_tick(line));
  } catch (const ProtocolError& e) {
    return e.what();
  }
  return "";
}

TEST(Request, ANamedPlannerDrivesWithTheChosenTable) {
  const fuzzy::Engine::Table other{};
  Opening defaults;
  defaults.planner.table = &other;
  defaults.planner.table_chosen = true;
  const Opening o = read_opening(R"({"whisker": 1, "planner": "skirt"})", defaults);
  EXPECT_EQ(o.planner, PlannerKind::boundary);
  EXPECT_EQ(o.planner.table, &other);
  EXPECT_TRUE(o.planner.table_chosen);
}

TEST(Request, ReadsEveryKeyOfATick) {
  const Tick t = read_tick(
      R"({"t_s": 1.25, "range_m": [0.5, "clear", null], "age_s": [0.01, 0.02, 0], "counts": [-1, 16777217],
          "pressed": ["left", "right"], "reset": true, "cancel": false, "place": {"x_m": 2},
          "goal": {"x_m": 1, "y_m": -1}, "gyro": {"sum": -5, "samples": 65538, "saturated": 1},
          "fix": {"x_m": 1, "y_m": 2, "heading_deg": 90, "sigma_along_m": 0.01, "sigma_across_m": 0.02,
                  "sigma_heading_deg": 45}})");
  EXPECT_EQ(t.now_ms, 1250U);
  EXPECT_TRUE(t.has_ranges);
  EXPECT_EQ(t.beam[0].mm, 500);
  EXPECT_EQ(t.beam[0].age_ms, 10);
  EXPECT_EQ(t.beam[1].status, hal::RangeStatus::clear);
  EXPECT_FALSE(t.beam[2].fresh);
  EXPECT_EQ(*t.counts, (std::array<std::int64_t, 2>{-1, 16777217}));
  EXPECT_EQ(t.bumper->pressed, 1 << hal::kLeft | 1 << hal::kRight);
  EXPECT_TRUE(t.reset);
  EXPECT_FALSE(t.cancel);
  EXPECT_EQ(t.place->at.x, 2);
  EXPECT_EQ(t.goal->tolerance_m, 0.1);
  EXPECT_EQ(t.gyro->sum, 0xFFFFFFFBU) << "modulo 2^32";
  EXPECT_EQ(t.gyro->samples, 2) << "modulo 2^16";
  EXPECT_EQ(t.gyro->saturated, 1);
  EXPECT_EQ(t.fix->pose.at.y, 2_m);
  EXPECT_EQ(t.fix->pose.heading.raw(), 1U << 30);
  EXPECT_EQ(t.fix->sigma.across, 20_mm);
  EXPECT_EQ(t.fix->sigma.heading.raw(), 1U << 29);
}

TEST(Request, AWholeNumberMayHaveADecimalPoint) {
  const Tick t = read_tick(
      R"({"counts": [-1.0, 9.007199254740991e15], "gyro": {"sum": -5.0, "samples": 7.0, "saturated": -0.0}})");
  EXPECT_EQ(*t.counts, (std::array<std::int64_t, 2>{-1, 9007199254740991}));
  EXPECT_EQ(t.gyro->sum, 0xFFFFFFFBU);
  EXPECT_EQ(t.gyro->samples, 7);
  EXPECT_EQ(t.gyro->saturated, 0);
  const Opening o = read_opening(R"({"whisker": 1.0, "robot": {"encoder_counts_per_m": 4000.0}})", {});
  EXPECT_EQ(o.robot.wheels.counts_per_metre, 4000);
  EXPECT_THAT(refusal(R"({"whisker": 1, "robot": {"encoder_counts_per_m": 4000.5}})", true),
              testing::HasSubstr("must be an integer"));
}

TEST(Request, WhatIsNoFiniteNumberSaysOfASensorWhatItIs) {
  Tick t = read_tick(R"({"range_m": [NaN, Infinity, -Infinity], "counts": [NaN, 2], "pressed": []})");
  EXPECT_EQ(t.beam[0].status, hal::RangeStatus::invalid);
  EXPECT_EQ(t.beam[1].status, hal::RangeStatus::clear);
  EXPECT_EQ(t.beam[2].status, hal::RangeStatus::too_near);
  EXPECT_FALSE(t.counts) << "a failed read";
  t = read_tick(R"({"range_m": [65.535, 1e9, 65.533]})");
  for (const Beam& beam : t.beam) {
    EXPECT_EQ(beam.status, hal::RangeStatus::ok);
    EXPECT_EQ(beam.mm, 65533) << "the farthest that there is";
  }
  EXPECT_EQ(refusal(R"({"NaN \" Infinity": 1})"), "unknown key 'NaN \" Infinity'") << "in a text it is text";
}

TEST(Request, OneAgeForAllBeams) {
  EXPECT_EQ(read_tick(R"({"range_m": [1, 1, 1], "age_s": 0.03})").beam[2].age_ms, 30);
  EXPECT_EQ(read_tick(R"({"range_m": [1, 1, 1], "age_s": 9})").beam[2].age_ms, 255) << "ignored by the core";
}

TEST(Request, RefusesWhatDoesNotFollowTheProtocol) {
  EXPECT_EQ(refusal("hello"), "no JSON at byte 1");
  EXPECT_EQ(refusal(R"({"t_s": })"), "no JSON at byte 9");
  EXPECT_EQ(refusal(R"({"t_s": 1} 2)"), "no JSON at byte 12");
  EXPECT_EQ(refusal(R"({"t_s": NaN})"), "'t_s' must be a number, but is NaN");
  EXPECT_EQ(refusal(R"({"goal": {"x_m": -Infinity, "y_m": 0}})"), "'x_m' must be a number, but is -Infinity");
  EXPECT_EQ(refusal(R"({"t_s": NaN, })"), "no JSON at byte 9");
  EXPECT_EQ(refusal("{\"\\u001b]0;\\u009bx\\u0007\": 1}"), "unknown key '?]0;?x?'");
  EXPECT_EQ(refusal(R"({"t_s": 1)"), "no JSON: it ends after byte 9");
  EXPECT_EQ(refusal(R"({"t_s": 1e999})"), "a number is too large");
  EXPECT_EQ(refusal("[1]"), "not a JSON object");
  EXPECT_EQ(refusal(R"({"ranges": []})"), "unknown key 'ranges'");
  EXPECT_EQ(refusal(R"({"range_m": [1, 2]})"), "'range_m' must be a list of 3 values");
  EXPECT_EQ(refusal(R"({"range_m": [1, 2, -1]})"), "'range_m' must be from 0 to 65.533, but is -1");
  EXPECT_THAT(refusal(R"({"range_m": [1, 2, "far"]})"), testing::HasSubstr("but is 'far'"));
  EXPECT_EQ(refusal(R"({"range_m": [1, 2, true]})"), "'range_m' must be a number");
  EXPECT_EQ(refusal(R"({"counts": [1.5, 2]})"), "'counts' must be whole numbers");
  EXPECT_EQ(refusal(R"({"counts": [1, 99999999999999999]})"), "'counts' must be within 2^53");
  EXPECT_EQ(refusal(R"({"counts": [17.5, 2.0]})"), "'counts' must be whole numbers");
  EXPECT_EQ(refusal(R"({"counts": [1, "2"]})"), "'counts' must be whole numbers");
  EXPECT_EQ(refusal(R"({"counts": [1e300, 2]})"), "'counts' must be within 2^53");
  EXPECT_EQ(refusal(R"({"counts": [-9007199254740993, 2]})"), "'counts' must be within 2^53");
  EXPECT_EQ(refusal(R"({"counts": [18446744073709551615, 2]})"), "'counts' must be within 2^53") << "not -1";
  EXPECT_EQ(refusal(R"({"t_s": "now"})"), "'t_s' must be a number");
  EXPECT_EQ(refusal(R"({"pressed": ["back"]})"), "'pressed' may name left, front and right");
  EXPECT_EQ(refusal(R"({"gyro": 1})"), "'gyro' must be an object");
  EXPECT_EQ(refusal(R"({"gyro": {"sum": 1}})"), "gyro: 'samples' is missing");
  EXPECT_EQ(refusal(R"({"gyro": {"sum": 0.5, "samples": 1}})"), "'sum' must be a whole number");
  EXPECT_EQ(refusal(R"({"gyro": {"sum": 1, "samples": 1, "rate": 1}})"), "gyro: unknown key 'rate'");
  EXPECT_EQ(refusal(R"({"fix": {"x_m": 1, "y_m": 1}})"), "'heading_deg' is missing");
  EXPECT_EQ(refusal(R"({"fix": {"x_m": 1, "y_m": 1, "heading_deg": 0, "sigma_along_m": -1}})"),
            "'sigma_along_m' must be from 0 to 16, but is -1");
  EXPECT_EQ(refusal(R"({"cancel": 1})"), "'cancel' must be true or false");
  EXPECT_EQ(refusal(R"({"goal": {"x_m": 1}})"), "'y_m' is missing");
  EXPECT_EQ(refusal(R"({"goal": {"x_m": 1, "y_m": 0, "z_m": 0}})"), "goal: unknown key 'z_m'");
}

TEST(Request, RefusesAWrongFirstLine) {
  EXPECT_EQ(refusal("{}", true), "the first line must have the key 'whisker'");
  EXPECT_EQ(refusal(R"({"whisker": 2})", true), "this is version 1 of the protocol");
  EXPECT_EQ(refusal(R"({"whisker": 1, "planner": "best"})", true), "no planner 'best'");
  EXPECT_THAT(refusal(R"({"whisker": 1, "robot": {"body_radius": 1}})", true),
              testing::HasSubstr("body_radius"));
  EXPECT_THAT(refusal(R"({"whisker": 1, "robot": {"body_radius_m": 9}})", true),
              testing::HasSubstr("must be from"));
  EXPECT_THAT(refusal(R"({"whisker": 1, "robot": {"wheel_track_m": 0.5}})", true),
              testing::HasSubstr("it would fit with"));
  EXPECT_THAT(refusal(R"({"whisker": 1, "robot": {"body_radius_m": [1]}})", true),
              testing::HasSubstr("must be a number"));
}

}  // namespace
}  // namespace whisker::socket
