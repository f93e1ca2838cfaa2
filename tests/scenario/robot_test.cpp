#include <gmock/gmock.h>

#include "host/scenario/load.hpp"
#include "host/scenario/params_text.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

using testing::HasSubstr;

const char kLeast[] = "name = \"n\"\n[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 4\ny_m = 0\n";

TEST(RobotFile, SetsWhatItNamesAndLeavesTheRest) {
  const TemporaryFile file("body_radius_m = 0.12\n[robot]\nrange_max_m = 3\n");
  Params params;
  params.safety.max_refusals = 9;
  apply_robot_file(params, file.path());
  EXPECT_EQ(params.body.radius, 120_mm);
  EXPECT_EQ(params.rangefinders.max_range, 3_m);
  EXPECT_EQ(params.safety.max_refusals, 9);
}

TEST(RobotFile, WithAnErrorChangesNothing) {
  const TemporaryFile file("body_radius_m = 0.12\nwheel_track_m = 0.5\n");
  Params params;
  EXPECT_EQ(message_of<InputError>([&] { apply_robot_file(params, file.path()); }),
            file.path() + ":1:1: the wheels must lie within the body: wheel_track_m <= 2 body_radius_m");
  EXPECT_EQ(params.body.radius, 90_mm);
}

TEST(RobotFile, ThatSetsAParameterTwiceIsRefused) {
  const TemporaryFile file("range_max_m = 3\n[robot]\nrange_max_m = 4\n");
  Params params;
  EXPECT_EQ(message_of<InputError>([&] { apply_robot_file(params, file.path()); }),
            file.path() + ":3:15: 'range_max_m' is set both at the top level and in [robot]");
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
    for (int i = 0; i < count; ++i) lines.emplace_back(key, '"' + std::string(names[i]) + '"');
  }
};

TEST(RobotTable, TakesBothEndsOfEveryRange) {
  Ends ends;
  const Params reference;
  for_each_param(reference, ends);
  for (const auto& [key, value] : ends.lines) {
    const std::string message = message_of<InputError>(
        [&, k = key, v = value] { parse_scenario(kLeast + ("[robot]\n" + k + " = " + v + "\n"), "text"); });
    // A relation may be broken, or the start too tight; the range is not.
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
  for (int i = 1; i <= static_cast<int>(ParamFault::step_beyond_range); ++i) {
    EXPECT_STRNE(relation(static_cast<ParamFault>(i)), "") << i;
  }
}

}  // namespace
}  // namespace whisker
