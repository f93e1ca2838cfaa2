// The accuracy over random mounts, skews, cones and incidences.
#include "host/calibration/simulated.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "host/scenario/bearing.hpp"
#include "tests/effort.hpp"

namespace whisker::calibration {
namespace {

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
