// What is written into the robot file.
#include <gmock/gmock.h>

#include "host/lab/calibration/calibration.hpp"

namespace whisker::calibration {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// All as believed, L = 60.
Calibration as_believed(const Params& params) {
  Calibration c;
  for (std::size_t i = 0; i < c.fits.size(); ++i) {
    c.believed[i] = believed(params, static_cast<int>(i));
    BeamFit& f = c.fits[i];
    f.trouble = Trouble::none;
    f.axis_deg = c.believed[i].axis_deg;
    f.half_cone_deg = c.believed[i].half_cone_deg;
    f.edge_deg = f.sure_edge_deg = f.half_cone_deg + 60;
    f.axis_error_deg = f.half_cone_error_deg = f.edge_error_deg = 0.1;
  }
  return c;
}

TEST(Advice, WritesOnlyWhatIsCertainlyDifferent) {
  const Params p;
  const Advice a = advise(as_believed(p), p);
  EXPECT_THAT(a.lines, ElementsAre("range_incidence_deg = 59.5"));
  EXPECT_THAT(a.notes, IsEmpty());
  EXPECT_TRUE(a.fits);
  EXPECT_EQ(a.params.rangefinders.incidence, Angle::turns(119, 720));
}

TEST(Advice, WritesAxes) {
  const Params p;
  Calibration c = as_believed(p);
  c.fits[0].axis_deg = 34.26;
  c.fits[1].axis_deg = -1.23;
  c.fits[2].axis_deg = -30.4;
  const Advice a = advise(c, p);
  EXPECT_THAT(a.lines, ElementsAre("range_left_angle_deg = 34.3", "range_front_angle_deg = -1.2",
                                   "range_incidence_deg = 59.5"));
  c.fits[0].axis_error_deg = 3;
  EXPECT_THAT(advise(c, p).lines, Not(Contains(HasSubstr("left"))));
}

TEST(Advice, TakesTheSmallestIncidenceToTheSafeSide) {
  const Params p;
  Calibration c = as_believed(p);
  c.fits[1].edge_deg = c.fits[1].sure_edge_deg = 12.5 + 55.4;
  EXPECT_THAT(advise(c, p).lines, ElementsAre("range_incidence_deg = 55"));
  c.fits[1].edge_error_deg = 1;
  EXPECT_THAT(advise(c, p).lines, ElementsAre("range_incidence_deg = 53"));
  c.fits[1].half_cone_deg = 15;
  EXPECT_THAT(advise(c, p).lines, ElementsAre("range_incidence_deg = 50.5")) << "the wider cone counts";
}

TEST(Advice, ASoftEdgeCountsUpToWhereItIsSure) {
  const Params p;
  Calibration c = as_believed(p);
  c.fits[2].sure_edge_deg = 12.5 + 52;
  const Advice a = advise(c, p);
  EXPECT_THAT(a.lines, ElementsAre("range_incidence_deg = 51.5"));
  EXPECT_THAT(a.notes, Contains(HasSubstr("the edge of the right beam is soft: from 64.5 to 72.5")));
  EXPECT_THAT(a.notes, Contains(HasSubstr("walls ahead may be invisible")));
}

TEST(Advice, ANarrowConeIsWritten) {
  const Params p;
  Calibration c = as_believed(p);
  c.fits[0].half_cone_deg = 11.2;
  const Advice a = advise(c, p);
  EXPECT_THAT(a.lines, Contains("range_left_cone_deg = 22"));
  EXPECT_THAT(a.notes, Contains(HasSubstr("the left cone is 22.4 degrees wide")));
}

TEST(Advice, WarnsOfInvisibleWalls) {
  const Params p;
  Calibration c = as_believed(p);
  for (BeamFit& f : c.fits) f.edge_deg = f.sure_edge_deg = 12.5 + 50.3;
  const Advice a = advise(c, p);
  EXPECT_THAT(a.lines, ElementsAre("range_incidence_deg = 50"));
  EXPECT_THAT(a.notes, ElementsAre(HasSubstr("walls ahead may be invisible")));
}

TEST(Advice, NamesTheRelationThatBreaks) {
  const Params p;
  Calibration c = as_believed(p);
  c.fits[0].axis_deg = -10;
  const Advice a = advise(c, p);
  EXPECT_FALSE(a.fits);
  EXPECT_THAT(a.notes.front(),
              HasSubstr("do not fit together with these lines: range_left_angle_deg must be"));
}

TEST(Advice, AsksWhetherTheBodyWasSquare) {
  const Params p;
  Calibration c = as_believed(p);
  for (BeamFit& f : c.fits) f.axis_deg += 4;
  EXPECT_THAT(advise(c, p).notes, Contains(HasSubstr("all beams are turned by 4.0 degrees")));
  c.fits[2].axis_deg -= 8;
  EXPECT_THAT(advise(c, p).notes, Not(Contains(HasSubstr("all beams are turned"))));
}

TEST(Advice, WithoutABeamThereIsNoIncidence) {
  const Params p;
  Calibration c = as_believed(p);
  c.fits[0].axis_deg = 36;
  c.fits[1].trouble = Trouble::no_wall;
  EXPECT_THAT(advise(c, p).lines, ElementsAre("range_left_angle_deg = 36"));
  EXPECT_FALSE(c.complete());
}

TEST(Advice, AZeroAngleDoesNotStandForTheSharedOne) {
  const Params p;
  Calibration c = as_believed(p);
  c.fits[0].axis_deg = 0.01;
  EXPECT_THAT(advise(c, p).lines, Contains("range_left_angle_deg = 0.1"));
}

TEST(Trouble, HasWords) {
  const Believed beam = believed({}, 0);
  BeamFit f;
  for (const Trouble t : {Trouble::few_readings, Trouble::not_enough_turn, Trouble::nothing_seen,
                          Trouble::no_wall, Trouble::second_wall, Trouble::too_noisy}) {
    f.trouble = t;
    EXPECT_GT(trouble_words(beam, f).size(), 20U);
    EXPECT_EQ(trouble_words(beam, f).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace whisker::calibration
