#include "firmware/perception/range_scatter.hpp"

#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace whisker::perception {
namespace {

class ScatterTest : public testing::Test {
 protected:
  void see(hal::RangeStatus status, double mm) {
    now_ = now_ + milliseconds(20);
    sequence_ = static_cast<std::uint8_t>((sequence_ + 1) % 16);
    const auto rounded = static_cast<std::uint16_t>(mm + 0.5);
    beam_.update({rounded, status, 20, sequence_}, now_, {}, params_, health_);
    const RecentReadings sight = beam_.sight(params_);
    if (sight.fresh) scatter_.add(sight);
  }
  void see(double mm) { see(hal::RangeStatus::ok, mm); }
  double allowance_mm() const { return scatter_.allowance().raw() / 1000.0; }

  std::mt19937 random_{1};
  Params params_;
  RangeScatter scatter_;

 private:
  Health health_;
  BeamConditioner beam_;
  Time now_;
  std::uint8_t sequence_ = 7;
};

TEST_F(ScatterTest, DoubtsUntilItHasSeen) { EXPECT_EQ(scatter_.allowance(), 12_mm); }

TEST_F(ScatterTest, AnExactBeamNeedsNoAllowance) {
  for (int i = 0; i < 100; ++i) see(1500 - 5.7 * i);  // at 0.3 m/s, in whole millimetres
  EXPECT_EQ(scatter_.allowance(), 0_mm);
}

TEST_F(ScatterTest, AThingThatComesIntoTheConeIsNoScatter) {
  for (int i = 0; i < 300; ++i) see(i / 10 % 2 == 0 ? 1200 : 400);
  EXPECT_EQ(scatter_.allowance(), 0_mm);
}

TEST_F(ScatterTest, FollowsTheNoise) {
  for (const double sigma : {3.0, 10.0, 20.0}) {
    std::normal_distribution<double> noise(0, sigma);
    for (int i = 0; i < 500; ++i) see(700 + noise(random_));
    double sum = 0;
    for (int i = 0; i < 500; ++i) {
      see(700 + noise(random_));
      sum += allowance_mm();
    }
    EXPECT_NEAR(sum / 500, 1.24 * sigma, 0.12 * sigma + 0.3) << "sigma " << sigma << " mm";
  }
}

TEST_F(ScatterTest, OutliersAndLostReadingsHardlyCount) {
  std::normal_distribution<double> noise(0, 10);
  std::uniform_real_distribution<double> chance(0, 1);
  double sum = 0;
  for (int i = 0; i < 2000; ++i) {
    const double c = chance(random_);
    if (c < 0.02) {
      see(hal::RangeStatus::invalid, 0);
    } else if (c < 0.03) {
      see(hal::RangeStatus::clear, 0);
    } else {
      see(700 + noise(random_));
    }
    if (i >= 1000) sum += allowance_mm();
  }
  EXPECT_NEAR(sum / 1000, 12.4, 2);
}

TEST_F(ScatterTest, WhatIsNoDistanceTeachesNothing) {
  for (int i = 0; i < 100; ++i) see(hal::RangeStatus::clear, 0);
  for (int i = 0; i < 100; ++i) see(hal::RangeStatus::too_near, 0);
  EXPECT_EQ(scatter_.allowance(), 12_mm);
}

}  // namespace
}  // namespace whisker::perception
