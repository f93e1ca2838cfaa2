#include "host/worlds/scale.hpp"

#include <gtest/gtest.h>

#include "host/scenario/bearing.hpp"
#include "host/scenario/load.hpp"
#include "host/scenario/write.hpp"
#include "host/worlds/generate.hpp"

namespace whisker::worlds {
namespace {

Scenario generated(Kind kind, std::uint64_t seed) {
  Options options;
  options.seed = seed;
  return generate(kind, options);
}

// Not smaller: the reference robot must fit.
constexpr double kFactors[] = {1.25, 2.7301, 11.111};

TEST(AScaledWorld, OfFactorOneIsTheSame) {
  for (const Kind kind : kAllKinds) {
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      Scenario s = generated(kind, seed);
      const std::string before = to_toml(s);
      scale_lengths(s, 1);
      EXPECT_EQ(to_toml(s), before) << name(kind);
    }
  }
}

TEST(AScaledWorld, HasEveryLengthScaled) {
  Scenario s = parse_scenario(
      "[start]\nx_m = 1\ny_m = 2\n[goal]\nx_m = 3\ny_m = 5\ntolerance_m = 0.2\n"
      "[bounds]\nmin = [-9, -8]\nmax = [9, 8]\n[[disc]]\ncenter = [4, -2]\nradius_m = 0.5\n"
      "[[polygon]]\npoints = [[5, 5], [6, 5], [6, 6]]\n[[wall]]\npoints = [[-3, 0], [-3, 2]]\n"
      "[[mover]]\ncenter = [0, -4]\nradius_m = 0.1\npath = [[0, -4], [2, -4]]\nspeed_mps = 0.3\n",
      "s");
  scale_lengths(s, 2);
  EXPECT_EQ(
      to_toml(s),
      to_toml(parse_scenario(
          "name = \"s\"\n[start]\nx_m = 2\ny_m = 4\n[goal]\nx_m = 6\ny_m = 10\ntolerance_m = 0.4\n"
          "[bounds]\nmin = [-18, -16]\nmax = [18, 16]\n[[disc]]\ncenter = [8, -4]\nradius_m = 1\n"
          "[[polygon]]\npoints = [[10, 10], [12, 10], [12, 12]]\n[[wall]]\npoints = [[-6, 0], [-6, 4]]\n"
          "[[mover]]\ncenter = [0, -8]\nradius_m = 0.2\npath = [[0, -8], [4, -8]]\nspeed_mps = 0.3\n",
          "s")));
}

TEST(AScaledWorld, StartsTowardsItsGoalAndIsExactInAFile) {
  for (const Kind kind : kAllKinds) {
    for (const double factor : kFactors) {
      Scenario s = generated(kind, 7);
      scale_lengths(s, factor);
      EXPECT_EQ(s.start.heading, bearing(s.start.at, s.goal.at));
      const std::string text = to_toml(s);
      EXPECT_EQ(to_toml(parse_scenario(text, "scaled")), text) << name(kind);
    }
  }
}

}  // namespace
}  // namespace whisker::worlds
