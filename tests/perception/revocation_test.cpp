#include <gtest/gtest.h>

#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "hal/types.hpp"

namespace whisker::test {
namespace {

using perception::ConeObservation;
using perception::LocalGrid;

ConeObservation beam_at(Angle axis, Length free, bool hit) {
  ConeObservation o;
  o.beam.axis = axis;
  o.beam.half_cone = Angle::from_raw(Params{}.rangefinders.cone.raw() / 2);
  o.free = free;
  o.hit = hit;
  return o;
}

class Revocation : public testing::Test {
 protected:
  Revocation() {
    grid_.configure(params_);
    grid_.reset({});
    grid_.move_to({});
  }
  /// A beam that sees nothing, at these angles.
  void clear(Angle from, Angle to) {
    for (Angle axis = from; (to - axis).wrapped() >= 0; axis += 2_deg) grid_.mark(beam_at(axis, 2_m, false));
  }
  void revoke(Angle axis, Length nearest, Length farthest) {
    grid_.revoke(beam_at(axis, nearest, true).beam, nearest, farthest);
  }
  bool clear_at(Length x, Length y) const { return grid_.is_clear({x, y}); }

  const Params params_;
  LocalGrid grid_;
};

TEST_F(Revocation, AnEchoFromClearGroundTakesItBack) {
  clear(-(40_deg), 40_deg);
  ASSERT_TRUE(clear_at(205_mm, 0_mm));
  revoke(0_deg, 200_mm, 200_mm);
  EXPECT_FALSE(clear_at(205_mm, 0_mm));
  EXPECT_FALSE(clear_at(200_mm, 30_mm));
  EXPECT_FALSE(clear_at(200_mm, -(30_mm)));
  EXPECT_TRUE(clear_at(160_mm, 0_mm)) << "nearer than the echo";
  EXPECT_TRUE(clear_at(250_mm, 0_mm)) << "beyond the echo";
  EXPECT_TRUE(clear_at(180_mm, 90_mm)) << "beside the cone";
}

TEST_F(Revocation, AnEchoThatUnclearGroundExplainsTakesNothingBack) {
  // Only the right half of the cone is known.
  clear(-(40_deg), -(12_deg));
  ASSERT_TRUE(clear_at(200_mm, -(30_mm)));
  ASSERT_FALSE(clear_at(200_mm, 30_mm));
  revoke(0_deg, 200_mm, 200_mm);
  EXPECT_TRUE(clear_at(200_mm, -(30_mm)));
}

/// An echo at this distance takes back clear ground although the centre of a cell in its cone that is not
/// clear lies 216 mm away.
bool takes_back_before_a_far_cell(Angle incidence, Length distance) {
  Params params;
  params.rangefinders.incidence = incidence;
  LocalGrid grid;
  grid.configure(params);
  grid.reset({});
  grid.move_to({});
  for (Angle axis = -(40_deg); (40_deg - axis).wrapped() >= 0; axis += 2_deg)
    grid.mark(beam_at(axis, 2_m, false));
  grid.block({210_mm, 50_mm}, 1_mm);
  EXPECT_FALSE(grid.is_clear({210_mm, 50_mm}));
  grid.revoke(beam_at(0_deg, distance, true).beam, distance, distance);
  return !grid.is_clear({distance + 5_mm, 10_mm});
}

TEST_F(Revocation, WhereWallsVanishOnlyUnclearGroundNearTheEchoExplainsIt) {
  EXPECT_TRUE(takes_back_before_a_far_cell(45_deg, 203_mm)) << "13 mm beyond the echo";
  EXPECT_TRUE(takes_back_before_a_far_cell(74_deg, 203_mm));
  EXPECT_FALSE(takes_back_before_a_far_cell(45_deg, 207_mm)) << "9 mm beyond the echo";
  EXPECT_FALSE(takes_back_before_a_far_cell(75_deg, 203_mm)) << "only grazed walls vanish";
  EXPECT_TRUE(takes_back_before_a_far_cell(75_deg, 193_mm)) << "23 mm beyond the echo";
}

TEST_F(Revocation, TheScatterOfAnEchoReachesUnclearGroundThatExplainsIt) {
  clear(-(40_deg), 40_deg);
  LocalGrid all_clear = grid_;
  revoke(0_deg, 200_mm, 200_mm);
  ASSERT_TRUE(clear_at(170_mm, 0_mm));
  revoke(0_deg, 160_mm, 200_mm);
  EXPECT_TRUE(clear_at(170_mm, 0_mm));
  all_clear.revoke(beam_at(0_deg, 160_mm, true).beam, 160_mm, 200_mm);
  EXPECT_FALSE(all_clear.is_clear({170_mm, 0_mm}));
}

TEST_F(Revocation, AllGroundThatScatteringEchoesMayComeFromIsTakenBack) {
  clear(-(40_deg), 40_deg);
  revoke(0_deg, 180_mm, 220_mm);
  EXPECT_FALSE(clear_at(190_mm, 0_mm));
  EXPECT_FALSE(clear_at(225_mm, 0_mm));
  EXPECT_TRUE(clear_at(150_mm, 0_mm));
  EXPECT_TRUE(clear_at(270_mm, 0_mm));
}

TEST_F(Revocation, GroundOutsideTheWindowExplainsAnEcho) {
  clear(-(40_deg), 40_deg);
  ASSERT_TRUE(clear_at(370_mm, 0_mm));
  ASSERT_FALSE(clear_at(390_mm, 0_mm)) << "the window ends at 380 mm";
  revoke(0_deg, 365_mm, 365_mm);
  EXPECT_TRUE(clear_at(370_mm, 0_mm));
}

TEST_F(Revocation, TheSecondEchoIsExplainedByTheFirst) {
  clear(-(40_deg), 40_deg);
  revoke(0_deg, 200_mm, 200_mm);
  revoke(6_deg, 200_mm, 200_mm);
  EXPECT_TRUE(clear_at(190_mm, 62_mm)) << "in the second cone only";
}

TEST_F(Revocation, AnEchoThatAppearsAtASideTakesBackTheArcBesideItsCone) {
  const auto taken = [&](hal::Beam number, Length distance, int32_t radii) {
    LocalGrid grid = grid_;
    ConeObservation echo = beam_at(30_deg, distance, true);
    echo.number = static_cast<int8_t>(number);
    grid.revoke_beside(echo, echo.free, radii);
    return !grid.is_clear(polar(50_deg, distance));
  };
  for (Angle axis = -(40_deg); (80_deg - axis).wrapped() >= 0; axis += 2_deg)
    grid_.mark(beam_at(axis, 2_m, false));
  EXPECT_TRUE(taken(hal::kLeft, 150_mm, 2));
  EXPECT_FALSE(taken(hal::kLeft, 190_mm, 2)) << "farther than two radii";
  EXPECT_TRUE(taken(hal::kLeft, 350_mm, 4));
  EXPECT_FALSE(taken(hal::kLeft, 370_mm, 4));
  EXPECT_FALSE(taken(hal::kFront, 150_mm, 2));
}

TEST_F(Revocation, TheGroundUnderTheBodyStaysClear) {
  clear(-(40_deg), 40_deg);
  revoke(0_deg, 40_mm, 40_mm);
  EXPECT_TRUE(clear_at(50_mm, 0_mm));
}

}  // namespace
}  // namespace whisker::test
