#include "host/campaign/comparison.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace whisker::campaign {
namespace {

Row reached(double time_s, double path_m, std::uint64_t stops = 0, double clearance_m = 0.05) {
  Row row;
  row.verdict = Verdict::reached;
  row.time_s = time_s;
  row.path_m = path_m;
  row.stops = stops;
  row.min_clearance_m = clearance_m;
  row.shortest_m = 4.0;
  return row;
}

Row ended(Verdict verdict) {
  Row row;
  row.verdict = verdict;
  row.shortest_m = 4.0;
  return row;
}

TEST(Comparison, RatiosAreGeometricMeansOfPairs) {
  const Comparison c = compare({{reached(10, 4), reached(20, 4)}, {reached(20, 4), reached(10, 4)}});
  EXPECT_DOUBLE_EQ(c.time->value, 1.0);
  EXPECT_LT(*c.time->low, 1.0);
  EXPECT_GT(*c.time->high, 1.0);
  EXPECT_DOUBLE_EQ(*c.time->low * *c.time->high, 1.0);
  EXPECT_DOUBLE_EQ(c.path->value, 1.0);
}

TEST(Comparison, EqualPairsLeaveNoDoubt) {
  const Comparison c = compare({{reached(10, 5), reached(5, 5)}, {reached(8, 4), reached(4, 4)}});
  EXPECT_DOUBLE_EQ(c.time->value, 0.5);
  EXPECT_DOUBLE_EQ(*c.time->low, 0.5);
  EXPECT_DOUBLE_EQ(*c.time->high, 0.5);
}

TEST(Comparison, OnlyWorldsThatBothReachAreTimed) {
  const Comparison c = compare({{reached(10, 4), reached(11, 4)},
                                {reached(10, 4), ended(Verdict::contact)},
                                {ended(Verdict::gave_up), reached(99, 4)},
                                {ended(Verdict::contact), ended(Verdict::contact)}});
  EXPECT_EQ(c.worlds, 4u);
  EXPECT_EQ(c.both, 1u);
  EXPECT_EQ(c.only_a, 1u);
  EXPECT_EQ(c.only_b, 1u);
  EXPECT_EQ(c.contacts_a, 1u);
  EXPECT_EQ(c.contacts_b, 2u);
  EXPECT_DOUBLE_EQ(c.success_a.value, 0.5);
  EXPECT_DOUBLE_EQ(c.time->value, 1.1);
  EXPECT_FALSE(c.time->low);
}

TEST(Comparison, NothingToTimeIsNoFigure) {
  const Comparison c = compare({{ended(Verdict::fault), reached(3, 3)}});
  EXPECT_FALSE(c.time || c.path || c.jerk || c.stops || c.flips || c.clearance);
}

TEST(Comparison, DifferencesCountPerMetreOfTheShortestPath) {
  const Comparison c = compare({{reached(10, 4, 2, 0.05), reached(10, 4, 6, 0.02)}});
  EXPECT_DOUBLE_EQ(c.stops->value, 1.0);
  EXPECT_DOUBLE_EQ(c.clearance->value, -0.03);
}

TEST(JerkMeter, OfASineIsItsAmplitudeOverRootTwo) {
  JerkMeter meter;
  const double w = 2.0, amplitude = 0.1;  // v = A sin(w t): jerk = -A w^2 sin(w t)
  for (int i = 0; i <= 31416; ++i) meter.add(i * 1e-3, amplitude * std::sin(w * i * 1e-3));
  EXPECT_NEAR(meter.rms(), amplitude * w * w / std::sqrt(2.0), 1e-4);
}

TEST(JerkMeter, SteadyAccelerationHasNone) {
  JerkMeter meter;
  EXPECT_EQ(meter.rms(), 0);
  for (int i = 0; i < 100; ++i) meter.add(i * 0.5, i * 0.25);
  EXPECT_NEAR(meter.rms(), 0, 1e-12);
}

}  // namespace
}  // namespace whisker::campaign
