// The guard is usable: an operator that follows a path arrives, about as fast as without it.
#include <gtest/gtest.h>

#include <cstdio>

#include "host/guard/drive.hpp"
#include "host/guard/operators.hpp"
#include "host/worlds/generate.hpp"
#include "tests/effort.hpp"

namespace whisker::test {
namespace {

struct Class {
  const char* name;
  int discs;
  bool box;
  Angle cone;
  Angle side;
  double bar_mps;
};

void PrintTo(const Class& c, std::ostream* out) { *out << c.name; }

class PerfectOperator : public testing::TestWithParam<Class> {};

TEST_P(PerfectOperator, Arrives) {
  const Class& c = GetParam();
  int arrived = 0, drives = 0;
  double path = 0, time = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(7, 200); ++seed) {
    worlds::Options options;
    options.seed = seed;
    options.discs = c.discs;
    options.box = c.box;
    Scenario s = worlds::generate(worlds::Kind::discs, options);
    s.robot.rangefinders.cone = c.cone;
    s.robot.rangefinders.side_angle = c.side;
    const auto hand = guard::make_operator(guard::Hand::perfect, s, seed);
    if (!hand) continue;
    const guard::Result result = guard::drive(s, *hand);
    EXPECT_NE(result.end, guard::End::contact) << "seed " << seed;
    ++drives;
    arrived += result.end == guard::End::arrived ? 1 : 0;
    path += result.path_m;
    time += result.time_s;
  }
  std::printf("%s: %d of %d arrive, %.3f m/s\n", c.name, arrived, drives, path / time);
  EXPECT_GE(arrived * 100, drives * 98);
  EXPECT_GE(path / time, c.bar_mps);
}

INSTANTIATE_TEST_SUITE_P(In, PerfectOperator,
                         testing::Values(Class{"discs", 30, false, 25_deg, 30_deg, 0.25},
                                         Class{"box", 75, true, 25_deg, 30_deg, 0.245},
                                         Class{"discs_wide", 30, false, 35_deg, 33_deg, 0.27},
                                         Class{"box_wide", 75, true, 35_deg, 33_deg, 0.265}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace whisker::test
