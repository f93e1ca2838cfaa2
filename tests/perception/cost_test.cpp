// Cost of a tick: number of grid rows clipped, counted with the linker's --wrap (see CMakeLists.txt).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "firmware/perception/raster.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/perception/rig.hpp"

namespace {
int g_rows = 0;
}

// The wrapped functions by their mangled names; each is called once per row.
extern "C" {
whisker::perception::Row __real__ZNK7whisker10perception4Span7columnsEv(const whisker::perception::Span*);
whisker::perception::Row __wrap__ZNK7whisker10perception4Span7columnsEv(
    const whisker::perception::Span* span) {
  ++g_rows;
  return __real__ZNK7whisker10perception4Span7columnsEv(span);
}
whisker::perception::Row __real__ZNK7whisker10perception7Stadium7columnsEi(
    const whisker::perception::Stadium*, int);
whisker::perception::Row __wrap__ZNK7whisker10perception7Stadium7columnsEi(
    const whisker::perception::Stadium* stadium, int row) {
  ++g_rows;
  return __real__ZNK7whisker10perception7Stadium7columnsEi(stadium, row);
}
}

namespace whisker::test {
namespace {

struct Cost {
  int worst = 0;
  double sum = 0;
  int ticks = 0;
  void add(int rows) {
    worst = std::max(worst, rows);
    sum += rows;
    ++ticks;
  }
  double mean() const { return sum / ticks; }
};

/// A beam has measured since the last tick.
bool arrived(const hal::RangeReadings& now, hal::RangeReadings& last) {
  bool any = false;
  for (int i = 0; i < hal::kBeams; ++i) any = any || now.beam[i].sequence != last.beam[i].sequence;
  last = now;
  return any;
}

TEST(Cost, OfATickIsBounded) {
  Cost plain;
  Cost sensing;
  int most_work = 0;
  for (const worlds::Kind kind : {worlds::Kind::discs, worlds::Kind::maze, worlds::Kind::rooms}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      worlds::Options options;
      options.seed = 70 + seed;
      Rig rig(worlds::generate(kind, options));
      hal::RangeReadings last{};
      while (rig.plant().time() < 60) {
        g_rows = 0;
        if (!rig.step()) break;
        (arrived(rig.view().raw.ranges, last) ? sensing : plain).add(g_rows);
      }
      most_work = std::max(most_work, int{rig.status().most_work});
    }
  }
  std::printf("rows a tick: %.0f mean, %d worst; with new readings %.0f mean, %d worst\n", plain.mean(),
              plain.worst, sensing.mean(), sensing.worst);
  std::printf("work of a tick: at most %d units\n", most_work);
  EXPECT_GT(most_work, Work::kSearches / 2);
  EXPECT_LE(most_work, 1000);
  EXPECT_GT(plain.ticks, 10000);
  EXPECT_GT(sensing.mean(), 3 * 2 * 10);
  EXPECT_LE(plain.worst, 400);
  EXPECT_LE(sensing.worst, 500);
}

}  // namespace
}  // namespace whisker::test
