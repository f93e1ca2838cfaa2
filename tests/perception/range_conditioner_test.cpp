#include "firmware/perception/range_conditioner.hpp"

#include <cstdint>
#include <initializer_list>
#include <random>

#include <gtest/gtest.h>

namespace whisker::perception {
namespace {

using hal::RangeStatus;
using Readings = std::initializer_list<std::uint16_t>;

class BeamTest : public testing::Test {
 protected:
  /// One reading every 20 ms, measured 20 ms before.
  void see(RangeStatus status, std::uint16_t mm, Angle heading = {}) { see(status, mm, Pose{{}, heading}); }
  void see(RangeStatus status, std::uint16_t mm, const Pose& body) {
    now_ = now_ + milliseconds(20);
    sequence_ = static_cast<std::uint8_t>((sequence_ + 1) % 16);
    beam_.update({mm, status, 20, sequence_}, now_, body, params_, health_);
  }
  void see(std::uint16_t mm) { see(RangeStatus::ok, mm); }
  void repeat_old_reading(int ticks, std::uint16_t mm) {
    for (int i = 0; i < ticks; ++i) {
      now_ = now_ + milliseconds(10);
      beam_.update({mm, RangeStatus::ok, 20, sequence_}, now_, Pose{}, params_, health_);
    }
  }
  Echo look(Time since = Time::from_raw(0)) const { return beam_.look(since, params_); }

  Params params_;
  Health health_;
  BeamConditioner beam_;
  Time now_;
  std::uint8_t sequence_ = 7;
};

TEST_F(BeamTest, IsPendingUntilEnoughReadingsAgree) {
  EXPECT_EQ(look().validity, Validity::pending);
  see(500);
  see(510);
  EXPECT_EQ(look().validity, Validity::pending);
  see(505);
  EXPECT_EQ(look().validity, Validity::ok);
  EXPECT_EQ(look().distance, 500_mm);
}

TEST_F(BeamTest, TakesTheNearestOfAgreeingReadingsAndWaitsWhileTheyDisagree) {
  see(500);
  see(500);
  see(561);
  EXPECT_EQ(look().validity, Validity::pending);
  see(560);
  see(621);
  EXPECT_EQ(look().validity, Validity::pending);
  see(620);
  EXPECT_EQ(look().validity, Validity::pending);
  see(561);
  EXPECT_EQ(look().distance, 561_mm);  // 60 mm apart: they still agree
}

TEST_F(BeamTest, OneFalseClearNeitherWinsNorVotes) {
  see(500);
  see(500);
  see(RangeStatus::clear, 0);
  EXPECT_EQ(look().validity, Validity::pending);
  see(500);
  see(500);
  EXPECT_EQ(look().validity, Validity::pending);
  see(500);
  EXPECT_EQ(look().distance, 500_mm);
}

TEST_F(BeamTest, ALostReadingIsSkippedAndNeverFar) {
  see(500);
  see(RangeStatus::invalid, 60000);
  EXPECT_EQ(beam_.latest().validity, Validity::invalid);
  EXPECT_EQ(beam_.latest().distance, Length{});
  see(500);
  see(RangeStatus::invalid, 0);
  see(500);
  EXPECT_EQ(look().distance, 500_mm);
  EXPECT_EQ(health_.range_invalid, 2U);
}

TEST_F(BeamTest, AnUnknownStatusIsALostReading) {
  see(static_cast<RangeStatus>(77), 500);
  EXPECT_EQ(beam_.latest().validity, Validity::invalid);
  EXPECT_EQ(health_.range_invalid, 1U);
}

TEST_F(BeamTest, OutsideTheSensorsRangeIsClearAboveAndTooNearBelow) {
  for (const std::uint16_t mm : Readings{hal::kMostMm, 2001, 2000}) {
    see(mm);
    EXPECT_EQ(beam_.latest().validity, Validity::clear) << mm;
    EXPECT_EQ(beam_.latest().distance, 2000_mm) << mm;
  }
  see(1999);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
  see(20);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
  see(19);
  EXPECT_EQ(beam_.latest().validity, Validity::too_near);
  EXPECT_EQ(beam_.latest().distance, Length{});
  EXPECT_EQ(health_.range_out_of_range, 3U);
}

TEST_F(BeamTest, ADistanceThatNoBusCarriesIsLost) {
  for (const std::uint16_t mm : Readings{65534, 65535}) {
    see(mm);
    EXPECT_EQ(beam_.latest().validity, Validity::invalid) << mm;
  }
  EXPECT_EQ(health_.range_invalid, 2U);
}

TEST_F(BeamTest, AnEchoAtAMaximumOfNoWholeMillimetresIsClear) {
  params_.rangefinders.max_range = micrometres(1999'100);
  see(1999);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
  see(2000);
  EXPECT_EQ(beam_.latest().validity, Validity::clear);
  EXPECT_EQ(beam_.latest().distance, micrometres(1999'100));
  EXPECT_EQ(health_.range_out_of_range, 0U);
  see(2001);
  EXPECT_EQ(beam_.latest().validity, Validity::clear);
  EXPECT_EQ(health_.range_out_of_range, 1U);
}

TEST_F(BeamTest, ZeroMillimetresIsTooNearWhereTheMinimumAllowsZero) {
  params_.rangefinders.min_range = Length{};
  see(0);
  EXPECT_EQ(beam_.latest().validity, Validity::too_near);
}

TEST_F(BeamTest, ClearCountsAsTheMaximumRange) {
  for (int i = 0; i < 3; ++i) see(RangeStatus::clear, 0);
  EXPECT_EQ(look().validity, Validity::clear);
  EXPECT_EQ(look().distance, 2000_mm);
}

TEST_F(BeamTest, AThingExactlyAtTheMaximumRangeCountsAsClear) {
  for (int i = 0; i < 3; ++i) see(2000);
  EXPECT_EQ(look().validity, Validity::clear);
  EXPECT_EQ(look().distance, 2_m);
}

TEST_F(BeamTest, TooNearWinsOverClear) {
  for (int i = 0; i < 3; ++i) see(RangeStatus::too_near, 0);
  EXPECT_EQ(look().validity, Validity::too_near);
  EXPECT_EQ(look().distance, Length{});
}

TEST_F(BeamTest, OnlyReadingsTakenSinceTheBodyStoodCount) {
  for (int i = 0; i < 5; ++i) see(500);
  const Time since = now_;
  EXPECT_EQ(look(since).validity, Validity::pending);
  see(400);  // measured at `since`
  see(400);
  EXPECT_EQ(look(since).validity, Validity::pending);
  see(400);
  EXPECT_EQ(look(since).distance, 400_mm);
}

TEST_F(BeamTest, AReadingCountsFromWhenItWasMeasuredNotFromWhenItCame) {
  for (int i = 0; i < 3; ++i) see(500);
  const Time first_measured = Time::from_raw(0);
  EXPECT_EQ(look(first_measured).validity, Validity::ok);
  EXPECT_EQ(look(first_measured + milliseconds(1)).validity, Validity::pending);
}

TEST_F(BeamTest, FromAResetOnItIsPendingAndNotYetLost) {
  for (int i = 0; i < 3; ++i) see(500);
  now_ = now_ + milliseconds(5000);
  beam_.reset(now_);
  EXPECT_EQ(look().validity, Validity::pending);
  EXPECT_EQ(beam_.lost_for(now_), 0_ms);
  beam_.miss(now_ + milliseconds(100), params_, health_);
  EXPECT_EQ(beam_.latest().validity, Validity::pending);
  EXPECT_EQ(beam_.lost_for(now_ + milliseconds(100)), 100_ms);
  beam_.miss(now_ + milliseconds(101), params_, health_);
  EXPECT_EQ(beam_.latest().validity, Validity::stale);
}

TEST_F(BeamTest, TheSameSequenceIsTheSameReading) {
  see(500);
  repeat_old_reading(5, 500);
  EXPECT_EQ(look().validity, Validity::pending);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
}

TEST_F(BeamTest, WithoutNewReadingsItGoesStaleOnceAndRecovers) {
  beam_.reset(now_);
  see(500);
  repeat_old_reading(10, 500);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);  // 100 ms
  repeat_old_reading(1, 500);
  EXPECT_EQ(beam_.latest().validity, Validity::stale);
  repeat_old_reading(9, 500);
  EXPECT_EQ(health_.range_stale, 1U);
  EXPECT_EQ(beam_.lost_for(now_), 200_ms);
  see(500);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
  EXPECT_EQ(beam_.lost_for(now_), Duration{});
}

TEST_F(BeamTest, AStaleStatusOrAnAbsentReadingOnlyAges) {
  beam_.reset(now_);
  see(500);
  for (int i = 0; i < 6; ++i) see(RangeStatus::stale, 0);
  EXPECT_EQ(beam_.latest().validity, Validity::stale);
  see(500);
  now_ = now_ + milliseconds(101);
  beam_.miss(now_, params_, health_);
  EXPECT_EQ(beam_.latest().validity, Validity::stale);
  EXPECT_EQ(health_.range_stale, 2U);
}

/// Repeats 700 mm while the body turns on the spot.
class StuckBeamTest : public BeamTest {
 protected:
  void turn_to(int deg, Vec at = {}) {
    for (; deg_ <= deg; deg_ += 3) see(RangeStatus::ok, 700, Pose{at, Angle::turns(deg_, 360)});
  }
  Validity ahead(Length way, std::uint16_t mm = 700) {
    const Angle heading = Angle::turns(deg_ - 3, 360);
    see(RangeStatus::ok, mm, Pose{polar(heading, way), heading});
    return beam_.latest().validity;
  }
  int deg_ = 0;  // of the next reading
};

TEST_F(StuckBeamTest, TheSameMillimetreOverATurnAndThenOverSomeWayIsStuck) {
  turn_to(150);
  EXPECT_EQ(beam_.latest().validity, Validity::ok) << "it may be a round room";
  EXPECT_EQ(ahead(20_mm), Validity::ok);
  EXPECT_EQ(ahead(21_mm), Validity::stuck);
  EXPECT_EQ(ahead(0_mm), Validity::stuck) << "until the distance differs";
  EXPECT_EQ(health_.range_stuck, 2U);
  EXPECT_EQ(ahead(0_mm, 701), Validity::ok);
  EXPECT_EQ(ahead(30_mm, 701), Validity::ok);
}

TEST_F(StuckBeamTest, AConstantDistanceBeyondTheRangeIsNoStuckSensor) {
  for (const std::uint16_t mm : Readings{2000, 4000}) {
    for (int deg = 0; deg < 360; deg += 3) see(RangeStatus::ok, mm, Angle::turns(deg, 360));
    EXPECT_EQ(ahead(500_mm, mm), Validity::clear);
  }
  EXPECT_EQ(health_.range_stuck, 0U);
}

TEST_F(StuckBeamTest, TurnsOnForEverInARoundRoom) {
  turn_to(2000);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
  EXPECT_EQ(ahead(10_mm, 690), Validity::ok);
  EXPECT_EQ(ahead(500_mm, 690), Validity::ok);
  EXPECT_EQ(health_.range_stuck, 0U);
}

TEST_F(StuckBeamTest, ALesserTurnLeavesItOpenOverAnyWay) {
  turn_to(147);
  for (int mm = 0; mm < 3000; mm += 6) EXPECT_EQ(ahead(millimetres(mm)), Validity::ok) << "along a wall";
}

TEST_F(StuckBeamTest, TheTurnCountsWhicheverWayTheBodyLooked) {
  deg_ = 100;
  turn_to(250);
  EXPECT_EQ(ahead(21_mm), Validity::stuck);
}

/// On a circle of this radius, with its centre to the left.
Pose on_circle(Length radius, int deg) {
  const Angle heading = Angle::turns(deg, 360);
  return {polar(heading - 90_deg, radius), heading};
}

TEST_F(StuckBeamTest, CirclesForEverRoundAPillar) {
  for (const int way : {3, -3}) {
    for (int deg = 0; deg != 900 * (way / 3); deg += way) see(RangeStatus::ok, 700, on_circle(1_m, deg));
    EXPECT_EQ(health_.range_stuck, 0U);
    see(701);
  }
}

TEST_F(StuckBeamTest, LeavingTheCircleShowsThatItIsStuck) {
  for (int deg = 0; deg <= 180; deg += 3) see(RangeStatus::ok, 700, on_circle(1_m, deg));
  const Pose left = on_circle(1_m, 180);
  const auto ahead = [&](Length way) {
    see(RangeStatus::ok, 700, Pose{left.at + polar(left.heading, way), left.heading});
  };
  for (int mm = 0; mm <= 144; mm += 6) ahead(millimetres(mm));
  EXPECT_EQ(health_.range_stuck, 0U) << "a tangent leaves the circle slowly";
  ahead(146_mm);
  EXPECT_EQ(beam_.latest().validity, Validity::stuck);
}

TEST_F(StuckBeamTest, AWayBeforeTheTurnIsNoRotation) {
  for (int mm = -1000; mm < 0; mm += 6) see(RangeStatus::ok, 700, Pose{{millimetres(mm), 0_mm}, {}});
  turn_to(150);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
  turn_to(171);
  EXPECT_EQ(beam_.latest().validity, Validity::stuck) << "it was not here all the time";
}

TEST_F(StuckBeamTest, ABodyThatIsPutDownElsewhereHasNotMoved) {
  turn_to(150);
  beam_.put_down();
  EXPECT_EQ(ahead(900_mm), Validity::ok);
}

TEST_F(BeamTest, AClearReadingInBetweenIsNoStuckSensor) {
  for (int deg = 0; deg < 100; deg += 3) see(RangeStatus::ok, 700, Angle::turns(deg, 360));
  see(RangeStatus::clear, 0, Angle::turns(100, 360));
  for (int deg = 103; deg < 200; deg += 3) see(RangeStatus::ok, 700, Angle::turns(deg, 360));
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
  EXPECT_EQ(health_.range_stuck, 0U);
}

TEST_F(BeamTest, TwoThingsEquallyFarAreNotAStuckSensor) {
  for (int deg = 0; deg < 120; deg += 3) see(RangeStatus::ok, 167, Angle::turns(deg, 360));
  EXPECT_EQ(health_.range_stuck, 0U);
}

TEST_F(BeamTest, DrivingAlongAWallIsNotStuck) {
  for (int i = 0; i < 200; ++i) see(700);
  EXPECT_EQ(beam_.latest().validity, Validity::ok);
  EXPECT_EQ(health_.range_stuck, 0U);
}

TEST_F(BeamTest, TheMedianOutvotesTheMinority) {
  params_.conditioning.consensus = Consensus::median;
  see(500);
  see(RangeStatus::clear, 0);
  EXPECT_EQ(look().validity, Validity::pending);
  see(510);
  EXPECT_EQ(look().distance, 510_mm);
}

/// Three of ten readings of empty space are phantoms at 0.1 to 0.5 m; the beam has learnt that.
class PhantomTest : public BeamTest {
 protected:
  PhantomTest() {
    for (int i = 0; i < 500; ++i) see_nothing();
  }
  void see_nothing() {
    if (std::bernoulli_distribution{0.3}(random_)) {
      see(std::uniform_int_distribution<std::uint16_t>{100, 500}(random_));
    } else {
      see(RangeStatus::clear, 0);
    }
  }
  RecentReadings sight() const { return beam_.sight(params_); }

  std::mt19937 random_{1};
};

TEST_F(PhantomTest, HardlyAnyCountsAsAnEcho) {
  constexpr int kCount = 10000;
  int decided = 0;
  int echoes = 0;
  int near = 0;
  for (int i = 0; i < kCount; ++i) {
    see_nothing();
    decided += sight().fresh ? 1 : 0;
    echoes += sight().fresh && sight().near.validity != Validity::clear ? 1 : 0;
    near += sight().typical.validity != Validity::clear ? 1 : 0;
    EXPECT_FALSE(sight().misses) << i;  // nothing is there to be missed
  }
  EXPECT_GT(decided, kCount / 2);
  EXPECT_LT(echoes, kCount / 500);
  EXPECT_LT(near, kCount / 500);
}

TEST_F(PhantomTest, AFarWallBeforeWhichThereAreNoneDoesNotMakeTheBeamForgetThem) {
  for (int i = 0; i < 500; ++i) see(900);
  see(RangeStatus::clear, 0);
  see(RangeStatus::clear, 0);
  see(RangeStatus::clear, 0);
  see(300);
  EXPECT_EQ(sight().near.validity, Validity::clear);
}

TEST_F(PhantomTest, AnObjectCountsFromTheFourthReadingOnAndIsClearInNone) {
  for (int trial = 0; trial < 200; ++trial) {
    for (int i = 0; i < 20; ++i) see_nothing();
    see(400);  // `single`: clear only together with the reading before, which saw nothing
    for (int i = 1; i < 3; ++i) {
      see(400);
      EXPECT_TRUE(!sight().fresh || sight().near.validity != Validity::clear) << trial;
    }
    see(400);
    EXPECT_TRUE(sight().fresh);
    EXPECT_LE(sight().near.distance, 400_mm);
  }
}

TEST_F(PhantomTest, ALoneFalseClearAfterTwoEchoesClearsNothing) {
  for (int i = 0; i < 20; ++i) see(RangeStatus::clear, 0);
  see(400);
  see(400);
  see(RangeStatus::clear, 0);
  EXPECT_FALSE(sight().fresh);
}

/// Three of ten readings miss the object; the beam has learnt that.
class MissTest : public BeamTest {
 protected:
  MissTest() {
    for (int i = 0; i < 500; ++i) see_object();
  }
  void see_object() {
    if (std::bernoulli_distribution{0.3}(random_)) {
      miss();
    } else {
      see(400);
    }
  }
  void miss() { see(RangeStatus::clear, 0); }
  RecentReadings sight() const { return beam_.sight(params_); }

  std::mt19937 random_{1};
};

TEST_F(MissTest, ALoneEchoOfFiveIsNotOutvoted) {
  ASSERT_TRUE(sight().misses);
  see(400);
  for (int i = 0; i < 4; ++i) miss();
  EXPECT_TRUE(!sight().fresh || sight().near.distance <= 400_mm);
  miss();
  EXPECT_TRUE(sight().fresh);
  EXPECT_EQ(sight().near.validity, Validity::clear);
}

TEST(RangeConditioner, IsAsLostAsItsWorstBeam) {
  Params params;
  Health health;
  RangeConditioner conditioner;
  conditioner.reset(Time::from_raw(0));
  hal::RangeReadings readings{};
  for (std::uint8_t i = 0; i < 12; ++i) {
    for (int b = 0; b < hal::kBeams; ++b) {
      const bool dead = b == hal::kRight;
      readings.beam[b] = {300, dead ? RangeStatus::invalid : RangeStatus::ok, 20,
                          static_cast<std::uint8_t>(i % 16)};
    }
    conditioner.update(&readings, Time::from_raw(20U * (i + 1U)), Pose{}, params, health);
  }
  const Echoes look = conditioner.look(Time::from_raw(0), params);
  EXPECT_EQ(look.beam[hal::kLeft].distance, 300_mm);
  EXPECT_EQ(look.beam[hal::kRight].validity, Validity::pending);
  EXPECT_FALSE(usable(look));
  EXPECT_EQ(conditioner.lost_for(Time::from_raw(240)), 240_ms);
  conditioner.update(nullptr, Time::from_raw(500), Pose{}, params, health);
  EXPECT_EQ(conditioner.latest().beam[hal::kLeft].validity, Validity::stale);
}

}  // namespace
}  // namespace whisker::perception
