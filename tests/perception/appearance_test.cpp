// Readings of a standing body through the whole stage.
#include <gtest/gtest.h>

#include "firmware/health.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/perception.hpp"
#include "hal/types.hpp"

namespace whisker::test {
namespace {

constexpr std::uint16_t kNothing = 2000;

class Appearance : public testing::Test {
 protected:
  void begin(const Params& params) {
    params_ = params;
    perception_.configure(params_);
    perception_.forget({});
    perception_.start(now_);
  }
  /// Ten new readings of every beam at this heading, mm.
  void see(Angle heading, std::uint16_t left, std::uint16_t front) {
    for (int i = 0; i < 10; ++i) {
      hal::RangeReadings readings{};
      const std::uint16_t mm[hal::kBeams] = {left, front, kNothing};
      ++sequence_;
      for (int b = 0; b < hal::kBeams; ++b) {
        const auto status = mm[b] == kNothing ? hal::RangeStatus::clear : hal::RangeStatus::ok;
        readings.beam[b] = {mm[b], status, 0, static_cast<std::uint8_t>(sequence_ & 15)};
      }
      now_ = now_ + params_.safety.period;
      perception_.sense(&readings, now_, Pose{{}, heading}, params_, health_);
      perception::Percept out;
      perception_.observe({{{}, heading}, now_, false, {}}, params_, out);
    }
  }
  bool clear_at(Length x, Length y) const { return perception_.local_grid().is_clear({x, y}); }
  /// The right half of the front beam's arc at 200 mm is clear, its left half is hidden behind an echo of the
  /// left beam at 100 mm. Then the front beam gets an echo.
  void see_an_echo_in_half_clear_ground() {
    see(-(14_deg), 100, kNothing);
    ASSERT_TRUE(clear_at(200_mm, -(30_mm)));
    ASSERT_FALSE(clear_at(200_mm, 30_mm));
    see(0_deg, 100, 200);
  }

  Params params_;
  perception::Perception perception_;
  Health health_;
  Time now_;
  int sequence_ = 0;
};

TEST_F(Appearance, AnEchoThatAppearsTakesBackItsArcWhateverExplainsIt) {
  begin({});
  see_an_echo_in_half_clear_ground();
  EXPECT_FALSE(clear_at(200_mm, -(30_mm)));
}

TEST_F(Appearance, AnEchoThatStaysTakesNothingBack) {
  begin({});
  see_an_echo_in_half_clear_ground();
  see(-(14_deg), 100, kNothing);
  EXPECT_TRUE(clear_at(200_mm, -(30_mm))) << "cleared by a look";
  see(-(14_deg), 100, 230);
  ASSERT_TRUE(clear_at(190_mm, -(50_mm)));
  see(-(14_deg), 100, 200);
  EXPECT_TRUE(clear_at(190_mm, -(50_mm))) << "30 mm nearer";
}

TEST_F(Appearance, WhereWallsVanishAnExplainedEchoTakesNothingBack) {
  Params p;
  p.rangefinders.incidence = 45_deg;
  begin(p);
  see_an_echo_in_half_clear_ground();
  EXPECT_TRUE(clear_at(200_mm, -(30_mm)));
}

}  // namespace
}  // namespace whisker::test
