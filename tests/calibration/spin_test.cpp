#include "host/lab/calibration/spin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "host/harness/scenario/bearing.hpp"
#include "host/lab/calibration/sample.hpp"
#include "host/lab/calibration/simulated.hpp"
#include "tests/effort.hpp"

namespace whisker::calibration {
namespace {

/// A body that turns as its wheels say.
struct Body {
  double turned = 0;
  double most = 0;
  double least = 0;
  double t_s = 0;

  void drive(Spin& spin, const Params& p, double share = 1) {
    while (!spin.done() && !spin.failed() && t_s < 1000) {
      const hal::WheelSpeeds v = spin.step(turned, 0, t_s);
      EXPECT_EQ(v.left, -v.right) << "on the spot";
      turned += share * (v.right - v.left) * 1e-4 / (p.body.track.raw() * 1e-6) * 0.01;
      most = std::max(most, turned);
      least = std::min(least, turned);
      t_s += 0.01;
    }
  }
};

TEST(Spin, TurnsMoreThanHalfAroundToEachSide) {
  const Params p;
  Spin spin(p);
  Body body;
  body.drive(spin, p);
  EXPECT_TRUE(spin.done());
  EXPECT_NEAR(body.most / kRadPerDeg, 190, 1);
  EXPECT_NEAR(body.least / kRadPerDeg, -190, 1);
  EXPECT_NEAR(body.turned / kRadPerDeg, 0, 1);
  EXPECT_NEAR(body.t_s, spin.duration_s(), 0.5);
}

TEST(Spin, DrivesAlongTheWallToASecondTurn) {
  const Params p;
  Spin spin(p, 0.2);
  double turned = 0, x = 0, y = 0, least = 0, most = 0, t_s = 0;
  for (; !spin.done() && !spin.failed() && t_s < 1000; t_s += 0.01) {
    const hal::WheelSpeeds v = spin.step(turned, std::hypot(x, y), t_s);
    turned += (v.right - v.left) * 1e-4 / (p.body.track.raw() * 1e-6) * 0.01;
    x += std::cos(turned) * (v.left + v.right) * 0.5e-4 * 0.01;
    y += std::sin(turned) * (v.left + v.right) * 0.5e-4 * 0.01;
    least = std::min(least, turned);
    most = std::max(most, turned);
  }
  EXPECT_TRUE(spin.done());
  EXPECT_NEAR(x, 0, 0.01);
  EXPECT_NEAR(y, -0.2, 0.01) << "to the right";
  EXPECT_NEAR(turned / kRadPerDeg, 0, 1);
  EXPECT_NEAR(most / kRadPerDeg, 190, 1);
  EXPECT_NEAR(least / kRadPerDeg, -190, 1);
  EXPECT_NEAR(t_s, spin.duration_s(), 0.5);
}

TEST(Spin, SlowSensorsTurnTheBodySlowly) {
  Params slow;
  slow.rangefinders.rate_hz = 20;
  EXPECT_NEAR(Spin(slow).duration_s(), 2 * 380 / 10.0 + 2, 0.1) << "half a degree a measurement";
  slow.rangefinders.rate_hz = 5;
  EXPECT_NEAR(Spin(slow).duration_s(), 2 * 380 / 8.0 + 2, 0.1) << "the slowest";
}

TEST(Spin, FailsIfTheWheelsDoNotTurn) {
  const Params p;
  Spin spin(p);
  Body body;
  body.drive(spin, p, 0.3);
  EXPECT_TRUE(spin.failed());
  EXPECT_FALSE(spin.done());
  EXPECT_EQ(spin.step(1, 0, body.t_s + 1).left, 0);
}

hal::RangeReadings readings(hal::RangeReading r) { return {{r, r, r}}; }

TEST(Collector, TakesEachMeasurementOnceAtItsTime) {
  Collector c{Params{}};
  for (int tick = 0; tick < 10; ++tick) {
    const auto sequence = static_cast<std::uint8_t>(tick / 2);
    const auto age = static_cast<std::uint8_t>(15 + 10 * (tick % 2));
    c.add(0.01 * tick, {{}, Angle::turns(tick, 360)}, readings({300, hal::RangeStatus::ok, age, sequence}));
  }
  ASSERT_EQ(c.sweep()[0].size(), 4U) << "five, of which the first is older than the first tick";
  EXPECT_NEAR(c.sweep()[0][0].heading_rad / kRadPerDeg, 2 - 1.5, 1e-6);
  EXPECT_NEAR(c.sweep()[2][3].heading_rad / kRadPerDeg, 8 - 1.5, 1e-6);
  EXPECT_EQ(c.sweep()[1][0].metres, 0.3);
}

TEST(Collector, HeadingsGoOnBeyondATurn) {
  Collector c{Params{}};
  for (int tick = 0; tick < 500; ++tick) {
    c.add(0.01 * tick, {{}, Angle::turns(tick, 360)}, readings({0, hal::RangeStatus::clear, 0, 0}));
  }
  EXPECT_NEAR(c.turned_rad() / kRadPerDeg, 499, 1e-5);
}

TEST(Collector, TellsTheStatusesApart) {
  Collector c{Params{}};
  using S = hal::RangeStatus;
  std::uint8_t sequence = 0;
  for (const S status : {S::ok, S::clear, S::too_near, S::invalid, S::stale}) {
    c.add(0.01 * sequence, {}, readings({500, status, 0, sequence}));
    ++sequence;
  }
  c.add(1, {}, readings({500, S::ok, 255, sequence}));
  const Samples& s = c.sweep()[0];
  ASSERT_EQ(s.size(), 4U) << "no stale one, and none of unknown age";
  EXPECT_EQ(s[0].metres, 0.5);
  EXPECT_EQ(s[1].reading, Reading::clear);
  EXPECT_EQ(s[2].metres, 0.02) << "at the minimum range";
  EXPECT_EQ(s[3].reading, Reading::lost);
}

// The accuracy over random mounts, skews, cones and incidences.

/// Another one repeats or continues: WHISKER_SEED=1000.
std::uint64_t first_seed() {
  const char* const given = std::getenv("WHISKER_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : 1;
}

struct Difference {
  double degrees = 0;
  double error = 0;  ///< as estimated
  std::uint64_t seed = 0;
};

double quantile(std::vector<Difference> all, std::size_t percent) {
  std::sort(all.begin(), all.end(),
            [](auto& a, auto& b) { return std::fabs(a.degrees) < std::fabs(b.degrees); });
  return std::fabs(all[(all.size() - 1) * percent / 100].degrees);
}

void expect_accuracy(const char* name, const std::vector<Difference>& all, double p50, double most) {
  ASSERT_FALSE(all.empty()) << name;
  std::size_t within = 0;
  for (const Difference& d : all) {
    EXPECT_LE(std::fabs(d.degrees), most) << name << ", WHISKER_SEED=" << d.seed;
    within += std::fabs(d.degrees) <= 2 * d.error ? 1 : 0;
  }
  EXPECT_LE(quantile(all, 50), p50) << name;
  EXPECT_GE(100 * within, 93 * all.size()) << name << ": the estimated errors are too small";
}

TEST(Trials, AreAsAccurateAsTheManualSays) {
  const Noise noise{0.01, 0.1, 0, 0, 0};
  const std::uint64_t first = first_seed(), count = test::effort(7, 1000);
  RecordProperty("first_seed", std::to_string(first));
  std::vector<Difference> axis, cone, edge, incidence;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const TrialResult r = run(random_trial(noise, 0.3, 0, seed));
    for (std::size_t i = 0; i < r.truth.size(); ++i) {
      const BeamFit& f = r.measured.fits[i];
      const Truth& t = r.truth[i];
      ASSERT_EQ(f.trouble, Trouble::none) << "WHISKER_SEED=" << seed << ", beam " << i;
      axis.push_back({f.axis_deg - t.axis_deg, f.axis_error_deg, seed});
      cone.push_back({f.half_cone_deg - t.half_cone_deg, f.half_cone_error_deg, seed});
      if (f.edge_is_bound) continue;
      edge.push_back({f.edge_deg - t.edge_deg, f.edge_error_deg, seed});
      incidence.push_back({incidence_deg(f) - t.incidence_deg, incidence_error_deg(f), seed});
    }
    EXPECT_LE(r.written_incidence_deg, r.truth[0].incidence_deg) << "WHISKER_SEED=" << seed;
    EXPECT_GE(r.written_incidence_deg, r.truth[0].incidence_deg - 12) << "WHISKER_SEED=" << seed;
  }
  expect_accuracy("axis", axis, 0.15, 1.2);
  expect_accuracy("cone / 2", cone, 0.3, 3);
  expect_accuracy("cone / 2 + L", edge, 0.2, 1.2);
  expect_accuracy("L", incidence, 0.35, 3);
}

TEST(Trials, TheSecondTurnTellsWhetherTheBodyStoodSquare) {
  for (std::uint64_t seed = first_seed(); seed < first_seed() + test::effort(1, 100); ++seed) {
    const Trial trial = random_trial({0.01, 0.1, 0, 0, 0}, 0.3, 0.2, seed);
    const TrialResult r = run(trial);
    ASSERT_TRUE(r.measured.wall_error_deg) << "WHISKER_SEED=" << seed;
    EXPECT_NEAR(r.measured.wall_deg, -trial.scenario.start.heading / kRadPerDeg, 1)
        << "WHISKER_SEED=" << seed;
    EXPECT_LT(*r.measured.wall_error_deg, 0.5);
    for (std::size_t i = 0; i < r.truth.size(); ++i) {
      const BeamFit& f = r.measured.fits[i];
      EXPECT_NEAR(f.axis_deg, r.truth[i].axis_deg, 1.2) << "WHISKER_SEED=" << seed << ", beam " << i;
      EXPECT_NEAR(f.half_cone_deg, r.truth[i].half_cone_deg, 3) << "WHISKER_SEED=" << seed;
    }
  }
}

TEST(Trials, TheSameSeedGivesTheSameSpin) {
  const Trial a = random_trial({0.01, 0.1, 0, 0, 0}, 0.3, 0, 7),
              b = random_trial({0.01, 0.1, 0, 0, 0}, 0.3, 0, 7);
  EXPECT_EQ(run(a).measured.fits[0].axis_deg, run(b).measured.fits[0].axis_deg);
  EXPECT_NE(run(a).measured.fits[0].axis_deg, run(random_trial({}, 0, 0, 8)).measured.fits[0].axis_deg);
}

TEST(Truth, CountsTheTaperOfTheCone) {
  sim::RobotSpec robot;
  robot.incidence = sim::kPi / 3;
  robot.beams[0].cone_half_width = sim::kPi / 9;
  EXPECT_NEAR(truth(robot, 0, 0.3).half_cone_deg, 20, 1e-9);
  EXPECT_NEAR(truth(robot, 0, 0.3).edge_deg, 80, 1e-9);
  robot.cone_far_half_width = sim::kPi / 18;
  robot.taper_range = 2;
  EXPECT_NEAR(truth(robot, 0, 0.5).half_cone_deg, 17.5, 1e-9);
  EXPECT_NEAR(truth(robot, 0, 0.5).edge_deg, 60 + 15, 1e-9) << "the wall is 1 m away there";
}

}  // namespace
}  // namespace whisker::calibration
