#include "host/harness/scenario/sensor_models.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/reader.hpp"
#include "host/harness/scenario/sensor_text.hpp"
#include "host/harness/scenario/write.hpp"
#include "tests/scenario/temporary_file.hpp"

namespace whisker {
namespace {

using testing::HasSubstr;

const char kLeast[] = "name = \"n\"\n[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 4\ny_m = 0\n[sensor]\n";
Scenario with(const std::string& keys) { return parse_scenario(kLeast + keys, "text"); }
std::string refusal(const std::string& keys) {
  return message_of<InputError>([&] { with(keys); });
}
Sensor of(std::string_view model) { return with("model = \"" + std::string(model) + "\"\n").sensor; }

TEST(SensorModel, EveryNameLoadsAndIsWrittenBack) {
  for (const std::string_view name : sensor_model_names()) {
    const Scenario s = with("model = \"" + std::string(name) + "\"\n");
    ASSERT_FALSE(s.sensor.model.empty()) << name;
    const std::string text = to_toml(s);
    EXPECT_THAT(text, HasSubstr("model = \"" + std::string(s.sensor.model) + "\"\n"));
    const Scenario again = parse_scenario(text, "written");
    EXPECT_EQ(to_toml(again), text);
    EXPECT_EQ(again.sensor.cone_far_deg, s.sensor.cone_far_deg);
  }
}

// Each figure lies in the range that a file may state.
TEST(SensorModel, EveryFigureMayStandInAFile) {
  for (const std::string_view name : sensor_model_names()) {
    Scenario s = with("model = \"" + std::string(name) + "\"\n");
    s.sensor.model = {};
    const Sensor read = parse_scenario(to_toml(s), "written").sensor;
    EXPECT_EQ(read.cone_deg, s.sensor.cone_deg) << name;
    EXPECT_EQ(read.max_range_m, s.sensor.max_range_m) << name;
    EXPECT_EQ(read.soft_range_m, s.sensor.soft_range_m) << name;
    EXPECT_LE(*read.cone_far_deg, *read.cone_deg) << name;
    EXPECT_LT(*read.min_range_m, *read.max_range_m) << name;
  }
}

TEST(SensorModel, RateAndLatencyStandInTheManual) {
  const std::string manual = read_file(WHISKER_SOURCE_DIR "/docs/scenario.md");
  for (const std::string_view name : sensor_model_names()) {
    const SensorModel& m = *find_sensor_model(name);
    const std::string rate =
        std::to_string(m.rate_hz) + " Hz, " + std::to_string(std::lround(m.latency_s * 1e3)) + " ms |";
    const std::size_t row = manual.find("\n| `" + std::string(m.name) + "` | ");
    ASSERT_NE(row, std::string::npos) << name;
    EXPECT_THAT(manual.substr(row + 1, manual.find('\n', row + 1) - row - 1), testing::EndsWith(rate));
  }
}

TEST(SensorModel, AnAliasMeansTheSame) {
  EXPECT_EQ(of("maxbotix").model, "maxbotix-mb1020");
  EXPECT_EQ(of("maxbotix").max_range_m, 6.45);
  EXPECT_EQ(of("mb1013").max_range_m, 5.0);
  EXPECT_EQ(of("sharp-gp2y0a21").max_range_m, 0.8);
  EXPECT_EQ(of("sharp-gp2y0a41").model, "gp2y0a41");
}

TEST(SensorModel, NamesAreDifferent) {
  const auto names = sensor_model_names();
  EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(find_sensor_model(""), nullptr);
}

TEST(SensorModel, GivesWayToOtherKeysWhereverTheyStand) {
  for (const char* keys : {"cone_deg = 33\nmodel = \"tfmini\"\nlost_is = \"clear\"\n",
                           "model = \"tfmini\"\nlost_is = \"clear\"\ncone_deg = 33\n"}) {
    const Sensor s = with(keys).sensor;
    EXPECT_EQ(s.cone_deg, 33);
    EXPECT_EQ(s.lost_is, Lost::clear);
    EXPECT_EQ(s.max_range_m, 12);
  }
  EXPECT_EQ(of("tfmini").lost_is, Lost::invalid);
}

TEST(SensorModel, DoesNotChangeWhatTheRobotBelieves) {
  const Scenario s = with("model = \"gp2y0a21\"\n");
  EXPECT_EQ(s.robot.rangefinders.max_range, 2_m);
  EXPECT_EQ(s.robot.rangefinders.cone, 25_deg);
}

TEST(SensorModel, OfARobotFileReplacesTheSensorAndKeepsTheSurroundings) {
  const TemporaryFile file("[sensor]\nmodel = \"vl53l0x\"\n");
  Scenario s = with("model = \"hc-sr04\"\nsoft = 0.3\nambient_klux = 5\nskew_deg = 2\nsigma_m = 0.2\n");
  apply_robot_file(s, file.path());
  EXPECT_EQ(s.sensor.model, "vl53l0x");
  EXPECT_EQ(s.sensor.cone_deg, 25);
  EXPECT_EQ(s.sensor.sigma_m, 0.002);
  EXPECT_EQ(s.sensor.soft, 0.3);
  EXPECT_EQ(s.sensor.ambient_klux, 5);
  EXPECT_EQ(s.sensor.skew_deg, 2);
}

TEST(SensorModel, IsFoundHoweverItsNameIsWritten) {
  EXPECT_EQ(with("model = \"HC-SR04\"\n").sensor.model, "hc-sr04");
}

TEST(SensorModel, AnUnknownNameIsRefusedWithTheNearest) {
  EXPECT_EQ(refusal("model = \"VL53L2X\"\n"),
            "text:9:9: unknown sensor model 'VL53L2X'; did you mean 'vl53l0x'?");
  EXPECT_EQ(refusal("model = \"hcsr04\"\n"),
            "text:9:9: unknown sensor model 'hcsr04'; did you mean 'hc-sr04'?");
  EXPECT_EQ(refusal("model = \"vl53l2x\"\n"),
            "text:9:9: unknown sensor model 'vl53l2x'; did you mean 'vl53l0x'?");
  EXPECT_THAT(refusal("model = \"lidar of my own\"\n"),
              HasSubstr("text:9:9: unknown sensor model 'lidar of my own'; it must be hc-sr04, us-100,"));
  EXPECT_THAT(refusal("model = \"\"\n"), HasSubstr("it must be hc-sr04"));
  EXPECT_EQ(refusal("model = 4\n"), "text:9:9: 'model' must be a string, but is an integer");
  EXPECT_EQ(refusal("modell = \"us-100\"\n"),
            "text:9:1: unknown key 'modell' in [sensor]; did you mean 'model'?");
}

TEST(SensorKeys, AreCheckedAgainstEachOther) {
  EXPECT_EQ(refusal("cone_deg = 20\ncone_far_deg = 30\n"),
            "text:10:16: 'cone_far_deg' must be at most cone_deg = 20, but is 30");
  EXPECT_EQ(with("cone_far_deg = 30\n").sensor.cone_far_deg, 30) << "the robot's cone is the limit";
  EXPECT_EQ(refusal("model = \"vl53l0x\"\ncone_far_deg = 30\n"),
            "text:10:16: 'cone_far_deg' must be at most cone_deg = 25, but is 30");
  EXPECT_EQ(with("model = \"hc-sr04\"\ncone_deg = 10\n").sensor.cone_far_deg, 10) << "of the model, narrowed";
  EXPECT_EQ(refusal("min_range_m = 1\nmax_range_m = 1\n"),
            "text:9:15: 'min_range_m' must be below 'max_range_m', but 1 is not below 1");
  EXPECT_EQ(refusal("model = \"tfmini\"\nmax_range_m = 0.2\n"),
            "text:10:15: 'min_range_m' must be below 'max_range_m', but 0.3 is not below 0.2");
  EXPECT_EQ(refusal("lost_is = \"gone\"\n"), "text:9:11: 'lost_is' must be clear or invalid, but is 'gone'");
}

TEST(SensorKeys, EachHasItsRange) {
  const struct {
    const char* key;
    const char* too_small;
    const char* too_large;
  } keys[] = {{"cone_far_deg", "0.4", "171"},
              {"corner_scatter_m", "-0.1", "1001"},
              {"min_range_m", "-0.1", "11"},
              {"max_range_m", "0", "61"},
              {"sigma_m", "-0.1", "11"},
              {"sigma_share", "-0.1", "1.1"},
              {"soft", "-0.1", "1.1"},
              {"soft_range_m", "-0.1", "1001"},
              {"reflectance", "-0.1", "1.1"},
              {"reflectance_reference", "-0.1", "1.1"},
              {"ambient_klux", "-0.1", "201"},
              {"ambient_knee_klux", "-0.1", "201"},
              {"cover_glass_probability", "-0.1", "1.1"},
              {"cover_glass_m", "-0.1", "1.1"}};
  for (const auto& k : keys) {
    for (const char* x : {k.too_small, k.too_large}) {
      EXPECT_THAT(refusal(std::string(k.key) + " = " + x + "\n"),
                  HasSubstr(std::string("'") + k.key + "' must be "))
          << x;
    }
    EXPECT_NO_THROW(with(std::string(k.key) + " = 0.5\n")) << k.key;
  }
}

TEST(SensorKeys, AndModelsAreInTheManuals) {
  const std::string scenario = read_file(WHISKER_SOURCE_DIR "/docs/scenario.md");
  for (const std::string_view key : sensor_keys()) {
    EXPECT_THAT(scenario, HasSubstr("| `" + std::string(key) + "` |"));
  }
  const std::string simulator = read_file(WHISKER_SOURCE_DIR "/docs/scenario.md");
  for (const std::string_view name : sensor_model_names()) {
    EXPECT_THAT(simulator, HasSubstr("`" + std::string(name) + "`"));
  }
}

}  // namespace
}  // namespace whisker
