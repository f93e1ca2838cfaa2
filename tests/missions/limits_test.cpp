// Every limit of the wheels holds in every tick, with every planner.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/missions/bench.hpp"

namespace whisker::test {
namespace {

using worlds::Random;

std::vector<PlannerKind> planners_with_usual_maps() {
  std::vector<PlannerKind> kinds;
  for (const PlannerKind kind : planners()) {
    if (kind.map_bytes == 0 || kind == PlannerKind::map) kinds.push_back(kind);
  }
  return kinds;
}

class LimitsOf : public testing::TestWithParam<PlannerKind> {
 protected:
  struct Most {
    double speed = 0;         // m/s, of a wheel
    double acceleration = 0;  // m/s^2, of a wheel
    double turn_rate = 0;     // rad/s
  };
  /// Drives through a world of discs; returns the maximum of the commands.
  Most drive(const Params& robot) {
    EXPECT_EQ(check(robot), ParamFault::none);
    worlds::Options options;
    options.seed = 11;
    Scenario scenario = worlds::generate(worlds::Kind::discs, options);
    scenario.robot = robot;
    Bench bench(scenario, GetParam());
    Most most;
    hal::WheelSpeeds last{};
    while (bench.plant().time() < (must_arrive() ? 1800 : 90) && bench.step(10)) {
      const hal::WheelSpeeds now = bench.status().command;
      const double left = now.left * 1e-4, right = now.right * 1e-4;
      const double track = robot.body.track.raw() * 1e-6;
      most.speed = std::fmax(most.speed, std::fmax(std::fabs(left), std::fabs(right)));
      most.turn_rate = std::fmax(most.turn_rate, std::fabs(right - left) / track);
      const double change =
          std::fmax(std::abs(now.left - last.left), std::abs(now.right - last.right)) * 1e-4;
      most.acceleration = std::fmax(most.acceleration, change / 0.01);
      last = now;
    }
    ended_ = bench.ended();
    return most;
  }
  // The other planners may fail in this world; 90 s are enough to test their limits.
  static bool must_arrive() { return GetParam() == PlannerKind::boundary || GetParam() == PlannerKind::map; }

  std::string ended_;
};

// Resolution of the commands: 0.1 mm/s per wheel.
constexpr double kWire = 0.0001;

TEST_P(LimitsOf, TheWheels) {
  for (const int mm_per_s : {80, 300}) {
    for (const int mrad_per_s : {100, 400, 3000}) {
      for (const int mm_per_s2 : {200, 1000}) {
        Params robot;
        robot.wheels.max_speed = Speed::from_raw(mm_per_s * 1000);
        robot.wheels.max_turn_rate = AngularRate::from_raw(mrad_per_s * 1000);
        robot.wheels.max_acceleration = Acceleration::from_raw(mm_per_s2 * 1000);
        const Most most = drive(robot);
        SCOPED_TRACE(std::to_string(mm_per_s) + " mm/s, " + std::to_string(mrad_per_s) + " mrad/s, " +
                     std::to_string(mm_per_s2) + " mm/s2: " + ended_);
        EXPECT_LE(most.speed, mm_per_s * 1e-3 + kWire);
        EXPECT_LE(most.turn_rate, mrad_per_s * 1e-3 + 2 * kWire / 0.14);
        EXPECT_LE(most.acceleration, mm_per_s2 * 1e-3 + 2 * kWire / 0.01);
        EXPECT_GT(most.turn_rate, 0.8 * std::fmin(mrad_per_s * 1e-3, std::fmin(2.5, mm_per_s * 1e-3 / 0.07)));
        if (must_arrive()) {
          EXPECT_EQ(ended_, "reached");
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Planner, LimitsOf, testing::ValuesIn(planners_with_usual_maps()),
                         [](const auto& of) {
                           std::string text = name(of.param);
                           for (char& c : text) c = c == '-' ? '_' : c;
                           return text;
                         });

// Ticks may be uneven: with accepted gaps the body has no contact, and a gap that is too long is a fault.

/// WHISKER_LONG=1: enough to show a contact rate below one in a thousand.
std::uint64_t missions() { return test::effort(3, 400); }

/// A pattern of accepted gaps.
struct Gaps {
  const char* name;
  int least_ms;
  int most_ms;
  int max_gap_ms = 0;  ///< Params::safety.max_gap; 0: default
};

void PrintTo(const Gaps& gaps, std::ostream* out) { *out << gaps.name; }

class UnevenTicks : public testing::TestWithParam<Gaps> {};

TEST_P(UnevenTicks, BringNoContactAndNoFault) {
  const Gaps gaps = GetParam();
  std::map<std::string, int> ends;
  std::uint64_t contact_seed = 0;
  for (std::uint64_t seed = 1; seed <= missions(); ++seed) {
    worlds::Options options;
    options.seed = 70000 + seed;
    Scenario scenario = worlds::generate(seed % 4 == 0 ? worlds::Kind::rooms : worlds::Kind::discs, options);
    scenario.robot.safety.max_gap = milliseconds(gaps.max_gap_ms);
    Bench bench(scenario, seed % 2 == 0 ? PlannerKind::boundary : PlannerKind::map);
    Random random(seed);
    bench.run(900, [&] { return gaps.least_ms + random.index(gaps.most_ms - gaps.least_ms + 1); });
    ++ends[bench.ended()];
    if (bench.plant().in_contact()) contact_seed = options.seed;
  }
  for (const auto& [end, count] : ends) std::printf("%s %d  ", end.c_str(), count);
  std::printf("\n");
  EXPECT_EQ(ends.count("contact"), 0U) << "for one, seed " << contact_seed;
  EXPECT_EQ(ends.count("fault"), 0U);
  EXPECT_GE(ends["reached"] + ends["running"], static_cast<int>(missions() * 99 / 100));
  EXPECT_GE(ends["reached"], static_cast<int>(missions() * 9 / 10));
}

INSTANTIATE_TEST_SUITE_P(Of, UnevenTicks,
                         testing::Values(Gaps{"steady_1_ms", 1, 1}, Gaps{"steady_10_ms", 10, 10},
                                         Gaps{"steady_15_ms", 15, 15}, Gaps{"steady_20_ms", 20, 20},
                                         Gaps{"steady_40_ms", 40, 40}, Gaps{"steady_60_ms", 60, 60},
                                         Gaps{"from_1_to_37_ms", 1, 37}, Gaps{"from_1_to_60_ms", 1, 60},
                                         Gaps{"steady_20_ms_at_most", 20, 20, 20},
                                         Gaps{"steady_100_ms", 100, 100, 100},
                                         Gaps{"from_1_to_100_ms", 1, 100, 100}),
                         [](const auto& of) { return std::string(of.param.name); });

/// Robots near the reference, but far enough from it that every parameter matters.
Params draw_robot(Random& random) {
  for (;;) {
    Params p;
    p.wheels.max_speed = Speed::from_raw((100 + random.index(500)) * 1000);
    p.wheels.max_acceleration = Acceleration::from_raw((300 + random.index(1200)) * 1000);
    p.wheels.motor_lag = milliseconds(random.index(120));
    p.rangefinders.rate_hz = 20 + random.index(60);
    p.rangefinders.latency = milliseconds(random.index(60));
    p.safety.period = milliseconds(5 + random.index(20));
    p.safety.max_gap = milliseconds(random.index(251));
    if (check(p) == ParamFault::none) return p;
  }
}

TEST(UnevenTicks, BringNoContactToOtherRobots) {
  std::map<std::string, int> ends;
  const std::uint64_t robots = test::effort(4, 1000);
  for (std::uint64_t seed = 1; seed <= robots; ++seed) {
    Random random(seed);
    worlds::Options options;
    options.seed = 80000 + seed;
    Scenario scenario = worlds::generate(worlds::Kind::discs, options);
    scenario.robot = draw_robot(random);
    Bench bench(scenario, seed % 2 == 0 ? PlannerKind::boundary : PlannerKind::map);
    const int most = longest_gap(scenario.robot).raw();
    bench.run(600, [&] { return 1 + random.index(most); });
    ++ends[bench.ended()];
    EXPECT_FALSE(bench.plant().in_contact()) << "seed " << seed << ", gaps to " << most << " ms";
  }
  for (const auto& [end, count] : ends) std::printf("%s %d  ", end.c_str(), count);
  std::printf("\n");
  EXPECT_EQ(ends["reached"] + ends["gave_up"] + ends["running"], static_cast<int>(robots))
      << "the rest are faults";
  EXPECT_GE(ends["reached"], static_cast<int>(robots * 9 / 10));
}

TEST(UnevenTicks, BeyondTheLongestGapTheyAreAFault) {
  for (const int gap : {61, 80, 100}) {
    worlds::Options options;
    options.seed = 5;
    Bench bench(worlds::generate(worlds::Kind::discs, options), PlannerKind::boundary);
    bench.run(10);
    ASSERT_EQ(bench.ended(), "running");
    bench.run(1, [gap] { return gap; });
    EXPECT_EQ(bench.ended(), "clock_jump") << gap;
    for (int i = 0; i < 60; ++i) bench.step(10);
    EXPECT_EQ(bench.status().command.left, 0);
    EXPECT_FALSE(bench.plant().in_contact());
  }
}

}  // namespace
}  // namespace whisker::test
