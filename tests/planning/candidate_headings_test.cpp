#include "firmware/planning/candidate_headings.hpp"

#include <gtest/gtest.h>

#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::degrees;
using test::Ground;

Way judged(const Ground& g, Angle heading) {
  const Reach& reach = g.local_grid().reach();
  return way(g.view(), heading, reach.probe, reach.planning);
}

TEST(Ways, AreFreeWhereAllWasSeen) {
  Ground g;
  g.free(0, 360);
  for (int i = 0; i < kCandidateHeadings; ++i)
    EXPECT_EQ(judged(g, Angle::turns(i, kCandidateHeadings)), Way::free) << i;
}

TEST(Ways, AreOpenWhereSomethingWasNotSeen) {
  Ground g;
  g.free(-100, 100);
  EXPECT_EQ(judged(g, 0_deg), Way::free);
  EXPECT_EQ(judged(g, 180_deg), Way::unknown);
  EXPECT_EQ(judged(Ground{}, 0_deg), Way::unknown);
}

TEST(Ways, AreBlockedByAnEcho) {
  Ground g;
  g.free(30, 330).echo(-30, 30, 150_mm);
  EXPECT_EQ(judged(g, 0_deg), Way::occupied);
  EXPECT_EQ(judged(g, 180_deg), Way::free);
  const View v = g.view();
  EXPECT_EQ(way(v, 0_deg, 10_mm, v.local_grid->reach().planning), Way::free) << "short of it";
}

TEST(Ways, AreBlockedWhereALookWasInVain) {
  Ground g;
  g.free(20, 340).look_in_vain(0, 80_mm);
  EXPECT_EQ(judged(g, 0_deg), Way::occupied);
}

TEST(Unseen, BringsTheNearestBeamOntoTheNearestUnseenCell) {
  Ground g;
  g.free(-100, 100);
  const View v = g.view();
  int turns = 0;
  for (int i = 0; i < kCandidateHeadings; ++i) {
    const Angle heading = Angle::turns(i, kCandidateHeadings);
    const Reach& reach = v.local_grid->reach();
    const perception::Obstacles o = v.local_grid->along(v.pose.at, heading, reach.probe, reach.planning);
    for (int from = 0; from < 360; from += 7) {
      const Unseen rest = unseen(v, heading, reach.probe, degrees(from), g.params());
      ASSERT_EQ(rest.cells, o.unknown);
      if (o.unknown == 0) continue;
      ++turns;
      bool met = false;
      for (int beam = 0; beam < hal::kBeams; ++beam) {
        const Angle needed =
            bearing(o.nearest_unknown) - degrees(from) - beam_axis(g.params().rangefinders, beam);
        EXPECT_LE(magnitude(rest.turn), magnitude(needed));
        met = met || rest.turn == needed;
      }
      EXPECT_TRUE(met);
    }
  }
  EXPECT_GT(turns, 500);
}

TEST(Unseen, SeesNoUseInABlockedWay) {
  Ground g;
  g.echo(-30, 30, 150_mm);
  EXPECT_EQ(unseen(g.view(), 0_deg, 150_mm, 0_deg, g.params()).cells, 0);
}

}  // namespace
}  // namespace whisker::planning
