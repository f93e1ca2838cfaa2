#include "firmware/perception/approach_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "firmware/params/reach.hpp"
#include "hal/types.hpp"

namespace whisker::test {
namespace {

constexpr double kRadian = M_PI / 180;

/// The front beam loses walls beyond 12.5 + 30 degrees, the right one sees them to 77.5.
Params slanting() {
  Params p;
  p.rangefinders.side_angle = 65_deg;
  p.rangefinders.incidence = 30_deg;
  return p;
}

Length metres(double m) { return Length::from_raw(static_cast<std::int32_t>(std::lround(m * 1e6))); }

perception::ApproachWatch right_beam(const Params& p) {
  perception::ApproachWatch watch;
  watch.configure(p, mount(p.rangefinders, hal::kFront), mount(p.rangefinders, hal::kRight));
  return watch;
}

/// m. The distance from the apex to a wall with this normal, to the right of the course, at the first alarm
/// of a body that drives 0.3 m in steps; none without.
std::optional<double> alarm(const Params& params, double normal_deg, double begins_m, double step_m) {
  perception::ApproachWatch approach = right_beam(params);
  const double closing = std::cos(normal_deg * kRadian);
  for (double way = 0; way < 0.3 && way * closing < begins_m; way += step_m) {
    perception::ConeObservation echo;
    echo.number = hal::kRight;
    echo.hit = true;
    echo.beam.apex = {metres(way), Length{}};
    echo.free = metres(begins_m - way * closing);
    if (approach.ends_at_body(echo)) return begins_m - way * closing;
  }
  return std::nullopt;
}

TEST(ApproachWatch, IsTakenBackWhileTheBodyCanStillStop) {
  const Params p = slanting();
  const double stops = shortest_warning(p).raw() * 1e-6;
  for (double normal = 53; normal <= 77; normal += 1) {
    for (const double step : {0.002, 0.007, 0.015}) {
      const double closing = std::cos(normal * kRadian);
      const auto distance = alarm(p, normal, 0.095 + 0.25 * closing, step);
      ASSERT_TRUE(distance.has_value()) << normal;
      EXPECT_GT(*distance, 0.09 + (stops - step) * closing) << normal;
      EXPECT_LT(*distance, 0.09 + stops * closing + 0.002) << normal;
    }
  }
}

TEST(ApproachWatch, WhatTheBodyPassesTakesNothingBack) {
  EXPECT_FALSE(alarm(slanting(), 90, 0.095, 0.005).has_value()) << "a wall alongside";
  EXPECT_FALSE(alarm(slanting(), 100, 0.095, 0.005).has_value()) << "a wall that recedes";
}

TEST(ApproachWatch, IsNotWatchedWhereTheFrontBeamSeesAsMuch) {
  Params p = slanting();
  p.rangefinders.incidence = 65_deg;
  EXPECT_FALSE(alarm(p, 60, 0.2, 0.005).has_value());
  p.rangefinders.incidence = 64_deg;
  EXPECT_TRUE(alarm(p, 60, 0.2, 0.005).has_value());
  EXPECT_FALSE(alarm(Params{}, 60, 0.2, 0.005).has_value()) << "no wall is lost";
}

TEST(ApproachWatch, EachBeamCountsToItsOwnPartOfTheRim) {
  const Params p = slanting();
  Params ahead = p;
  ahead.rangefinders.offset = 60_mm;
  const auto from = [](const Params& q) { return alarm(q, 60, 0.16, 0.005).value_or(0); };
  EXPECT_NEAR(from(p) - from(ahead), 0.06 * std::cos(12.5 * kRadian), 0.003) << "from an apex near the rim";
}

TEST(ApproachWatch, BeginsAnewAfterAReset) {
  perception::ApproachWatch approach = right_beam(slanting());
  perception::ConeObservation echo;
  const auto at = [&](Length x, Length free) {
    echo.beam.apex = {x, Length{}};
    echo.free = free;
    return approach.ends_at_body(echo);
  };
  EXPECT_FALSE(at(0_mm, 120_mm));
  EXPECT_TRUE(at(25_mm, 105_mm));
  approach.reset();
  EXPECT_FALSE(at(50_mm, 95_mm));
  EXPECT_FALSE(at(200_mm, 92_mm)) << "too far from the echo before to be compared with it";
}

}  // namespace
}  // namespace whisker::test
