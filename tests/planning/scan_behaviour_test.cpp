#include "firmware/planning/scan_behaviour.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "firmware/planning/candidate_headings.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::Ground;

/// The reading of a beam in this direction.
struct Shown {
  Length reach;
  bool hit;
};
using World = std::function<Shown(Angle)>;

/// A body that turns at once as commanded, and marks the readings of its beams.
struct Turner {
  Ground ground;
  Angle heading;
  int ticks = 0;
  int stops = 0;

  /// True if the scan ended.
  bool look(Angle along, const World& world) {
    ScanBehaviour look;
    Manoeuvre m;
    look.begin(along, ground.local_grid().reach().probe, m);
    const Params& params = ground.params();
    for (; ticks < 1000; ++ticks) {
      if (m.kind == ManoeuvreKind::stop) ++stops;
      const bool turns = m.kind == ManoeuvreKind::cruise;
      EXPECT_EQ(m.forward, Speed{}) << "a look does not drive";
      if (turns) heading += angle_of(m.turning * params.safety.period, params.body.track / 2);
      for (int beam = 0; beam < hal::kBeams; ++beam) {
        const Angle axis = heading + beam_axis(params.rangefinders, beam);
        const Shown shown = world(axis);
        ground.mark(axis, shown.reach, shown.hit, !turns);
      }
      m.kind = turns ? ManoeuvreKind::cruise : ManoeuvreKind::keep;
      if (look.step(ground.view(heading), params, m)) return true;
    }
    return false;
  }
  Way judged(Angle along) const {
    const Reach& reach = ground.local_grid().reach();
    return way(ground.view(), along, reach.probe, reach.planning);
  }
};

TEST(ScanBehaviour, EndsWhenTheWayIsFree) {
  for (int i = 0; i < kCandidateHeadings; ++i) {
    Turner t;
    const Angle along = Angle::turns(i, kCandidateHeadings);
    ASSERT_TRUE(t.look(along, [](Angle) { return Shown{500_mm, false}; })) << i;
    EXPECT_EQ(t.judged(along), Way::free) << i;
    EXPECT_LT(t.ticks, 600) << i;
  }
}

TEST(ScanBehaviour, EndsWhenSomethingIsInTheWay) {
  const auto pole = [](Angle axis) {
    const bool hit = magnitude(axis - 120_deg) < (12_deg).raw();
    return hit ? Shown{150_mm, true} : Shown{500_mm, false};
  };
  Turner t;
  ASSERT_TRUE(t.look(120_deg, pole));
  EXPECT_EQ(t.judged(120_deg), Way::occupied);
}

TEST(ScanBehaviour, EndsWhereNoBeamProvesAnything) {
  Turner t;
  ASSERT_TRUE(t.look(-(60_deg), [](Angle) { return Shown{100_mm, false}; }));
  EXPECT_EQ(t.judged(-(60_deg)), Way::occupied);
  EXPECT_LT(t.ticks, 300);
}

TEST(ScanBehaviour, StopsBeforeItTurnsAndAsksForNothingMoreWhileItStands) {
  Ground g;
  ScanBehaviour look;
  Manoeuvre m;
  look.begin(0_deg, 150_mm, m);
  EXPECT_EQ(m.kind, ManoeuvreKind::stop);
  const Unseen rest = unseen(g.view(), 0_deg, 150_mm, 0_deg, g.params());
  ASSERT_GT(rest.cells, 0);
  const Angle turn = rest.turn;
  const View aimed = g.view(turn);
  m = {};
  EXPECT_FALSE(look.step(aimed, g.params(), m));
  EXPECT_EQ(m.kind, ManoeuvreKind::keep);
  EXPECT_FALSE(look.step(g.view(turn + 90_deg), g.params(), m));
  EXPECT_EQ(m.kind, ManoeuvreKind::cruise);
  EXPECT_FALSE(look.step(aimed, g.params(), m));
  EXPECT_EQ(m.kind, ManoeuvreKind::stop) << "it arrived: to be proved, a look stands";
}

/// Ticks until a scan that wants to turn ends, while the guard lets this part of its turn through; at most
/// 1000.
int ticks_with(Q14 granted, ScanBehaviour& look) {
  Ground g;
  Manoeuvre m;
  look.begin(0_deg, 150_mm, m);
  View view = g.view(90_deg);
  view.elapsed = g.params().safety.period;
  view.granted = granted;
  int ticks = 0;
  while (ticks < 1000 && !look.step(view, g.params(), m)) ++ticks;
  return ticks;
}

TEST(ScanBehaviour, EndsInVainWhereTheGuardLetsNoTurnThrough) {
  ScanBehaviour held, turning;
  const Params params;
  const int patience = derived::stalled_after(params).raw() / params.safety.period.raw();
  EXPECT_NEAR(ticks_with(Q14{}, held), patience, 2);
  EXPECT_TRUE(held.in_vain());
  EXPECT_EQ(ticks_with(Q14::ratio(1, 1), turning), 1000);
}

}  // namespace
}  // namespace whisker::planning
