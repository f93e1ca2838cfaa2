#include "host/harness/socket/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "host/harness/run/fix_source.hpp"
#include "host/harness/run/pilot.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/sim/elementary.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/unseen_disc.hpp"

namespace whisker::socket {
namespace {

using Json = nlohmann::json;

Json range_of(const hal::RangeReading& r) {
  switch (r.status) {
    case hal::RangeStatus::ok: return r.mm / 1000.0;
    case hal::RangeStatus::clear: return "clear";
    case hal::RangeStatus::too_near: return "too_near";
    case hal::RangeStatus::invalid: return "invalid";
    case hal::RangeStatus::stale: break;
  }
  return nullptr;
}

Json json_of(const localization::UncertainPose& fix) {
  const auto metres = [](Length l) { return l.raw() * 1e-6; };
  const auto degrees = [](Angle a) { return a.wrapped() * (360 / 4294967296.0); };
  return {{"x_m", metres(fix.pose.at.x)},
          {"y_m", metres(fix.pose.at.y)},
          {"heading_deg", degrees(fix.pose.heading)},
          {"sigma_along_m", metres(fix.sigma.along)},
          {"sigma_across_m", metres(fix.sigma.across)},
          {"sigma_heading_deg", degrees(fix.sigma.heading)}};
}

/// The core behind the lines of a simulator.
class SocketPilot final : public Pilot {
 public:
  SocketPilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant)
      : plant_(plant), fixes_(scenario), session_({scenario.robot, planner, {}, {}}, "test") {
    Json hello;
    hello["whisker"] = 1;
    hello["start"] = {{"x_m", scenario.start.at.x},
                      {"y_m", scenario.start.at.y},
                      {"heading_deg", scenario.start.heading * 180 / sim::kPi}};
    hello["goal"] = {
        {"x_m", scenario.goal.at.x}, {"y_m", scenario.goal.at.y}, {"tolerance_m", scenario.goal.tolerance_m}};
    session_.answer(hello.dump(), 0);
  }

  const Status& tick(Time now) override {
    const hal::RangeReadings ranges = plant_.ranges();
    Json line;
    line["t_s"] = now.raw() / 1000.0;
    for (int i = 0; i < hal::kBeams; ++i) {
      const hal::RangeReading& r = ranges.beam[i];
      const bool fresh = r.status != hal::RangeStatus::stale && (!seen_ || r.sequence != sequence_[i]);
      line["range_m"].push_back(fresh ? range_of(r) : Json());
      line["age_s"].push_back(fresh ? r.age_ms / 1000.0 : 0.0);
      sequence_[i] = r.sequence;
    }
    seen_ = true;
    line["counts"] = {plant_.encoders().left, plant_.encoders().right};
    line["pressed"] = Json::array();
    for (int i = 0; i < hal::kBeams; ++i) {
      constexpr const char* kNames[] = {"left", "front", "right"};
      if ((plant_.bumper().pressed >> i & 1) != 0) line["pressed"].push_back(kNames[i]);
    }
    if (plant_.gyro_answers()) {
      const hal::GyroReading gyro = plant_.gyro();
      line["gyro"] = {{"sum", static_cast<std::int32_t>(gyro.sum)}, {"samples", gyro.samples}};
      if (gyro.saturated != 0) line["gyro"]["saturated"] = gyro.saturated;
    }
    const auto fix = fixes_.take(plant_);
    if (fix) line["fix"] = json_of(*fix);
    const std::string text = line.dump();
    const std::string said = session_.answer(text, 0);
    EXPECT_EQ(session_.answer(text, 0), said) << "the same time again";
    EXPECT_EQ(Json::parse(said).contains("fix"), fix.has_value());
    take(Json::parse(said));
    return status_;
  }

 private:
  void take(const Json& answer) {
    const auto tenths = [&](std::size_t side) {
      return static_cast<std::int16_t>(std::lround(answer["wheel_mps"][side].get<double>() * 1e4));
    };
    status_.command = {tenths(0), tenths(1)};
    plant_.command(status_.command);
    const auto outcome = answer["outcome"].get<std::string>();
    status_.decision.outcome = outcome == "reached"       ? planning::Outcome::reached
                               : outcome == "unreachable" ? planning::Outcome::unreachable
                               : outcome == "gave_up"     ? planning::Outcome::gave_up
                                                          : planning::Outcome::running;
    EXPECT_THAT(outcome, testing::AnyOf("running", "reached", "unreachable", "gave_up"));
    const auto length = [&](const char* key) {
      return Length::from_raw(
          static_cast<std::int32_t>(std::lround(answer["pose"][key].get<double>() * 1e6)));
    };
    status_.pose.at = {length("x_m"), length("y_m")};
  }

  sim::Plant& plant_;
  FixSource fixes_;
  Session session_;
  Status status_;
  bool seen_ = false;
  std::uint8_t sequence_[hal::kBeams] = {};
};

std::unique_ptr<Pilot> over_socket(const Scenario& s, PlannerKind k, sim::Plant& p) {
  return std::make_unique<SocketPilot>(s, k, p);
}

void expect_same(const Scenario& scenario) {
  const RunResult direct = run(scenario);
  RunOptions options;
  options.pilot = over_socket;
  const RunResult through = run(scenario, options);
  EXPECT_EQ(through.hash, direct.hash) << scenario.name;
  EXPECT_EQ(through.verdict, direct.verdict);
  EXPECT_EQ(through.ticks, direct.ticks);
  EXPECT_NEAR(*through.believed_distance_m, *direct.believed_distance_m, 1e-6);
}

TEST(Session, DrivesBitForBitAsTheCoreInThisProcess) {
  for (const worlds::Kind kind : {worlds::Kind::discs, worlds::Kind::maze, worlds::Kind::u_trap}) {
    worlds::Options options;
    options.seed = 11;
    options.noise = true;
    Scenario scenario = worlds::generate(kind, options);
    expect_same(scenario);
    scenario.robot.rangefinders.max_range = 1200_mm;
    scenario.sensor.max_range_m = 2;
    scenario.sensor.far_is = Far::distance;
    expect_same(scenario);
  }
}

TEST(Session, HandsTheBumperOn) { expect_same(test::unseen_disc()); }

TEST(Session, HandsTheGyroAndFixesOn) {
  Scenario scenario = worlds::generate(worlds::Kind::discs, {11, 30, false, true, 0.02});
  scenario.noise.gyro_bias_dps = 1;
  scenario.noise.fix_every_m = 1;
  scenario.noise.fix_sigma_m = 0.01;
  scenario.noise.fix_sigma_deg = 0.5;
  scenario.robot.pose_error.wheel_scale = millionths(3000);
  for (const Fitted gyro : {Fitted::no, Fitted::yes}) {
    scenario.robot.gyro.fitted = gyro;
    expect_same(scenario);
  }
}

TEST(Session, AnswersWhatBecameOfAFix) {
  Session session({}, "");
  session.answer(
      R"({"whisker": 1, "robot": {"wheel_scale_sigma": 0.005, "fix_jumps": "refuse", "gyro": true}})", 0);
  const auto with_fix = [&](double x, std::uint32_t now) {
    Json line = {{"counts", {0, 0}}};
    line["fix"] = {{"x_m", x},
                   {"y_m", 0},
                   {"heading_deg", 0},
                   {"sigma_along_m", 0.01},
                   {"sigma_across_m", 0.02},
                   {"sigma_heading_deg", 1}};
    return Json::parse(session.answer(line.dump(), now));
  };
  const Json near = with_fix(0, 10);
  EXPECT_EQ(near["fix"], Json({{"accepted", true}, {"jumps", 0}, {"refused", 0}}));
  EXPECT_LT(near["sigma"]["along_m"], 0.01) << "less than that of the fix";
  EXPECT_LT(near["sigma"]["along_m"], near["sigma"]["across_m"]);
  const Json far = with_fix(5, 20);
  EXPECT_EQ(far["fix"], Json({{"accepted", false}, {"jumps", 1}, {"refused", 1}}));
  EXPECT_EQ(far["pose"]["x_m"], 0);
  Json later;
  for (std::uint32_t now = 30; now < 200; now += 10)
    later = Json::parse(session.answer(R"({"counts": [0, 0]})", now));
  EXPECT_FALSE(later.contains("fix"));
  EXPECT_TRUE(session.result()->run.sigma.has_value());
  EXPECT_EQ(later["heading_source"], "gyro_lost");
}

TEST(Session, SaysNothingOfWhatTheRobotDoesNotHave) {
  Session session({}, "");
  EXPECT_FALSE(Json::parse(session.answer(R"({"whisker": 1})", 0)).contains("gyro"));
  const Json answer = Json::parse(session.answer(R"({"counts": [0, 0]})", 10));
  for (const char* key : {"sigma", "heading_source", "fix"}) EXPECT_FALSE(answer.contains(key)) << key;
}

TEST(Session, GreetsWithTheGyro) {
  Session session({}, "");
  const Json hello = Json::parse(session.answer(R"({"whisker": 1, "robot": {"gyro": true}})", 0));
  EXPECT_EQ(hello["gyro"]["rate_hz"], 100);
  EXPECT_NEAR(hello["gyro"]["range_radps"], 8.726646, 1e-9);
}

TEST(Session, GreetsWithTheRobotThatItDrives) {
  Session session({}, "1.2.3");
  const Json hello = Json::parse(session.answer(
      R"({"whisker": 1, "robot": {"body_radius_m": 0.1, "range_cone_deg": 30}, "planner": "skirt"})", 0));
  EXPECT_EQ(hello["version"], "1.2.3");
  EXPECT_EQ(hello["planner"], "boundary") << "the name of the documents";
  EXPECT_EQ(hello["body_radius_m"], 0.1);
  EXPECT_EQ(hello["period_s"], 0.01);
  EXPECT_EQ(hello["wheel_speed_max_mps"], 0.3);
  EXPECT_EQ(hello["wheel_acceleration_max_mps2"], 1.0);
  EXPECT_EQ(hello["motor_lag_s"], 0.05);
  EXPECT_EQ(hello["range_latency_s"], 0.02);
  ASSERT_EQ(hello["beams"].size(), 3U);
  EXPECT_EQ(hello["beams"][0]["angle_deg"], 30.0);
  EXPECT_EQ(hello["beams"][2]["cone_deg"], 30.0);
}

TEST(Session, AnswersTheFirstLineAgainUntilTheFirstTick) {
  Session session({}, "1");
  const std::string opening = R"({"whisker": 1})";
  const std::string greeting = session.answer(opening, 0);
  EXPECT_EQ(session.answer(opening, 10), greeting);
  EXPECT_NE(session.answer(R"({"t_s": 0.02})", 20), greeting);
  EXPECT_THROW(session.answer(opening, 30), ProtocolError);
}

TEST(Session, WhatASimulatorLeavesOutLeadsToANamedFault) {
  Session session({}, "");
  session.answer(R"({"whisker": 1, "goal": {"x_m": 3, "y_m": 0}})", 0);
  std::string fault;
  for (std::uint32_t now = 0; now < 3000 && fault != "drive_refused"; now += 10) {
    fault = Json::parse(session.answer("{}", now))["fault"];
  }
  EXPECT_EQ(fault, "drive_refused");
  EXPECT_EQ(session.result()->run.verdict, Verdict::fault);
  EXPECT_STREQ(session.result()->outcome, "fault");
  EXPECT_EQ(session.result()->run.detail, "drive_refused");
}

TEST(Session, TheTimeOfArrivalCountsWithoutATime) {
  Session session({}, "");
  session.answer(R"({"whisker": 1})", 0);
  EXPECT_EQ(Json::parse(session.answer("{}", 40))["t_s"], 0.04);
  EXPECT_EQ(Json::parse(session.answer("{}", 50))["t_s"], 0.05);
  EXPECT_EQ(Json::parse(session.answer("{}", 5000))["fault"], "clock_jump");
}

/// The fault of a robot that is told these counts of its left wheel, one after the other.
std::string fault_of(const std::vector<std::int64_t>& counts) {
  Session session({}, "");
  session.answer(R"({"whisker": 1})", 0);
  std::uint32_t now = 0;
  Json answer;
  for (const std::int64_t count : counts) {
    answer = Json::parse(session.answer(Json{{"counts", {count, 0}}}.dump(), now += 10));
  }
  return answer["fault"];
}

TEST(Session, AJumpOfTheCountsIsOneHoweverFar) {
  for (const std::int64_t jump : {std::int64_t{1} << 20, std::int64_t{1} << 23, std::int64_t{1} << 24,
                                  std::int64_t{3} << 24, std::int64_t{1} << 32, std::int64_t{1} << 52}) {
    for (const std::int64_t from : {-5, 0, 5}) {
      EXPECT_EQ(fault_of({from, from + jump}), "encoder_jump") << jump;
      EXPECT_EQ(fault_of({from, from - jump}), "encoder_jump") << -jump;
    }
  }
}

TEST(Session, CountersMayWrap) {
  for (const int bits : {24, 32}) {
    const std::int64_t all = std::int64_t{1} << bits;
    EXPECT_EQ(fault_of({all - 2, 1, all - 1}), "none") << bits;
    EXPECT_EQ(fault_of({all / 2 - 2, -all / 2 + 1, all / 2 - 1}), "none") << bits;
  }
}

TEST(Session, OneReadingThatIsNoneEndsNoMission) {
  Session session({}, "");
  session.answer(R"({"whisker": 1, "goal": {"x_m": 6, "y_m": 0}})", 0);
  for (std::uint32_t now = 10; now <= 3000; now += 10) {
    const char* const front = now % 100 != 0   ? "1.9"
                              : now % 200 != 0 ? "65.535"
                              : now % 400 != 0 ? "NaN"
                                               : "Infinity";
    const std::string line = std::string(R"({"counts": [0, 0], "range_m": [1.9, )") + front + ", 1.9]}";
    const Json answer = Json::parse(session.answer(line, now));
    if (answer["fault"] == "wheels_stalled") break;  // the wheels of this test stand still
    ASSERT_EQ(answer["fault"], "none") << now;
  }
}

TEST(Session, TakesCommandsWithATick) {
  Session session({}, "");
  session.answer(R"({"whisker": 1})", 0);
  const auto outcome = [&](const std::string& line, std::uint32_t now) {
    return Json::parse(session.answer(line, now))["outcome"].get<std::string>();
  };
  EXPECT_EQ(outcome(R"({"counts": [0, 0]})", 10), "idle");
  EXPECT_EQ(outcome(R"({"counts": [0, 0], "goal": {"x_m": 1, "y_m": 2}})", 20), "running");
  EXPECT_EQ(outcome(R"({"counts": [0, 0], "cancel": true})", 30), "idle");
  const Json placed = Json::parse(
      session.answer(R"({"counts": [0, 0], "place": {"x_m": 1, "y_m": 2, "heading_deg": 90}})", 40));
  EXPECT_EQ(placed["pose"]["x_m"], 1.0);
  EXPECT_EQ(placed["pose"]["heading_deg"], 90.0);
  EXPECT_EQ(outcome("{}", 9000), "fault");
  EXPECT_EQ(outcome(R"({"counts": [0, 0], "reset": true})", 9010), "idle");
}

TEST(Session, TheEndSaysWhyThereIsNoMission) {
  Session session({}, "");
  session.answer(R"({"whisker": 1})", 0);
  EXPECT_FALSE(session.result().has_value());
  const auto end = [&](const std::string& line, std::uint32_t now) {
    session.answer(line, now);
    const auto result = session.result();
    EXPECT_EQ(result->run.verdict, Verdict::gave_up) << "for the exit status";
    return std::string(result->outcome) + " " + result->run.detail;
  };
  EXPECT_EQ(end(R"({"counts": [0, 0]})", 10), "idle no_goal");
  EXPECT_THAT(end(R"({"counts": [0, 0], "goal": {"x_m": 1, "y_m": 2}})", 20),
              testing::StartsWith("running "));
  EXPECT_EQ(end(R"({"counts": [0, 0], "cancel": true})", 30), "idle cancelled");
  EXPECT_EQ(end(R"({"counts": [0, 0]})", 40), "idle cancelled");
}

}  // namespace
}  // namespace whisker::socket
