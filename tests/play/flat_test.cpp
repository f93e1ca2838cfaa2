#include "host/play/flat.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/worlds/generate.hpp"

namespace whisker::play {
namespace {

Scenario with_everything() {
  Scenario s = worlds::generate(worlds::Kind::rooms, {});
  s.walls = {{{0.5, 0.5}, {0.6, 0.75}, {0.5, 1}}};
  s.movers = {{{2, 0.1}, 0.05, {{2, 0.1}, {2, 0.4}}, 0.2}};
  s.noise = {0.01, 0.02, 0.03, 0.004, 0.5};
  s.seed = (std::uint64_t{1} << 53) - 1;
  return s;
}

TEST(Flat, EveryClassOfWorldsComesBack) {
  for (const worlds::Kind kind : worlds::kKinds) {
    const std::vector<double> list = flat(worlds::generate(kind, {}));
    const std::optional<Scenario> back = scenario_of(list);
    ASSERT_TRUE(back) << worlds::name(kind);
    EXPECT_EQ(flat(*back), list) << worlds::name(kind);
  }
}

TEST(Flat, AllPartsComeBack) {
  const Scenario s = with_everything();
  const std::optional<Scenario> back = scenario_of(flat(s));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->seed, s.seed);
  EXPECT_EQ(back->start.heading, s.start.heading);
  EXPECT_EQ(back->walls.front().size(), 3U);
  EXPECT_EQ(back->movers.front().speed_mps, 0.2);
  EXPECT_EQ(back->noise.heading_drift_deg_per_sqrt_m, 0.5);
  EXPECT_EQ(back->discs.size(), s.discs.size());
  EXPECT_EQ(flat(*back), flat(s));
}

TEST(Flat, EveryOtherLengthIsRefused) {
  std::vector<double> list = flat(with_everything());
  list.push_back(0);
  EXPECT_FALSE(scenario_of(list));
  list.pop_back();
  while (!list.empty()) {
    list.pop_back();
    EXPECT_FALSE(scenario_of(list)) << list.size();
  }
}

TEST(Flat, NoNumberMayBeNoneOrHuge) {
  const std::vector<double> good = flat(with_everything());
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300, 1e300}) {
    for (std::size_t i = 0; i < good.size(); ++i) {
      std::vector<double> list = good;
      list[i] = bad;
      EXPECT_FALSE(scenario_of(list)) << i << " is " << bad;
    }
  }
}

}  // namespace
}  // namespace whisker::play
