#include "firmware/planning/boundary/loop_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/planning/boundary/breadcrumbs.hpp"
#include "tests/planning/ground.hpp"

namespace whisker::planning {
namespace {

using test::degrees;
using test::in_degrees;

/// A body that drives counter-clockwise on a circle; its heading determines its position.
class Round {
 public:
  Round(LoopDetector& circuit, Length radius) : loop_(circuit), radius_(radius) { place(); }

  void begin() {
    loop_.begin(view_, Params{});
    EXPECT_FALSE(loop_.closed(view_));
  }
  /// Drives one degree further; the circle's centre may drift.
  void drive(Vec drift = {}) {
    const Vec before = view_.pose.at;
    centre_ = centre_ + drift;
    ++deg_;
    place();
    view_.travelled_um += static_cast<uint32_t>(norm(view_.pose.at - before).raw());
    loop_.move(view_);
  }
  /// Leaves the circle with a heading that is off by this much.
  void look(int deg) {
    off_ = degrees(deg);
    place();
  }
  void grow_bound(Length by) { view_.bound += by; }
  void jump(Vec by) {
    centre_ = centre_ + by;
    place();
  }
  /// The left beam gets an echo at this distance, in every tick from now on.
  void see(Length distance) {
    view_.sighted = true;
    view_.observations[hal::kLeft].hit = true;
    view_.observations[hal::kLeft].free = distance;
  }
  const View& view() const { return view_; }

 private:
  void place() { view_.pose = {centre_ + polar(degrees(deg_) - 90_deg, radius_), degrees(deg_) + off_}; }
  LoopDetector& loop_;
  Length radius_;
  Vec centre_;
  Angle off_;
  int deg_ = 0;
  View view_;
};

TEST(LoopDetector, UnknownGroundWithNothingNearIsNoBoundary) {
  LoopDetector circuit;
  Round round(circuit, 1_m);
  round.begin();
  round.see(310_mm);
  for (int i = 0; i < 100; ++i) round.drive();
  EXPECT_FALSE(circuit.is_seen());
  round.see(290_mm);
  for (int i = 0; i < 100; ++i) round.drive();
  EXPECT_TRUE(circuit.is_seen()) << "half of the readings";
}

TEST(LoopDetector, ClosesWhereItBeganAfterAWholeTurn) {
  for (const Length radius : {300_mm, 1_m, 3_m}) {
    LoopDetector circuit;
    Round round(circuit, radius);
    round.begin();
    int closed = 0;
    for (int deg = 1; deg <= 380 && closed == 0; ++deg) {
      round.drive();
      if (circuit.closed(round.view())) closed = deg;
    }
    EXPECT_GE(closed, 300);
    EXPECT_LE(closed, 360);
  }
}

bool closes(Length radius, Vec drift, Length grows) {
  LoopDetector circuit;
  Round round(circuit, radius);
  round.grow_bound(1_m);  // what it was at the hit point does not count
  round.begin();
  bool closed = false;
  for (int deg = 1; deg <= 380; ++deg) {
    round.drive(drift);
    round.grow_bound(grows);
    closed = closed || circuit.closed(round.view());
  }
  return closed;
}

TEST(LoopDetector, ClosesWithinTheGrowthOfTheBound) {
  const Vec drift{Length{}, 4_mm};  // 1.4 m in a loop
  EXPECT_FALSE(closes(3_m, drift, Length{}));
  EXPECT_TRUE(closes(3_m, drift, 6_mm));
}

TEST(LoopDetector, DoesNotCloseALoopThatIsNotTwiceTheGrowth) {
  EXPECT_TRUE(closes(1_m, {}, 2_mm));
  EXPECT_FALSE(closes(1_m, {}, 4_mm));
}

TEST(LoopDetector, DoesNotCloseOnTheSpot) {
  LoopDetector circuit;
  Round round(circuit, 20_mm);
  round.begin();
  for (int deg = 1; deg <= 1000; ++deg) {
    round.drive();
    EXPECT_FALSE(circuit.closed(round.view())) << deg;
  }
}

TEST(LoopDetector, DoesNotCloseTheOtherWayRound) {
  LoopDetector circuit;
  Round round(circuit, 500_mm);
  circuit.begin(round.view(), Params{});
  View back = round.view();
  back.pose.heading += 180_deg;
  EXPECT_FALSE(circuit.closed(back)) << "followed this way";
  for (int deg = 1; deg <= 720; ++deg) {
    round.drive();
    EXPECT_FALSE(circuit.closed(round.view())) << deg;
  }
}

TEST(LoopDetector, DoesNotCloseWithoutAWholeTurn) {
  LoopDetector circuit;
  View view;
  const Pose here = view.pose;
  circuit.begin(view, Params{});
  EXPECT_FALSE(circuit.closed(view));
  for (const Pose& at : {Pose{{1_m, 0_mm}, {}}, here}) {
    view.pose = at;
    view.travelled_um += 1000000;
    circuit.move(view);
  }
  EXPECT_FALSE(circuit.closed(view));
}

/// Back and forth with one heading. Returns whether that closes the loop.
bool closes_without_a_turn(Length away, LoopDetector::Evidence evidence) {
  LoopDetector circuit;
  View view;
  const Pose here = view.pose;
  circuit.begin(view, Params{});
  EXPECT_FALSE(circuit.closed(view, evidence));
  for (const Pose& at : {Pose{{away, 0_mm}, {}}, here}) {
    EXPECT_FALSE(circuit.closed(view, evidence));
    view.pose = at;
    view.travelled_um += 3000000;
    circuit.move(view);
  }
  return circuit.closed(view, evidence);
}

TEST(LoopDetector, ClosesByPlaceFromFarAway) {
  EXPECT_TRUE(closes_without_a_turn(2_m, LoopDetector::Evidence::place));
  EXPECT_FALSE(closes_without_a_turn(1_m, LoopDetector::Evidence::place)) << "round a corner and back";
  EXPECT_FALSE(closes_without_a_turn(2_m, LoopDetector::Evidence::turning));
}

/// The body turns on the spot into the direction of the boundary, then drives round.
TEST(LoopDetector, TheTurnIntoTheBoundaryIsNoneOfTheLoop) {
  for (const int into : {-170, -90, 90, 170}) {
    LoopDetector circuit;
    Round round(circuit, 1_m);
    View before = round.view();
    before.pose.heading += degrees(-into);
    circuit.begin(before, Params{});
    circuit.move(round.view());
    EXPECT_FALSE(circuit.closed(round.view()));
    int closed = 0;
    for (int deg = 1; deg <= 380 && closed == 0; ++deg) {
      round.drive();
      if (circuit.closed(round.view())) closed = deg;
    }
    EXPECT_GE(closed, 300) << into;
    EXPECT_LE(closed, 360) << into;
  }
}

/// Round one thing to the left and another to the right, the turns cancel.
TEST(LoopDetector, ClosesWithoutATurnAtTheThirdReturn) {
  for (const auto evidence : {LoopDetector::Evidence::place, LoopDetector::Evidence::turning}) {
    LoopDetector circuit;
    View view;
    const Pose here = view.pose;
    circuit.begin(view, Params{});
    int returns = 0;
    for (bool closed = false; !closed && returns < 9; ++returns) {
      for (const Pose& at : {Pose{{800_mm, 0_mm}, {}}, Pose{{140_mm, 0_mm}, {}}, here, here}) {
        view.pose = at;
        view.travelled_um += 500000;
        circuit.move(view);
        closed = closed || circuit.closed(view, evidence);
      }
    }
    EXPECT_EQ(returns, 3) << "one for each time that it was away";
  }
}

TEST(LoopDetector, TurnsOnTheSpotAreNoLapsByPlace) {
  for (const auto evidence : {LoopDetector::Evidence::place, LoopDetector::Evidence::turning}) {
    LoopDetector circuit;
    Round round(circuit, 20_mm);
    round.begin();
    bool strays = false;
    for (int deg = 1; deg <= 2000; ++deg) {
      round.drive();
      strays |= circuit.strays(round.view(), evidence);
    }
    EXPECT_EQ(strays, evidence == LoopDetector::Evidence::turning);
  }
}

// The body meets the boundary elsewhere, so this is another obstacle.
TEST(LoopDetector, StraysRoundSomethingElse) {
  for (const auto evidence : {LoopDetector::Evidence::place, LoopDetector::Evidence::turning}) {
    LoopDetector circuit;
    Round round(circuit, 500_mm);
    round.begin();
    round.jump({3_m, 0_mm});
    int strays = 0;
    for (int deg = 1; deg <= 1000 && strays == 0; ++deg) {
      round.drive();
      EXPECT_FALSE(circuit.closed(round.view()));
      if (circuit.strays(round.view(), evidence)) strays = deg;
    }
    EXPECT_NEAR(strays, 715, 12) << "two laps that end in one place";
  }
}

// A look to one side shifts the place where the second turn is complete, by more than that place may be off.
TEST(LoopDetector, StraysInTwoLapsWhereverTheirTurnsAreComplete) {
  for (const int look : {-10, 10}) {
    LoopDetector circuit;
    Round round(circuit, 3_m);
    round.begin();
    round.jump({20_m, 0_mm});
    int strays = 0;
    for (int deg = 1; deg <= 1300 && strays == 0; ++deg) {
      if (deg % 360 == 300) round.look(look * deg / 360);
      round.drive();
      if (circuit.strays(round.view())) strays = deg;
    }
    EXPECT_NEAR(strays, 720, 15) << look;
  }
}

TEST(LoopDetector, SmallLapsByPlaceCountTogether) {
  LoopDetector circuit;
  Round round(circuit, 100_mm);
  round.begin();
  round.jump({3_m, 0_mm});
  int strays = 0;
  for (int deg = 1; deg <= 3000 && strays == 0; ++deg) {
    round.drive();
    if (circuit.strays(round.view(), LoopDetector::Evidence::place)) strays = deg;
  }
  EXPECT_NEAR(strays, 1080, 16) << "two laps of 0.63 m after the first";
}

TEST(LoopDetector, DoesNotStrayWhileItGetsOn) {
  LoopDetector circuit;
  Round round(circuit, 500_mm);
  round.begin();
  int strays = 0;
  for (int deg = 1; deg <= 2000 && strays == 0; ++deg) {
    round.drive({2_mm, 0_mm});
    if (circuit.strays(round.view())) strays = deg;
  }
  EXPECT_NEAR(strays, 1455, 2) << "so many laps are none of a spiral";
}

// Counter-clockwise: a wall on the left lies inside the circle, a wall on the right outside.
TEST(LoopDetector, PartsOnlyWhatLiesOnItsTwoSides) {
  LoopDetector circuit;
  Round round(circuit, 1_m);
  round.begin();
  for (int deg = 1; deg <= 360; ++deg) round.drive();
  const Vec inside{200_mm, 300_mm};
  const Vec outside{5_m, 0_mm};
  EXPECT_TRUE(circuit.may_part(outside, inside, Side::left));
  EXPECT_FALSE(circuit.may_part(inside, outside, Side::left)) << "round an obstacle that the goal is not in";
  EXPECT_FALSE(circuit.may_part(outside, outside, Side::left));
  EXPECT_TRUE(circuit.may_part(inside, outside, Side::right));
  EXPECT_FALSE(circuit.may_part(outside, inside, Side::right)) << "it did come in";
  EXPECT_FALSE(circuit.may_part(outside, outside, Side::right));
}

constexpr Length kApart = 40_mm;

TEST(Breadcrumbs, RemembersPlacesApart) {
  Breadcrumbs trail;
  trail.reset({}, kApart);
  int places = 0;
  for (int mm = 1; mm <= 410; ++mm) places += trail.add({millimetres(mm), 0_mm}) ? 1 : 0;
  EXPECT_EQ(places, 10);
  EXPECT_FALSE(trail.add({410_mm, 20_mm})) << "not far from the last one";
}

TEST(Breadcrumbs, LeadsBack) {
  Breadcrumbs trail;
  trail.reset({}, kApart);
  Pose pose{{}, 30_deg};
  for (int mm = 0; mm <= 1000; ++mm) {
    pose.at = polar(30_deg, millimetres(mm));
    trail.add(pose.at);
    if (mm < 300) continue;
    for (int n = 0; n < Breadcrumbs::kPlaces; ++n) {
      const Length back = norm(pose.at - trail.back(n));
      EXPECT_GE(back, kApart * n - 1_mm);
      EXPECT_LE(back, kApart * (n + 1) + 4_mm);
    }
    EXPECT_NEAR(in_degrees(trail.way_back(pose) - 210_deg), 0, 0.1);
  }
}

TEST(Breadcrumbs, LeadsBackRoundACorner) {
  Breadcrumbs trail;
  trail.reset({}, kApart);
  for (int mm = 0; mm <= 300; ++mm) trail.add({millimetres(mm), 0_mm});
  Pose pose{{300_mm, 0_mm}, 90_deg};
  for (int mm = 0; mm <= 60; ++mm) {
    pose.at.y = millimetres(mm);
    trail.add(pose.at);
  }
  const double back = in_degrees(trail.way_back(pose));
  EXPECT_LT(back, -100) << "towards where it was before the corner";
  EXPECT_GT(back, -180);
}

TEST(Breadcrumbs, OfABodyThatHasHardlyMovedLeadsStraightBehind) {
  Breadcrumbs trail;
  trail.reset({1_m, 1_m}, kApart);
  for (int deg = 0; deg < 360; deg += 30) {
    const Pose pose{{1_m + 30_mm, 1_m}, test::degrees(deg)};
    EXPECT_EQ(trail.way_back(pose), pose.heading + 180_deg);
  }
}

}  // namespace
}  // namespace whisker::planning
