// The warnings of `whisker robot check`, and that what they propose ends them.
#include "host/harness/scenario/mounting.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>

#include "host/harness/scenario/load.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

using testing::HasSubstr;

std::vector<MountingWarning> warnings(const std::string& keys) {
  const TemporaryFile file(keys);
  Params params;
  Sensor sensor;
  apply_robot_file(params, sensor, file.path());
  return mounting_warnings(params, sensor);
}

TEST(MountingWarnings, ThereAreNoneForIdealSensorsAndForLayoutsWithAMargin) {
  for (const char* keys :
       {"", "range_incidence_deg = 52.5\n", "range_side_angle_deg = 37.5\nrange_incidence_deg = 45\n",
        "range_side_angle_deg = 42.5\nrange_incidence_deg = 40\n"}) {
    EXPECT_TRUE(warnings(keys).empty()) << keys;
  }
}

TEST(MountingWarnings, WallsAreInvisibleBelow95Degrees) {
  const auto all = warnings("range_incidence_deg = 50\n");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_STREQ(all[0].kind, "invisible_walls");
  EXPECT_EQ(
      all[0].text,
      "walls ahead may be invisible: the cones reach 42.5 degrees outward (range_side_angle_deg + "
      "range_cone_deg / 2) and walls echo up to 50.0 degrees: the sum 92.5 is less than 90 + 5; it would "
      "fit with range_side_angle_deg >= 32.5, or with sensors that see walls up to 52.5 degrees");
  EXPECT_EQ(warnings("range_incidence_deg = 52.4\n").size(), 1U);
}

TEST(MountingWarnings, TheFilesSensorCounts) {
  EXPECT_EQ(warnings("[sensor]\nincidence_deg = 50\n").size(), 1U);
  const auto wide_nearby = warnings("[sensor]\nmodel = \"hc-sr04\"\n");
  ASSERT_EQ(wide_nearby.size(), 1U) << "its cone is wider than believed where the body passes";
  EXPECT_STREQ(wide_nearby[0].kind, "invisible_walls");
  const auto narrow = warnings("[sensor]\nmodel = \"hc-sr04\"\ncone_deg = 15\n");
  ASSERT_EQ(narrow.size(), 2U);
  EXPECT_STREQ(narrow[0].kind, "invisible_walls");
  EXPECT_STREQ(narrow[1].kind, "unseen_strip");
}

TEST(MountingWarnings, ASensorThatFoldsBackMustSitBehindTheRim) {
  const std::string folds = "[sensor]\nmin_range_m = 0.1\nnear_is = \"farther\"\n";
  const auto all = warnings(folds);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_STREQ(all[0].kind, "near_reads_farther");
  EXPECT_THAT(all[0].text, HasSubstr("left beam ends 10 mm beyond the rim"));
  EXPECT_TRUE(warnings("body_radius_m = 0.1\n" + folds).empty());
}

TEST(MountingWarnings, WallsBetweenTwoConesAreSeenByNone) {
  const auto all =
      warnings("range_incidence_deg = 22\nrange_side_angle_deg = 65\nwheel_speed_max_mps = 0.2\n");
  ASSERT_GE(all.size(), 1U);
  EXPECT_STREQ(all[0].kind, "invisible_walls");
  EXPECT_THAT(all[0].text, HasSubstr("20.0 degrees beside the two cones next to it"));
}

TEST(MountingWarnings, OwnAxesAreNamed) {
  const std::string axes = "range_incidence_deg = 50\nrange_left_angle_deg = 30\nrange_right_angle_deg = ";
  EXPECT_THAT(warnings(axes + "-31\n")[0].text,
              HasSubstr("range_left_angle_deg >= 32.5 and range_right_angle_deg <= -32.5,"));
  EXPECT_THAT(warnings(axes + "-40\n")[0].text, HasSubstr("fit with range_left_angle_deg >= 32.5, or"));
}

/// Each "key >= value" or "key <= value" that the text proposes, alone, leaves no warning.
int proposals_that_hold(const std::string& keys, const std::string& text) {
  const std::regex proposal("(range_[a-z_]+) [<>]= (-?[0-9.]+[0-9])");
  int count = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), proposal), end; it != end; ++it, ++count) {
    const std::string key = (*it)[1];
    const std::string others = std::regex_replace(keys, std::regex(key + " = [0-9.]+\n"), "");
    EXPECT_TRUE(warnings(key + " = " + std::string((*it)[2]) + "\n" + others).empty()) << it->str();
  }
  return count;
}

TEST(MountingWarnings, WhatTheyProposeFits) {
  const std::pair<const char*, int> robots[] = {
      {"range_incidence_deg = 50\n", 1},
      {"range_incidence_deg = 48.37\n", 1},
      {"range_cone_deg = 15\n", 2},
      {"range_cone_deg = 20\nrange_side_angle_deg = 45\n", 2},
      {"range_offset_m = 0.08\nrange_side_angle_deg = 38\n", 3},
      {"range_cone_deg = 15\nrange_side_angle_deg = 47.5\nrange_offset_m = 0.05\nrange_incidence_deg = 40\n",
       1},
  };
  for (const auto& [keys, proposals] : robots) {
    const auto all = warnings(keys);
    ASSERT_EQ(all.size(), 1U) << keys;
    EXPECT_EQ(proposals_that_hold(keys, all[0].text), proposals) << all[0].text;
  }
}

TEST(MountingWarnings, SayWhereNoSingleValueFits) {
  const auto all = warnings(
      "range_cone_deg = 15\nrange_side_angle_deg = 47.5\nrange_offset_m = 0.05\nrange_incidence_deg = 40\n"
      "[sensor]\nmodel = \"hc-sr04\"\n");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(
      all[0].text,
      HasSubstr("no single value of range_side_angle_deg, range_cone_deg or range_offset_m would fit"));
}

}  // namespace
}  // namespace whisker
