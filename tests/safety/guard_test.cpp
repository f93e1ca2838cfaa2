// Whatever a planner asks for, the guard keeps the body off what does not move, and it lets go where nothing
// is.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdio>

#include "host/scenario/contact.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/perception/rig.hpp"

namespace whisker::test {
namespace {

using worlds::Random;

/// Wants the worst for a few ticks, then something else as bad. Never stops, never looks.
class Malice final : public planning::Planner {
 public:
  explicit Malice(std::uint64_t seed) : random_(seed) {}
  void set_goal(const planning::Goal&) noexcept override {}
  void move_goal(Vec) noexcept override {}
  void cancel() noexcept override {}
  planning::Decision step(const planning::View& view) noexcept override {
    if (rest_-- <= 0) plot();
    planning::Decision d;
    d.outcome = planning::Outcome::running;
    d.manoeuvre.kind = planning::ManoeuvreKind::cruise;
    d.manoeuvre.forward = forward_;
    d.manoeuvre.turning = turning_;
    switch (plot_) {
      case Plot::steady: break;
      case Plot::nearest: d.manoeuvre.turning = towards_nearest(view); break;
      case Plot::zigzag: turning_ = -turning_; break;
      case Plot::shake: forward_ = -forward_; break;
      case Plot::noise:
        forward_ = draw(500);
        turning_ = draw(500);
        break;
    }
    return d;
  }

 private:
  enum class Plot { steady, nearest, zigzag, shake, noise };

  Speed draw(int mm_per_s) { return Speed::from_raw((random_.index(2 * mm_per_s + 1) - mm_per_s) * 1000); }
  void plot() {
    constexpr int kPlots = 5;
    plot_ = static_cast<Plot>(random_.index(kPlots));
    rest_ = 1 + random_.index(random_.chance(0.2) ? 10 : 150);
    constexpr int kForward[] = {300, 300, 300, 150, 20, 2, 1, -300};
    forward_ = Speed::from_raw(kForward[random_.index(8)] * (random_.chance(0.1) ? 300 : 1000));
    turning_ = random_.chance(0.4) ? Speed{} : draw(300);
  }
  static Speed towards_nearest(const planning::View& view) {
    const perception::Echo* const b = view.moving_scan.beam;
    if (b[hal::kFront].distance <= b[hal::kLeft].distance &&
        b[hal::kFront].distance <= b[hal::kRight].distance) {
      return Speed{};
    }
    return b[hal::kLeft].distance < b[hal::kRight].distance ? 60_mm_per_s : -60_mm_per_s;
  }

  Random random_;
  Plot plot_ = Plot::steady;
  int rest_ = 0;
  Speed forward_;
  Speed turning_;
};

/// A place of a generated world where the body may stand, in the thick of it.
Scenario draw(Random& random) {
  constexpr worlds::Kind kKinds[] = {worlds::Kind::discs, worlds::Kind::poles, worlds::Kind::maze,
                                     worlds::Kind::rooms, worlds::Kind::spiral};
  worlds::Options options;
  options.seed = random.bits() >> 2;
  const worlds::Kind kind = kKinds[random.index(5)];
  if (kind == worlds::Kind::discs) options.discs = 75;
  Scenario s = worlds::generate(kind, options);
  for (int i = 0; i < 200; ++i) {
    const sim::Vec2 at{s.start.at.x + random.uniform(-0.5, 3), s.start.at.y + random.uniform(-0.5, 3)};
    const auto nearest = nearest_obstacle(s, at);
    const double gap = nearest.distance_m - 0.09;
    if (gap < 0.001 || gap > 0.3) continue;
    s.start.at = at;
    break;
  }
  s.start.heading = random.uniform(-3.14, 3.14);
  s.seed = random.bits();
  return s;
}

struct Torment {
  double gap = 1;     // m, where it began with room
  double beside = 1;  // m, where it began beside something
  double path = 0;
  int worlds = 0;
};

Torment torment(std::uint64_t seed, int count) {
  Torment nearest;
  for (int i = 0; i < count; ++i) {
    Random random(seed + static_cast<std::uint64_t>(i));
    const Scenario scenario = draw(random);
    Malice malice(random.bits());
    Rig rig(scenario, &malice);
    while (rig.plant().time() < 12 && rig.step()) {
    }
    EXPECT_FALSE(rig.plant().in_contact()) << "seed " << seed + static_cast<std::uint64_t>(i)
                                           << ": contact at " << rig.plant().contact_time() << " s";
    EXPECT_GT(rig.plant().time(), 11.9)
        << name(rig.status().health.fault) << " seed " << seed + static_cast<std::uint64_t>(i);
    const bool room = nearest_obstacle(scenario, scenario.start.at).distance_m > 0.09 + 0.02;
    double& gap = room ? nearest.gap : nearest.beside;
    gap = std::fmin(gap, rig.plant().min_clearance());
    nearest.path += rig.plant().path_length();
    ++nearest.worlds;
  }
  return nearest;
}

class ShieldOf300Worlds : public testing::TestWithParam<int> {};

TEST_P(ShieldOf300Worlds, NeverTouchesWhateverIsAskedFor) {
  const Torment n = torment(static_cast<std::uint64_t>(GetParam()), static_cast<int>(test::effort(300)));
  std::printf("%d worlds, %.0f m: the smallest gap is %.4f m, begun beside something %.4f m\n", n.worlds,
              n.path, n.gap, n.beside);
  EXPECT_GT(n.path, n.worlds * 0.15);
}

INSTANTIATE_TEST_SUITE_P(From, ShieldOf300Worlds, testing::Values(1, 301, 601, 901));

RC_GTEST_PROP(Shield, NeverTouchesFromAnySeed, (std::uint64_t seed)) {
  const Torment n = torment(seed, 1);
  RC_ASSERT(n.gap > 0);
  RC_ASSERT(n.beside > 0);
}

// In open ground the guard takes nothing away.
TEST(Shield, GrantsAStraightWishInOpenGroundInFull) {
  class Straight final : public planning::Planner {
    void set_goal(const planning::Goal&) noexcept override {}
    void move_goal(Vec) noexcept override {}
    void cancel() noexcept override {}
    planning::Decision step(const planning::View& view) noexcept override {
      planning::Decision d;
      d.outcome = planning::Outcome::running;
      d.manoeuvre.kind = planning::ManoeuvreKind::cruise;
      // The beams do not see the flanks: first a turn to both sides.
      const int32_t part = ++ticks_ / 120;
      const bool drives = part >= 4;
      d.manoeuvre.forward = drives ? 300_mm_per_s : Speed{};
      d.manoeuvre.turning = drives ? Speed{} : part == 0 || part == 3 ? 65_mm_per_s : -65_mm_per_s;
      if (ticks_ > 4 * 120 + 1) all_ = all_ && view.granted == Q14::ratio(1, 1);
      return d;
    }
    int32_t ticks_ = 0;

   public:
    bool all_ = true;
  } straight;
  Scenario s;
  s.goal.at = {100, 0};
  Rig rig(s, &straight);
  while (rig.plant().time() < 12 && rig.step()) {
  }
  EXPECT_TRUE(straight.all_);
  EXPECT_GT(rig.plant().path_length(), 0.29 * (12 - 5.2));
}

}  // namespace
}  // namespace whisker::test
