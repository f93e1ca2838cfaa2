#include "host/lab/report/result.hpp"
#include "tests/report/infinity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace whisker::report {
namespace {

RunResult sample() {
  RunResult r;
  r.verdict = Verdict::reached;
  r.time_s = 48.2;
  r.path_m = 0.1 + 0.2;
  r.final_distance_m = 0.0987654321;
  r.believed_distance_m = 0.05;
  r.min_clearance_m = 0.031;
  r.ticks = 4820;
  r.hash = 0xABC;
  return r;
}

TEST(ResultJson, is_the_object_of_the_contract_on_one_line) {
  EXPECT_EQ(
      result_json(sample()),
      R"({"outcome":"reached","time_s":48.2,"path_m":0.3,"final_distance_m":0.098765,)"
      R"("believed_distance_m":0.05,"min_clearance_m":0.031,"ticks":4820,"hash":"0000000000000abc","detail":"","bumps":null,)"
      R"("range_trust":null,"contradictions_per_m":null,"phantom_share":null,"false_clear_share":null,"incidence_seen_deg":null,)"
      R"("bound_m":null,"sigma_along_m":null,"sigma_across_m":null,"sigma_heading_deg":null})");
}

TEST(ResultJson, has_the_bound_of_the_pose) {
  RunResult r = sample();
  r.sigma = localization::PoseSigma{millimetres(30), millimetres(40), Angle::turns(1, 360)};
  const auto json = nlohmann::json::parse(result_json(r));
  EXPECT_EQ(json["bound_m"], 0.1);
  EXPECT_EQ(json["sigma_along_m"], 0.03);
  EXPECT_EQ(json["sigma_across_m"], 0.04);
  EXPECT_EQ(json["sigma_heading_deg"], 1.0);
}

TEST(RangeWarning, names_only_causes_that_the_scenario_has) {
  RangeTrust doubtful;
  doubtful.level = RangeLevel::doubtful;
  doubtful.contradictions = 5 * RangeTrust::kOnePerMetre;
  doubtful.incidence_deg = 41;
  const std::string start = "the ranges are doubtful: 5.0 contradictions per metre; what may cause it: ";
  Scenario s;
  EXPECT_EQ(range_warning(RangeTrust{}, s), "");
  EXPECT_EQ(range_warning(doubtful, s), start + "none in the parameters, which agree with the sensors");
  s.movers.emplace_back();
  EXPECT_EQ(range_warning(doubtful, s), start + "things that move");
  s.movers.clear();
  s.robot.rangefinders.incidence = 40_deg;
  s.sensor.incidence_deg = 40;
  EXPECT_EQ(range_warning(doubtful, s),
            start + "walls beyond 40 degrees give no echo, as range_incidence_deg says");
  s.sensor.incidence_deg = 38;
  EXPECT_EQ(range_warning(doubtful, s), start +
                                            "walls vanish beyond 38 degrees, and range_incidence_deg is 40 "
                                            "(other angles fit, see whisker robot layout)");
  s = {};
  s.sensor.incidence_deg = 80;
  s.sensor.cone_deg = 1;
  EXPECT_EQ(range_warning(doubtful, s),
            start +
                "walls vanish beyond 80 degrees, and range_incidence_deg is 90 (set 80), "
                "the cones are 1 degrees wide, and range_cone_deg is 25");
}

TEST(VerdictWords, say_how_sure_the_robot_is_of_its_place) {
  RunResult r = sample();
  r.sigma = localization::PoseSigma{millimetres(30), millimetres(40), Angle{}};
  r.goal_tolerance_m = 0.1;
  EXPECT_EQ(bound_words(r), ", within 0.10 m (2 sigma)");
  EXPECT_NE(verdict_words(r).find(bound_words(r)), std::string::npos);
  r.goal_tolerance_m = 0.05;
  EXPECT_EQ(bound_words(r), ", within 0.10 m (2 sigma), more than the tolerance of 0.05 m");
  r.verdict = Verdict::off_goal;
  EXPECT_EQ(bound_words(r), ", within 0.10 m (2 sigma), more than the tolerance of 0.05 m");
  r.verdict = Verdict::unreachable;
  EXPECT_EQ(bound_words(r), ", unless the goal is elsewhere: the place is known within 0.10 m (2 sigma)");
  r.goal_tolerance_m = 0.1;
  EXPECT_EQ(bound_words(r), "");
  r.verdict = Verdict::gave_up;
  EXPECT_EQ(bound_words(r), "");
  r = sample();
  EXPECT_EQ(bound_words(r), "");
}

TEST(ResultJson, names_each_outcome) {
  const std::pair<Verdict, const char*> all[] = {
      {Verdict::reached, "reached"}, {Verdict::off_goal, "off_goal"}, {Verdict::unreachable, "unreachable"},
      {Verdict::gave_up, "gave_up"}, {Verdict::contact, "contact"},   {Verdict::fault, "fault"}};
  for (const auto& [verdict, name] : all) {
    RunResult r = sample();
    r.verdict = verdict;
    EXPECT_EQ(nlohmann::json::parse(result_json(r))["outcome"], name);
  }
}

TEST(ResultJson, says_below_which_gaps_unreachable_holds) {
  RunResult r = sample();
  EXPECT_EQ(nlohmann::json::parse(result_json(r)).count("unreachable_above_m"), 0U);
  r.verdict = Verdict::unreachable;
  r.unreachable_above_m = 0.28856862;
  EXPECT_EQ(nlohmann::json::parse(result_json(r))["unreachable_above_m"], 0.288569);
  EXPECT_NE(verdict_words(r).find(", if all gaps are below 0.289 m"), std::string::npos);
}

TEST(ResultJson, keeps_all_bits_of_hash_and_ticks) {
  RunResult r = sample();
  r.hash = UINT64_MAX;
  r.ticks = UINT64_MAX;
  const auto json = nlohmann::json::parse(result_json(r));
  EXPECT_EQ(json["hash"], "ffffffffffffffff");
  EXPECT_EQ(json["ticks"].get<std::uint64_t>(), UINT64_MAX);
}

TEST(ResultJson, stays_json_on_one_line_whatever_it_holds) {
  RunResult r = sample();
  r.detail = "line\nbreak \"quote\" \xFF";
  r.min_clearance_m = kInfinity;
  r.path_m = std::nan("");
  r.final_distance_m = -1e-9;
  const std::string text = result_json(r);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto json = nlohmann::json::parse(text);
  EXPECT_TRUE(json["min_clearance_m"].is_null());
  EXPECT_TRUE(json["path_m"].is_null());
  EXPECT_EQ(json["final_distance_m"].dump(), "0.0");
}

TEST(VerdictWords, say_what_a_person_asks_first) {
  RunResult r = sample();
  r.path_m = 12.309;
  EXPECT_EQ(verdict_words(r), "reached in 48.2 s, 12.31 m, min clearance 0.031 m");
  r.verdict = Verdict::gave_up;
  r.final_distance_m = 1.5;
  r.detail = "time limit";
  EXPECT_EQ(verdict_words(r),
            "gave up after 48.2 s, 12.31 m, 1.50 m from the goal, min clearance 0.031 m (time limit)");
  r.verdict = Verdict::contact;
  r.min_clearance_m = -0.0001;
  EXPECT_EQ(verdict_words(r).find("-0.000"), std::string::npos);
}

TEST(ResultJson, has_null_for_a_distance_that_nobody_knows) {
  RunResult r = sample();
  r.final_distance_m = std::nan("");
  r.believed_distance_m.reset();
  const auto json = nlohmann::json::parse(result_json(r));
  EXPECT_TRUE(json["final_distance_m"].is_null());
  EXPECT_TRUE(json["believed_distance_m"].is_null());
}

TEST(VerdictWords, do_not_call_a_belief_the_truth) {
  RunResult r = sample();
  r.verdict = Verdict::off_goal;
  r.path_m = 12.309;
  r.final_distance_m = 5.8349;
  EXPECT_EQ(verdict_words(r),
            "believes it is there; is 5.83 m off, after 48.2 s, 12.31 m, min clearance 0.031 m");
}

TEST(VerdictWords, are_silent_about_a_clearance_that_nothing_gave) {
  RunResult r = sample();
  r.min_clearance_m = kInfinity;
  EXPECT_EQ(verdict_words(r).find("clearance"), std::string::npos);
}

}  // namespace
}  // namespace whisker::report
