// Missions whose pose is corrected from outside every second.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "host/harness/run/runner.hpp"
#include "host/harness/sim/sim_board.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/effort.hpp"
#include "tests/missions/pilot_on.hpp"

namespace whisker {
namespace {

constexpr PlannerKind kAll[] = {PlannerKind::boundary, PlannerKind::map, PlannerKind::thesis};

/// The pose that is given to the robot every second.
using PlacedAt = std::function<Pose(const sim::Pose& truth, const Pose& believed)>;

class PlacedPilot final : public test::PilotOn<hal::SimBoard> {
 public:
  PlacedPilot(const Scenario& scenario, PlannerKind kind, sim::Plant& plant, PlacedAt placed)
      : PilotOn(scenario, kind, plant), plant_(plant), placed_(std::move(placed)) {}
  const Status& tick(Time now) override {
    if (placed_ && now.raw() % 1000 == 500) {
      EXPECT_TRUE(robot().place(placed_(plant_.pose(), robot().status().pose)));
    }
    return PilotOn::tick(now);
  }

 private:
  sim::Plant& plant_;
  PlacedAt placed_;
};

RunResult drive(const Scenario& scenario, PlannerKind planner, const PlacedAt& placed) {
  RunOptions options;
  options.planner = planner;
  options.pilot = [&](const Scenario& s, PlannerKind kind, sim::Plant& plant) {
    return std::make_unique<PlacedPilot>(s, kind, plant, placed);
  };
  return run(scenario, options);
}

/// The true pose, off by up to 3 cm and 1 degree.
PlacedAt roughly(std::uint64_t seed) {
  return [random = std::mt19937_64(seed)](const sim::Pose& truth, const Pose&) mutable {
    std::uniform_real_distribution<double> draw(-1, 1);
    sim::Pose placed = truth;
    placed.at.x += 0.03 * draw(random);
    placed.at.y += 0.03 * draw(random);
    placed.heading += 0.0175 * draw(random);
    return fixed_pose(placed);
  };
}

Scenario world(std::uint64_t n, PlannerKind planner) {
  constexpr worlds::Kind kKinds[] = {worlds::Kind::discs, worlds::Kind::maze, worlds::Kind::u_trap,
                                     worlds::Kind::rooms};
  worlds::Options options;
  options.seed = 5200 + n;
  // The thesis planner escapes from few traps.
  return worlds::generate(planner == PlannerKind::thesis ? worlds::Kind::discs : kKinds[n % 4], options);
}

struct Tally {
  int reached = 0;
  int contacts = 0;
  int off = 0;  // the distance to the goal exceeds the tolerance plus the error of the given poses
  void add(const Scenario& s, const RunResult& r) {
    if (r.verdict == Verdict::reached || r.verdict == Verdict::off_goal) {
      ++reached;
      if (r.final_distance_m > s.goal.tolerance_m + 0.06) ++off;
    }
    if (r.verdict == Verdict::contact) ++contacts;
  }
};

class Placement : public testing::TestWithParam<PlannerKind> {};

TEST_P(Placement, OfTheSamePoseEachSecondChangesNothing) {
  const PlacedAt same = [](const sim::Pose&, const Pose& believed) { return believed; };
  for (std::uint64_t n = 1; n <= test::effort(6); ++n) {
    Scenario s = world(n, GetParam());
    s.time_limit_s = 200;
    EXPECT_EQ(drive(s, GetParam(), same).hash, drive(s, GetParam(), {}).hash) << s.name;
  }
}

TEST_P(Placement, ACorrectionEachSecondStillArrivesAndTouchesNothing) {
  Tally without;
  Tally with;
  const std::uint64_t missions = test::effort(3, 40);
  for (std::uint64_t n = 1; n <= missions; ++n) {
    const Scenario s = world(n, GetParam());
    without.add(s, drive(s, GetParam(), {}));
    with.add(s, drive(s, GetParam(), roughly(n)));
  }
  std::printf("%s, %d missions: reached %d, with corrections %d; contacts %d and %d\n",
              name(GetParam()).c_str(), static_cast<int>(missions), without.reached, with.reached,
              without.contacts, with.contacts);
  const bool gives_up = GetParam() == PlannerKind::thesis;
  EXPECT_GE(with.reached, without.reached - (gives_up ? 3 : 0));
  EXPECT_LE(with.contacts, without.contacts);
  EXPECT_EQ(with.off, 0);
  EXPECT_GE(without.reached, static_cast<int>(gives_up ? missions / 2 : missions));
}

INSTANTIATE_TEST_SUITE_P(Planners, Placement, testing::ValuesIn(kAll),
                         [](const auto& kind) { return std::string(name(kind.param)); });

}  // namespace
}  // namespace whisker
