// What the guard lets a retreat do that it lets no other way do.
#include <gtest/gtest.h>

#include "firmware/safety/guard.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::test {
namespace {

/// What is granted of a crawl straight ahead, all around walled in at this distance from the body's centre.
double granted(Length wall, bool retraces) {
  Ground g;
  g.echo(0, 360, wall);
  planning::Manoeuvre crawl;
  crawl.kind = planning::ManoeuvreKind::cruise;
  crawl.forward = 40_mm_per_s;
  crawl.retraces = retraces;
  const safety::Grant grant =
      safety::guard(crawl, {}, WheelState{}, g.local_grid(), g.params().safety.period, g.params());
  return grant.factor.raw() / 16384.0;
}

TEST(Retracing, PassesWhatIsCloserThanAnyOtherWayMayCome) {
  EXPECT_EQ(granted(150_mm, false), 1.0);
  EXPECT_EQ(granted(150_mm, true), 1.0);
  EXPECT_LT(granted(116_mm, false), 1.0);
  EXPECT_EQ(granted(116_mm, true), 1.0);
}

TEST(Retracing, DoesNotTouchEither) {
  for (Length wall = 95_mm; wall <= 105_mm; wall += 1_mm) EXPECT_LT(granted(wall, true), 1.0) << wall.raw();
}

}  // namespace
}  // namespace whisker::test
