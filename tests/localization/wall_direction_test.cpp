#include "firmware/localization/wall_direction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <random>

#include <gtest/gtest.h>

namespace whisker::localization::wall_direction_test {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
// The edges of the reference robot's side beam, from straight ahead.
constexpr double kInner = 17.5 * kDegree, kOuter = 42.5 * kDegree;

struct Point {
  double x, y;
};
Length length(double m) { return Length::from_raw(static_cast<std::int32_t>(std::lround(m * 1e6))); }
Angle angle(double rad) {
  return Angle::from_raw(static_cast<std::uint32_t>(std::llround(rad / (360 * kDegree) * 4294967296.0)));
}
double degrees(Angle a) { return a.wrapped() * (360 / 4294967296.0); }

/// How far the nearest point of the object within the left cone is; the apex lies at (x, 0).
using Object = std::function<std::optional<double>(double x)>;

/// Drives along x, 6 mm from reading to reading. The odometry's heading is off by this much.
class Drive {
 public:
  explicit Drive(double off = 0, double noise_m = 0, unsigned seed = 1)
      : off_(off), noise_(0, noise_m), random_(seed) {}

  void past(const Object& object, double from, double to) {
    for (double x = from; x < to; x += 0.006) see(x, object(x));
  }
  void see(double x, std::optional<double> distance, double heading = 0) {
    WallDirection::Echo echo;
    if (distance) {
      const double d = *distance + (noise_.stddev() > 0 ? noise_(random_) : 0);
      const Point p{x + d * std::cos(kOuter), d * std::sin(kOuter)};
      echo.at = {length(p.x * std::cos(off_) - p.y * std::sin(off_)),
                 length(p.x * std::sin(off_) + p.y * std::cos(off_))};
      echo.heading = angle(off_ + heading);
    }
    WallDirection::Found found;
    if (walls.pass(hal::kLeft, distance ? &echo : nullptr, Angle{}, found)) {
      last = found;
      ++count;
      worst = std::max(worst, std::fabs(degrees(found.ahead) + off_ / kDegree));
      squares += std::pow((degrees(found.ahead) + off_ / kDegree) / degrees(found.sigma), 2);
    }
  }
  void end(double x) { see(x, std::nullopt); }

  WallDirection walls;
  WallDirection::Found last{};
  int count = 0;
  double worst = 0;    // degrees
  double squares = 0;  // of errors over their sigma

 private:
  double off_;
  std::normal_distribution<double> noise_;
  std::mt19937 random_;
};

/// A wall at this distance to the left, from x = begins to x = ends.
Object wall(double y, double begins = -1e3, double ends = 1e3) {
  return [=](double x) -> std::optional<double> {
    const double first = std::max(x + y / std::tan(kOuter), begins);
    const double last = std::min(x + y / std::tan(kInner), ends);
    if (first > last) return std::nullopt;
    return std::hypot(first - x, y);
  };
}

/// A disc; the nearest of many points of its rim.
Object disc(Point centre, double radius) {
  return [=](double x) -> std::optional<double> {
    std::optional<double> nearest;
    for (double a = 0; a < 360; a += 0.25) {
      const Point p{centre.x + radius * std::cos(a * kDegree) - x, centre.y + radius * std::sin(a * kDegree)};
      const double bearing = std::atan2(p.y, p.x), d = std::hypot(p.x, p.y);
      if (bearing < kInner || bearing > kOuter) continue;
      if (!nearest || d < *nearest) nearest = d;
    }
    return nearest;
  };
}

TEST(WallDirection, ALongWallShowsHowFarTheHeadingIsOff) {
  for (const double off : {-9.9, -3.0, -0.5, 0.0, 0.2, 5.0, 9.9}) {
    Drive drive(off * kDegree);
    drive.past(wall(0.3), 0, 2);
    EXPECT_EQ(drive.count, 1) << off;
    EXPECT_LT(drive.worst, 0.02) << off;
    EXPECT_LT(degrees(drive.last.sigma), 0.6);
  }
}

TEST(WallDirection, AWallThatGoesOnIsUsedAgainAndAgain) {
  Drive drive;
  drive.past(wall(0.3), 0, 5);
  EXPECT_GE(drive.count, 5);
  EXPECT_LT(drive.worst, 0.02);
}

TEST(WallDirection, TheSigmaHoldsForReadingsThatScatter) {
  int count = 0;
  double squares = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    Drive drive(0.5 * kDegree, 0.01, seed);
    drive.past(wall(0.3), 0, 4);
    count += drive.count;
    squares += drive.squares;
  }
  const double rms = std::sqrt(squares / count);
  std::printf("%d walls, rms of the error over its sigma %.2f\n", count, rms);
  EXPECT_GE(count, 300);
  EXPECT_GT(rms, 0.4);
  EXPECT_LT(rms, 1.2);
}

TEST(WallDirection, AWallMayBeginAndEndAnywhere) {
  for (const double y : {0.12, 0.2, 0.35, 0.6}) {
    for (double begins = 0; begins < 0.5; begins += 0.05) {
      Drive drive;
      drive.past(wall(y, begins + y, begins + y + 1.6), 0, 4);
      EXPECT_LE(drive.squares, 4 * drive.count) << y << ' ' << begins;
    }
  }
}

TEST(WallDirection, AShortWallSaysNothing) {
  Drive drive;
  drive.past(wall(0.3), 0, 0.3);
  drive.end(0.3);
  EXPECT_EQ(drive.count, 0);
}

TEST(WallDirection, ADiscSaysNothing) {
  for (const double radius : {0.05, 0.1, 0.2, 0.3, 0.5}) {
    Drive drive;
    drive.past(disc({1, 0.15 + radius}, radius), 0, 3);
    drive.end(3);
    EXPECT_EQ(drive.count, 0) << radius;
  }
}

TEST(WallDirection, AGapEndsAWall) {
  Drive drive;
  for (double x = 0; x < 4; x += 0.3) {
    drive.past(wall(0.3), x, x + 0.28);
    drive.past(wall(0.4), x + 0.28, x + 0.3);
  }
  EXPECT_EQ(drive.count, 0);
}

TEST(WallDirection, ATurnOfTheBodyEndsAWall) {
  Drive drive;
  const Object object = wall(0.3);
  for (double x = 0; x < 2; x += 0.006) drive.see(x, object(x), x * 30 * kDegree);
  EXPECT_EQ(drive.count, 0);
}

TEST(WallDirection, ALineCountsIfTheLineBeforeItSaysTheSame) {
  WallDirection walls;
  WallDirection::Found found;
  const auto passes = [&](double direction) {
    for (int i = 0; i < 120; ++i) {
      const double way = 0.006 * i;
      const Vec at{length(way * std::cos(direction * kDegree)), length(way * std::sin(direction * kDegree))};
      const WallDirection::Echo echo{at, {}};
      EXPECT_FALSE(walls.pass(hal::kLeft, &echo, Angle{}, found));
    }
    return walls.pass(hal::kLeft, nullptr, Angle{}, found);
  };
  EXPECT_FALSE(passes(6));
  EXPECT_FALSE(passes(-4));
  EXPECT_FALSE(passes(2));
  EXPECT_TRUE(passes(2.5));
  EXPECT_NEAR(degrees(found.ahead), -2.5, 0.02);
  EXPECT_TRUE(passes(92.5 - 90));
  walls.restart();
  EXPECT_FALSE(passes(2.5));
}

TEST(WallDirection, ToAndFroOnOneSpotIsNoLine) {
  WallDirection walls;
  WallDirection::Found found;
  // Every mean over 60 mm is the same place.
  constexpr int kWay[] = {0, 59, 61, 59};
  for (int i = 0; i < 200; ++i) {
    const WallDirection::Echo echo{{millimetres(kWay[i % 4]), 300_mm}, {}};
    EXPECT_FALSE(walls.pass(hal::kLeft, &echo, Angle{}, found));
  }
  EXPECT_FALSE(walls.pass(hal::kLeft, nullptr, Angle{}, found));
}

TEST(WallDirection, AWallAcrossTheDeclaredDirectionCountsLikeOneAlongIt) {
  WallDirection walls;
  WallDirection::Found found;
  bool any = false;
  for (int i = 0; i < 300; ++i) {
    const WallDirection::Echo echo{{300_mm, millimetres(6 * i)}, 90_deg};
    any = walls.pass(hal::kRight, &echo, 1_deg, found) || any;
  }
  ASSERT_TRUE(any);
  EXPECT_NEAR(degrees(found.ahead), 1, 0.02);
}

}  // namespace
}  // namespace whisker::localization::wall_direction_test
