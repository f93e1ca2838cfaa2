// Logs of a spin: a trace and a candump log.
#include "host/lab/calibration/log.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "firmware/can/codec.hpp"
#include "firmware/can/fix.hpp"
#include "host/harness/hil/candump.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/lab/calibration/calibration.hpp"
#include "host/lab/calibration/simulated.hpp"
#include "host/lab/report/trace.hpp"

namespace whisker::calibration {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string complaint(const std::string& text) {
  std::istringstream in(text);
  try {
    read_trace(in, "spin.csv", {});
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

constexpr const char* kHead = "t_s,heading_rad,left_m,front_m,right_m\n";

TEST(Sample, ADistanceBeyondTheBelievedRangeIsClear) {
  const Believed beam = believed(Params{}, hal::kFront);
  Sample sample;
  ASSERT_TRUE(sample_of({1999, hal::RangeStatus::ok, 0, 0}, beam, sample));
  EXPECT_EQ(sample.reading, Reading::echo);
  ASSERT_TRUE(sample_of({2500, hal::RangeStatus::ok, 0, 0}, beam, sample));
  EXPECT_EQ(sample.reading, Reading::clear);
}

TEST(TraceLog, SaysTheSameAsTheSpin) {
  for (const int rate : {50, 20}) {
    Params p;
    p.rangefinders.rate_hz = rate;
    Sensor sensor;
    sensor.incidence_deg = 50;
    sensor.skew_deg = 4;
    sensor.phantom = 0.3;
    const Scenario s = wall_scenario(p, sensor, {0.01, 0.1, 0, 0, 0}, 0.3);
    RunLog spin({s});
    const Sweep direct = simulated_spin(s, p, robot_spec(s), 1, 0, &spin);
    std::istringstream in(report::trace_csv(spin));
    const Log log = read_trace(in, "spin.csv", p);
    EXPECT_NEAR(log.start_deg, 0, 1e-3);
    for (std::size_t i = 0; i < log.sweep.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(log.sweep[i].size()), static_cast<double>(direct[i].size()),
                  0.02 * static_cast<double>(direct[i].size()));
      const Believed b = believed(p, static_cast<int>(i));
      const BeamFit f = fit_beam(log.sweep[i], b, 0), g = fit_beam(direct[i], b, 0);
      ASSERT_EQ(f.trouble, Trouble::none);
      EXPECT_NEAR(f.axis_deg, g.axis_deg, 0.5) << rate << " Hz, beam " << i;
      EXPECT_NEAR(f.edge_deg, g.edge_deg, 0.6) << rate << " Hz, beam " << i;
    }
  }
}

TEST(TraceLog, ReadsTheColumnsByName) {
  std::istringstream in(
      "right_m,x,t_s,left_m,est_heading_rad,front_m\r\n0.3,,0,,1,2\r\n\r\n0.4,,0.1,0.02,1,2\r\n");
  const Log log = read_trace(in, "spin.csv", {});
  EXPECT_NEAR(log.start_deg, 180 / 3.14159265, 1e-4);
  ASSERT_EQ(log.sweep[0].size(), 2U);
  EXPECT_EQ(log.sweep[0][0].reading, Reading::lost);
  EXPECT_EQ(log.sweep[1][0].reading, Reading::clear);
  EXPECT_EQ(log.sweep[2][1].metres, 0.4);
}

TEST(TraceLog, AnEmptyEstimateMeansTheOtherHeading) {
  std::istringstream in("t_s,est_heading_rad,heading_rad,left_m,front_m,right_m\n0,,2,,,\n0.1,,2,,,\n");
  EXPECT_NEAR(read_trace(in, "spin.csv", {}).start_deg, 360 / 3.14159265, 1e-4);
}

TEST(TraceLog, HeadingsThatJumpByATurnGoOn) {
  std::string text = kHead;
  for (int i = 0; i < 200; ++i) {
    const double heading = std::remainder(0.05 * i, 6.283185307179586);
    text += std::to_string(0.02 * i) + "," + std::to_string(heading) + ",1,1,1\n";
  }
  std::istringstream in(text);
  const Log log = read_trace(in, "spin.csv", {});
  EXPECT_NEAR(log.sweep[0].back().heading_rad, 0.05 * 199, 0.12);
}

TEST(TraceLog, NamesWhatIsWrong) {
  EXPECT_THAT(complaint(""), StartsWith("spin.csv:1:1: the file is empty"));
  EXPECT_THAT(complaint("t_s,heading_rad,left_m,right_m\n0,0,1,1\n"),
              StartsWith("spin.csv:1:1: no column 'front_m'"));
  EXPECT_THAT(complaint("t_s,left_m,front_m,right_m\n"), StartsWith("spin.csv:1:1: no column 'heading_rad'"));
  EXPECT_THAT(complaint(kHead), HasSubstr("a trace without rows"));
  const std::string one = std::string(kHead) + "0,0,1,1,1\n";
  EXPECT_THAT(complaint(one + "0.1,0,1,1\n"), StartsWith("spin.csv:3:1: 4 fields; the header has 5"));
  EXPECT_THAT(complaint(one + "0.1,0,1,one,1\n"), StartsWith("spin.csv:3:4: 'one' is no number"));
  EXPECT_THAT(complaint(one + "0.1,0,1,nan,1\n"), StartsWith("spin.csv:3:4: 'nan' is no number"));
  EXPECT_THAT(complaint(one + "0.1,,1,1,1\n"), StartsWith("spin.csv:3:2: '' is no number"));
  EXPECT_THAT(complaint(one + "0.1,0,1,-1,1\n"), StartsWith("spin.csv:3:4: a distance below 0"));
  EXPECT_THAT(complaint(one + "0,0,1,1,1\n"), StartsWith("spin.csv:3:1: t_s does not rise"));
}

/// A log of 50 input sets; with the frames that a gyro and a fix add, or not.
std::string candump_text(bool gyro, bool fix) {
  std::string text;
  const auto line = [&](const auto& message) {
    text += hil::log_line({0, "can0", can::encode(message, 9, 0)}) + "\n";
  };
  for (std::uint16_t tick = 1; tick <= 50; ++tick) {
    const hal::RangeReading reading{500, hal::RangeStatus::ok, 10, static_cast<std::uint8_t>(tick % 16)};
    const auto tick8 = static_cast<std::uint8_t>(tick % 8);
    line(can::Range<can::MessageKind::range_left>{reading, tick});
    line(can::Range<can::MessageKind::range_front>{reading, tick});
    line(can::Range<can::MessageKind::range_right>{reading, tick});
    line(can::WheelState{1, tick8, {tick, tick}});
    if (gyro) line(can::GyroState{1, tick8, {}});
    for (int i = 0; fix && i < can::kFixValues; ++i)
      line(can::FixValue{static_cast<can::FixPart>(i), tick, 1});
    can::Sync sync{can::SyncMode::real_time, tick, 10, 1};
    sync.gyro = gyro ? 1 : 0;
    sync.fix = fix ? 1 : 0;
    line(sync);
  }
  return text;
}

TEST(CandumpLog, HasTheSameReadingsWithAGyroAndFixes) {
  const auto readings = [](bool gyro, bool fix) {
    std::istringstream in(candump_text(gyro, fix));
    return read_candump(in, "spin.log", {}, 0).sweep[1].size();
  };
  EXPECT_GT(readings(false, false), 40U);
  EXPECT_EQ(readings(true, false), readings(false, false));
  EXPECT_EQ(readings(true, true), readings(false, false));
}

TEST(CandumpLog, NamesWhatIsWrong) {
  const auto told = [](const std::string& text, int robot) -> std::string {
    std::istringstream in(text);
    try {
      read_candump(in, "spin.log", {}, robot);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(told("(1.000000) can0 123#\nrubbish\n", 0), StartsWith("spin.log:2:1: not a frame as candump"));
  EXPECT_THAT(told("(1.000000) can0 123#\n", 0), HasSubstr("no input sets of a robot's base"));
  EXPECT_THAT(told("(1.000000) can0 123#\n(1.0", 3), HasSubstr("no input sets of the base of robot 3"));
}

}  // namespace
}  // namespace whisker::calibration
