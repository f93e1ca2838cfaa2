#include <gmock/gmock.h>

#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/violations.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

using testing::HasSubstr;

const char kLeast[] = "name = \"n\"\n[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 4\ny_m = 0\n";

TEST(RobotFile, SetsWhatItNamesAndLeavesTheRest) {
  const TemporaryFile file("body_radius_m = 0.12\n[robot]\nrange_max_m = 3\n");
  Params params;
  params.safety.max_gap = 90_ms;
  apply_robot_file(params, file.path());
  EXPECT_EQ(params.body.radius, 120_mm);
  EXPECT_EQ(params.rangefinders.max_range, 3_m);
  EXPECT_EQ(params.safety.max_gap, 90_ms);
}

TEST(RobotFile, MaySayWhatTheSensorsReallyDo) {
  const TemporaryFile file(
      "body_radius_m = 0.12\n[sensor]\nincidence_deg = 40\ncone_deg = 15\nphantom = 0.3\n");
  Scenario s = parse_scenario(std::string(kLeast) + "[sensor]\nskew_deg = 5\nphantom = 0.1\n", "scenario");
  apply_robot_file(s, file.path());
  EXPECT_EQ(s.robot.body.radius, 120_mm);
  EXPECT_EQ(s.robot.rangefinders.cone, 25_deg) << "the robot does not know";
  EXPECT_EQ(s.sensor.incidence_deg, 40);
  EXPECT_EQ(s.sensor.cone_deg, 15);
  EXPECT_EQ(s.sensor.phantom, 0.3);
  EXPECT_EQ(s.sensor.skew_deg, 5) << "what the file does not set stays";
  Params params;
  apply_robot_file(params, file.path());
  EXPECT_EQ(params.body.radius, 120_mm);
}

TEST(RobotFile, MaySayHowNoisyTheRobotIs) {
  const TemporaryFile file("[noise]\nrange_false_clear = 0.3\n");
  Scenario s = parse_scenario(std::string(kLeast) + "[noise]\nrange_false_clear = 0.1\nrange_dropout = 0.2\n",
                              "scenario");
  apply_robot_file(s, file.path());
  EXPECT_EQ(s.noise.range_false_clear, 0.3);
  EXPECT_EQ(s.noise.range_dropout, 0.2) << "what the file does not set stays";
}

TEST(RobotFile, WithAWrongSensorChangesNothing) {
  const TemporaryFile file("body_radius_m = 0.12\n[sensor]\nphantom = 1.5\n");
  Params params;
  EXPECT_EQ(message_of<InputError>([&] { apply_robot_file(params, file.path()); }),
            file.path() + ":3:11: 'phantom' must be from 0 to 1, but is 1.5");
  EXPECT_EQ(params.body.radius, 90_mm);
}

TEST(RobotFile, WithAnErrorChangesNothing) {
  const TemporaryFile file("body_radius_m = 0.12\nwheel_track_m = 0.5\n");
  Params params;
  EXPECT_EQ(
      message_of<InputError>([&] { apply_robot_file(params, file.path()); }),
      file.path() +
          ":2:17: wheel_track_m = 0.5 (line 2), body_radius_m = 0.12 (line 1): the wheels must lie "
          "within the body: wheel_track_m <= 2 body_radius_m; the robot itself would have to differ: it "
          "would fit with wheel_track_m <= 0.24 or body_radius_m >= 0.25");
  EXPECT_EQ(params.body.radius, 90_mm);
}

std::vector<std::string> all_errors(const std::string& text) {
  const TemporaryFile file(text);
  Params params;
  try {
    apply_robot_file(params, file.path());
  } catch (const InputErrors& errors) {
    std::vector<std::string> lines;
    for (const InputError& e : errors.all())
      lines.push_back(std::string(e.what()).substr(file.path().size()));
    return lines;
  }
  return {};
}

TEST(RobotFile, IsToldEveryRelationThatDoesNotHold) {
  const auto lines =
      all_errors("range_clear_m = 0.15\nstale_after_s = 0.03\n\n[robot]\ncreep_speed_mps = 0.01\n");
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[0], testing::StartsWith(":2:17: stale_after_s = 0.03 (line 2), "));
  EXPECT_THAT(lines[0], HasSubstr("stale_after_s >= 0.041"));
  EXPECT_THAT(lines[1], testing::StartsWith(
                            ":1:17: range_clear_m = 0.15 (line 1), range_max_m = 2 (not in this file)"));
  EXPECT_THAT(lines[1], HasSubstr("; it would fit with range_clear_m"));
  EXPECT_THAT(lines[2], testing::StartsWith(":5:19: "));
}

TEST(RobotFile, MayStillHaveTheKeysThatTheRobotDerives) {
  std::string keys;
  for (const std::string_view key : derived_keys()) keys += std::string(key) + " = 1\n";
  const TemporaryFile file(keys);
  Params params;
  testing::internal::CaptureStderr();
  apply_robot_file(params, file.path());
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr(file.path() + ":1:19: 'consensus_reads' is derived: ignored\n"));
  EXPECT_EQ(static_cast<std::size_t>(std::count(said.begin(), said.end(), '\n')), derived_keys().size());
  EXPECT_EQ(robot_toml(params), "");
}

TEST(RobotFile, IsToldEveryValueOutOfRangeBeforeAnyRelation) {
  const auto lines =
      all_errors("body_radius_m = 9\nrange_rate_hz = true\nconsensus = \"mode\"\nstale_after_s = 0.03\n");
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[0], HasSubstr(":1:17: 'body_radius_m' must be from 0.02 to 1 m, but is 9"));
  EXPECT_THAT(lines[1], HasSubstr(":2:17: 'range_rate_hz' must be an integer"));
  EXPECT_THAT(lines[2], HasSubstr(":3:13: 'consensus' must be agreeing or median"));
}

TEST(Violations, NameTheirKeysAndWhatIsSaidToFitDoes) {
  // Sets one parameter far from its default: every suggested change must satisfy the relation.
  const std::vector<ParamEntry> list = param_list(Params{});
  int mended = 0;
  for (std::size_t place = 0; place < list.size(); ++place) {
    for (const std::int64_t raw : {list[place].low, list[place].high}) {
      Params params;
      set_param(params, place, raw);
      for (const Violation& v : violations(params).all) {
        EXPECT_FALSE(v.keys.empty()) << name(v.fault);
        for (const std::string& fit : v.fits) {
          std::string lines;
          for (std::size_t at = 0; at < fit.size();) {
            const std::size_t end = std::min(fit.find(" and ", at), fit.size());
            const std::string one = fit.substr(at, end - at);
            lines += one.substr(0, one.find(' ')) + " = " + one.substr(one.find_last_of(" =") + 1) + "\n";
            at = end + 5;
          }
          const TemporaryFile file(lines);
          Params changed = params;
          try {
            apply_robot_file(changed, file.path());
          } catch (const InputErrors& errors) {
            for (const InputError& e : errors.all())
              EXPECT_THAT(e.what(), testing::Not(HasSubstr(relation(v.fault).words)));
          }
          ++mended;
        }
      }
    }
  }
  EXPECT_GT(mended, 50);
}

TEST(Violations, SayShortNumbersThatFit) {
  const auto wide = all_errors("range_side_angle_deg = 80\n");
  ASSERT_EQ(wide.size(), 1U);
  EXPECT_THAT(wide[0], testing::EndsWith("fit with range_side_angle_deg <= 77.5 or range_cone_deg <= 20"));
  const auto fast = all_errors("wheel_speed_max_mps = 3\n");
  ASSERT_EQ(fast.size(), 1U);
  EXPECT_THAT(fast[0], testing::EndsWith("fit with wheel_speed_max_mps <= 0.896"));
}

TEST(RobotFile, ThatSetsAParameterTwiceIsRefused) {
  const TemporaryFile file("range_max_m = 3\n[robot]\nrange_max_m = 4\n");
  Params params;
  EXPECT_EQ(message_of<InputError>([&] { apply_robot_file(params, file.path()); }),
            file.path() + ":3:15: 'range_max_m' is set both at the top level and in [robot]");
}

TEST(RobotFile, SetsTheNoiseThatItHasAndKeepsTheOthers) {
  const TemporaryFile file("body_radius_m = 0.08\n[noise]\ngyro_bias_dps = 1.5\nwheel_slip = 0\n");
  Scenario s;
  s.goal.at = {1, 0};
  s.noise.wheel_slip = 0.1;
  s.noise.range_sigma_m = 0.02;
  apply_robot_file(s, file.path());
  EXPECT_EQ(s.noise.gyro_bias_dps, 1.5);
  EXPECT_EQ(s.noise.wheel_slip, 0);
  EXPECT_EQ(s.noise.range_sigma_m, 0.02);
  const TemporaryFile bad("[noise]\ngyro_bias = 1\n");
  EXPECT_THAT(message_of<InputError>([&] { apply_robot_file(s, bad.path()); }), HasSubstr("gyro_bias_dps"));
}

TEST(RobotFile, SaysWithABooleanThatABumperIsFitted) {
  for (const bool is : {false, true}) {
    const TemporaryFile file(is ? "bumper = true\n" : "bumper = false\n");
    Params params;
    params.bumper.fitted = is ? Fitted::no : Fitted::yes;
    apply_robot_file(params, file.path());
    EXPECT_EQ(params.bumper.fitted, is ? Fitted::yes : Fitted::no);
    EXPECT_EQ(robot_toml(params), is ? "bumper = true\n" : "");
  }
  const TemporaryFile word("bumper = \"true\"\n");
  Params params;
  EXPECT_EQ(message_of<InputErrors>([&] { apply_robot_file(params, word.path()); }),
            word.path() + ":1:10: 'bumper' must be true or false, but is a string");
}

TEST(RobotFile, CreepsOnlyWithABumper) {
  const TemporaryFile file("creep_speed_mps = 0.05\n");
  Params params;
  EXPECT_THAT(message_of<InputErrors>([&] { apply_robot_file(params, file.path()); }),
              HasSubstr("creep_speed_mps must be 0 unless bumper is true"));
  const TemporaryFile both("creep_speed_mps = 0.05\nbumper = true\n");
  apply_robot_file(params, both.path());
  EXPECT_EQ(params.bumper.creep_speed, 50_mm_per_s);
}

TEST(RobotFile, WithAMisspeltKeyIsRefused) {
  const TemporaryFile file("# a robot\nbody_radus_m = 0.1\n");
  Params params;
  EXPECT_EQ(message_of<InputError>([&] { apply_robot_file(params, file.path()); }),
            file.path() + ":2:1: unknown key 'body_radus_m'; did you mean 'body_radius_m'?");
}

TEST(RobotFile, WhoseBodyTouchesAtTheStartIsRefusedForThatScenario) {
  Scenario s = parse_scenario(std::string(kLeast) + "[[disc]]\ncenter = [0.5, 0]\nradius_m = 0.3\n", "text");
  const TemporaryFile file("body_radius_m = 0.25\n");
  EXPECT_THAT(message_of<InputError>([&] { apply_robot_file(s, file.path()); }),
              HasSubstr(":1:1: with this robot the start is in contact with disc 1"));
  EXPECT_EQ(s.robot.body.radius, 90_mm);
}

TEST(RobotFile, IsTheRobotThatStartAndGoalAreJudgedWith) {
  const TemporaryFile small("body_radius_m = 0.05\nwheel_track_m = 0.08\n");
  const std::string tight =
      std::string(kLeast) + "tolerance_m = 0.003\n[[disc]]\ncenter = [0.38, 0]\nradius_m = 0.3\n";
  EXPECT_THAT(message_of<InputError>([&] { parse_scenario(tight, "text"); }),
              HasSubstr("text:2:1: the start is in contact with disc 1"));
  EXPECT_EQ(parse_scenario(tight, "text", small.path()).robot.body.radius, 50_mm);
  EXPECT_THAT(message_of<InputError>([&] {
                parse_scenario(tight + "[bounds]\nmin = [1, 1]\nmax = [2, 2]\n", "text", small.path());
              }),
              HasSubstr("text:2:1: the start lies outside the bounds"));
}

/// The extreme values of every parameter, as text, in a scenario's [robot].
struct Ends {
  std::vector<std::pair<std::string, std::string>> lines;
  template <class T>
  void number(const char* key, const T&, T low, T high) {
    const ParamUnit unit = unit_of(low);
    lines.emplace_back(key, si_text(low.raw(), unit));
    lines.emplace_back(key, si_text(high.raw(), unit));
  }
  void count(const char* key, const std::int32_t&, std::int32_t low, std::int32_t high) {
    lines.emplace_back(key, std::to_string(low));
    lines.emplace_back(key, std::to_string(high));
  }
  template <class E>
  void choice(const char* key, const E&, const char* const* names, int count) {
    for (int i = 0; i < count; ++i) lines.emplace_back(key, choice_text(names[i], is_boolean(names, count)));
  }
  void derived(const char*) {}
};

TEST(RobotTable, TakesBothEndsOfEveryRange) {
  Ends ends;
  const Params reference;
  for_each_param(reference, ends);
  for (const auto& [key, value] : ends.lines) {
    const std::string message = message_of<InputError>(
        [&, k = key, v = value] { parse_scenario(kLeast + ("[robot]\n" + k + " = " + v + "\n"), "text"); });
    // A relation may be violated, or the start too narrow; the range may not.
    EXPECT_THAT(message, testing::Not(HasSubstr("must be from"))) << key << " = " << value;
  }
}

struct Beyond {
  int tried = 0;
  void refuse(const char* key, std::int64_t raw, ParamUnit unit) {
    ++tried;
    const std::string value = si_text(raw, unit);
    EXPECT_THROW(parse_scenario(kLeast + ("[robot]\n" + std::string(key) + " = " + value + "\n"), "text"),
                 InputError)
        << key << " = " << value;
  }
  template <class T>
  void number(const char* key, const T&, T low, T high) {
    refuse(key, std::int64_t{low.raw()} - 1, unit_of(low));
    refuse(key, std::int64_t{high.raw()} + 1, unit_of(low));
  }
  void count(const char* key, const std::int32_t&, std::int32_t low, std::int32_t high) {
    refuse(key, low - 1, {"", 1, 1});
    refuse(key, high + 1, {"", 1, 1});
  }
  template <class E>
  void choice(const char*, const E&, const char* const*, int) {}
  void derived(const char*) {}
};

TEST(RobotTable, RefusesTheRawUnitBeyondEitherEnd) {
  Beyond beyond;
  const Params reference;
  for_each_param(reference, beyond);
  EXPECT_GT(beyond.tried, 50);
}

TEST(ParamText, OfDegreesMeansWhatTheCoreMeans) {
  for (int degrees = 0; degrees < 180; ++degrees) {
    const Angle angle = Angle::turns(degrees, 360);
    EXPECT_EQ(si_text(angle.raw(), unit_of(angle)), std::to_string(degrees));
    EXPECT_EQ(to_raw(degrees, unit_of(angle)), std::int64_t{angle.raw()});
  }
}

TEST(ParamText, RoundsToTheNearestRawUnit) {
  EXPECT_EQ(to_raw(0.0900004, unit_of(Length{})), 90000);
  EXPECT_EQ(to_raw(0.0900006, unit_of(Length{})), 90001);
  EXPECT_EQ(si_text(90001, unit_of(Length{})), "0.090001");
  EXPECT_EQ(si_text(20000000, unit_of(Acceleration{})), "20");
}

TEST(Relation, IsSaidInWordsForEveryFault) {
  for_each_relation(Params{}, [](ParamFault fault, bool) {
    EXPECT_STRNE(relation(fault).words, "") << name(fault);
    return true;
  });
}

}  // namespace
}  // namespace whisker
