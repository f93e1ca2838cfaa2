#include "firmware/localization/odometry.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include <gtest/gtest.h>

namespace whisker::localization {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint32_t kMask = hal::kEncoderModulus - 1;
constexpr Duration kSince = milliseconds(90);  // with a period of 10 ms: 100 ms at twice the full speed

struct Drift {
  double position_m;
  double heading_rad;
  double path_m;
};

// The same counts through the core and through doubles: only the core's rounding differs.
Drift drift_over(double path_m, int counts_per_metre, Length track, std::uint64_t seed, int ratio = 1000000) {
  Params params;
  params.wheels.counts_per_metre = counts_per_metre;
  params.body.track = track;
  params.wheels.ratio = millionths(ratio);
  const double skew = (ratio - 1e6) / (ratio + 1e6);
  Odometry odometry;
  odometry.configure(params);
  odometry.place({});
  double x = 0, y = 0, heading = 0, path = 0;
  std::uint32_t left = 0xFFFFF0, right = 5;
  CountStep step;
  odometry.update({left, right}, kSince, step);
  std::uint64_t state = seed;
  int dl = 15, dr = 15;
  for (int tick = 0; path < path_m; ++tick) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    if (tick % 40 == 0) {
      dl = static_cast<int>((state >> 33) % 19) - 2;
      dr = static_cast<int>((state >> 43) % 19) - 2;
    }
    left = (left + static_cast<std::uint32_t>(dl)) & kMask;
    right = (right + static_cast<std::uint32_t>(dr)) & kMask;
    EXPECT_TRUE(odometry.update({left, right}, kSince, step));
    const double sl = static_cast<double>(dl) / counts_per_metre * (1 - skew);
    const double sr = static_cast<double>(dr) / counts_per_metre * (1 + skew);
    const double turn = (sr - sl) / (track.raw() * 1e-6);
    x += (sl + sr) / 2 * std::cos(heading + turn / 2);
    y += (sl + sr) / 2 * std::sin(heading + turn / 2);
    heading += turn;
    path += std::abs(sl + sr) / 2;
  }
  const Pose pose = odometry.pose();
  const double error = std::remainder(pose.heading.wrapped() * (kPi / 2147483648.0) - heading, 2 * kPi);
  return {std::hypot(pose.at.x.raw() * 1e-6 - x, pose.at.y.raw() * 1e-6 - y), std::abs(error), path};
}

TEST(Odometry, CountsOfUnequalWheels) {
  for (const int ratio : {900000, 985000, 1000001, 1100000}) {
    const Drift drift = drift_over(100, 4321, 140_mm, 3, ratio);
    EXPECT_LT(drift.position_m, 1e-3) << ratio;
    EXPECT_LT(drift.heading_rad, 2e-4) << ratio;
  }
}

TEST(Odometry, DriftsLessThanAMillimetreInAKilometre) {
  for (const int counts : {5000, 4321, 1237}) {
    for (const Length track : {millimetres(140), micrometres(123457)}) {
      for (const std::uint64_t seed : {1U, 2U}) {
        const Drift d = drift_over(1000.0, counts, track, seed);
        std::printf("%d counts/m, track %d um, seed %llu: %.4f mm and %.2g rad after %.0f m\n", counts,
                    track.raw(), static_cast<unsigned long long>(seed), d.position_m * 1000, d.heading_rad,
                    d.path_m);
        EXPECT_LT(d.position_m, 1e-3);
        EXPECT_LT(d.heading_rad, 1e-4);
      }
    }
  }
}

/// Two ideal wheels that turn the body on the spot and then drive straight ahead. A counter shows whole
/// counts only, from wherever its wheel stood.
struct IdealWheels {
  IdealWheels(int counts_per_metre, Length track, double phase_left, double phase_right)
      : counts_per_metre_(counts_per_metre),
        track_m_(track.raw() * 1e-6),
        left_(phase_left),
        right_(phase_right) {
    Params params;
    params.wheels.counts_per_metre = counts_per_metre;
    params.body.track = track;
    params.wheels.max_speed = 1000_mm_per_s;
    odometry_.configure(params);
    odometry_.place({});
    count();
  }
  /// Each wheel by this many counts.
  void roll(double left, double right) {
    left_ += left;
    right_ += right;
    const double turn = (right - left) / counts_per_metre_ / track_m_;
    const double way = (left + right) / 2 / counts_per_metre_;
    x_ += way * std::cos(heading_ + turn / 2);
    y_ += way * std::sin(heading_ + turn / 2);
    heading_ += turn;
    count();
  }
  double heading_error() const {
    return std::remainder(odometry_.pose().heading.wrapped() * (kPi / 2147483648.0) - heading_, 2 * kPi);
  }
  double position_error_m() const {
    const Vec at = odometry_.pose().at;
    return std::hypot(at.x.raw() * 1e-6 - x_, at.y.raw() * 1e-6 - y_);
  }

 private:
  void count() {
    CountStep step;
    const auto whole = [](double c) {
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(c)) & kMask;
    };
    EXPECT_TRUE(odometry_.update({whole(left_), whole(right_)}, milliseconds(1000), step));
  }
  double counts_per_metre_, track_m_, left_, right_;
  double x_ = 0, y_ = 0, heading_ = 0;
  Odometry odometry_;
};

// The counters of both wheels are less than a count behind, at the start and now, so their difference is off
// by less than two. If a tick is a whole number of counts, it stays as it is over any way.
TEST(Odometry, IdealWheelsLeaveTheBodyBesideItsEstimateByTwoCountsOverTheTrackTimesTheWay) {
  std::uint64_t state = 7;
  const auto draw = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const int counts_per_metre = static_cast<int>(100 * std::pow(1000, draw()));
    const Length track = millimetres(static_cast<int>(50 + 450 * draw()));
    const double base = 1e6 + draw();
    IdealWheels body(counts_per_metre, track, base, base + draw());
    const double count_m = 1.0 / counts_per_metre, beside = 2 * count_m / (track.raw() * 1e-6);
    const double half_turn = (draw() - 0.5) * 2 * kPi * track.raw() * 1e-6 / 2 * counts_per_metre;
    for (int k = 0; k < 200; ++k) body.roll(-half_turn / 200, half_turn / 200);
    const double way_m = 1 + 199 * draw(), tick = std::floor(0.01 * counts_per_metre) + 1;
    for (double way = 0; way < way_m; way += tick * count_m) body.roll(tick, tick);
    EXPECT_LT(std::abs(body.heading_error()), beside);
    EXPECT_LT(body.position_error_m(), beside * (way_m + 1) + 2 * count_m * (1 + kPi));
    worst = std::fmax(worst, body.position_error_m() / (beside * way_m));
  }
  EXPECT_GT(worst, 0.6) << "else the bound is not that of this drive";
}

TEST(Odometry, TheFirstCountsAreTheZeroWhateverTheyAre) {
  Odometry odometry;
  odometry.configure(Params{});
  odometry.place({{millimetres(5), millimetres(7)}, Angle::turns(1, 8)});
  CountStep step;
  EXPECT_TRUE(odometry.update({123456, 7654321}, kSince, step));
  EXPECT_EQ(odometry.pose().at.x, millimetres(5));
  EXPECT_EQ(odometry.pose().at.y, millimetres(7));
  EXPECT_EQ(odometry.pose().heading, Angle::turns(1, 8));
}

TEST(Odometry, CountsWrapInBothDirections) {
  Odometry odometry;
  odometry.configure(Params{});
  odometry.place({});
  CountStep step;
  odometry.update({kMask, 0}, kSince, step);
  EXPECT_TRUE(odometry.update({4, 5}, kSince, step));
  EXPECT_EQ(step.left, 5);
  EXPECT_EQ(step.right, 5);
  EXPECT_EQ(odometry.pose().at.x, millimetres(1));
  EXPECT_TRUE(odometry.update({kMask, 0}, kSince, step));
  EXPECT_EQ(step.left, -5);
  EXPECT_EQ(odometry.pose().at.x, Length{});
}

TEST(Odometry, MirroredCountsGiveTheMirroredPoseToTheLastBit) {
  Odometry odometry;
  Odometry mirrored;
  odometry.configure(Params{});
  mirrored.configure(Params{});
  const Angle heading = Angle::turns(33, 360);
  odometry.place({{millimetres(1000), millimetres(50)}, heading});
  mirrored.place({{millimetres(1000), millimetres(-50)}, -heading});
  std::uint32_t left = 0, right = 0;
  CountStep step;
  for (std::uint32_t tick = 0; tick < 2000; ++tick) {
    ASSERT_TRUE(odometry.update({left, right}, kSince, step));
    ASSERT_TRUE(mirrored.update({right, left}, kSince, step));
    ASSERT_EQ(mirrored.pose().heading, -odometry.pose().heading) << tick;
    ASSERT_EQ(mirrored.pose().at.x, odometry.pose().at.x) << tick;
    ASSERT_EQ(mirrored.pose().at.y, -odometry.pose().at.y) << tick;
    left = (left + tick * 7 % 11) & kMask;
    right = (right + tick * 5 % 13) & kMask;
  }
}

TEST(Odometry, RefusesAJumpThatNoWheelCanMakeAndGoesOnFromThere) {
  Odometry odometry;
  odometry.configure(Params{});
  odometry.place({});
  CountStep step;
  odometry.update({0, 0}, kSince, step);
  EXPECT_TRUE(
      odometry.update({302, 302}, kSince, step));  // twice 0.3 m/s for 0.1 s is 300 counts; the limit adds 2
  const Pose before = odometry.pose();
  EXPECT_FALSE(odometry.update({605, 302}, kSince, step));
  EXPECT_FALSE(odometry.update({302, 605}, kSince, step));
  EXPECT_EQ(odometry.pose().at.x, before.at.x);
  EXPECT_FALSE(odometry.update({302 + 8000000, 605}, kSince, step));
  EXPECT_TRUE(odometry.update({302 + 8000001, 606}, kSince, step));
  EXPECT_EQ(odometry.pose().at.x, before.at.x + micrometres(200));
}

TEST(Odometry, WhatIsAJumpGoesByTheTimeSinceTheLastCounts) {
  for (const auto& [since_ms, most] : {std::pair{1, 35U}, {10, 62U}, {30, 122U}, {600, 1832U}}) {
    Odometry odometry;
    odometry.configure(Params{});
    odometry.place({});
    CountStep step;
    odometry.update({0, 0}, milliseconds(since_ms), step);
    EXPECT_TRUE(odometry.update({most, 0}, milliseconds(since_ms), step)) << since_ms;
    EXPECT_FALSE(odometry.update({most + most + 1, 0}, milliseconds(since_ms), step)) << since_ms;
  }
}

}  // namespace
}  // namespace whisker::localization
