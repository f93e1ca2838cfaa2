#include "firmware/perception/contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/perception/perception.hpp"

namespace whisker::perception {
namespace {

constexpr std::uint8_t kLeft = 1U << hal::kLeft, kFront = 1U << hal::kFront, kRight = 1U << hal::kRight;

double degrees_of(std::uint8_t pressed) {
  Contacts contacts;
  contacts.configure(90_mm);
  contacts.add(pressed, {{1_m, 2_m}, 90_deg});
  const Vec to = contacts.at(0) - Vec{1_m, 2_m};
  EXPECT_NEAR(norm(to).raw(), 120000, 3) << "the disc of 30 mm touches the rim";
  return std::remainder(std::atan2(to.y.raw(), to.x.raw()) * 57.29577951308232 - 90, 360);
}

TEST(Contacts, LieWhereTheSwitchesAre) {
  EXPECT_NEAR(degrees_of(kFront), 0, 0.01);
  EXPECT_NEAR(degrees_of(kLeft), 60, 0.01);
  EXPECT_NEAR(degrees_of(kRight), -60, 0.01);
  EXPECT_NEAR(degrees_of(kLeft | kFront), 30, 0.01);
  EXPECT_NEAR(degrees_of(kLeft | kRight), 0, 0.01) << "a bumper of two halves";
}

TEST(Contacts, OfTheSamePlaceAreOneAndTheOldestIsDropped) {
  Contacts contacts;
  contacts.configure(90_mm);
  for (int i = 0; i < 3; ++i) contacts.add(kFront, {{millimetres(5 * i), 0_m}, 0_deg});
  EXPECT_EQ(contacts.count(), 1);
  for (int i = 1; i <= Contacts::kKept; ++i) contacts.add(kFront, {{millimetres(100 * i), 0_m}, 0_deg});
  EXPECT_EQ(contacts.count(), Contacts::kKept);
  for (int i = 0; i < contacts.count(); ++i) EXPECT_GT(contacts.at(i).x, 130_mm);
}

/// Readings that say that everything is clear.
hal::RangeReadings nothing_near(int tick) {
  hal::RangeReadings readings{};
  for (hal::RangeReading& r : readings.beam)
    r = {0, hal::RangeStatus::clear, 10, static_cast<std::uint8_t>(tick % 16)};
  return readings;
}

TEST(Contacts, StayObstaclesInTheLocalGridWhateverTheBeamsSay) {
  const Params params;
  Perception perception;
  perception.configure(params);
  perception.start(Time{});
  Health health;
  const Pose pose;
  perception.forget(pose);
  Percept percept;
  const auto look = [&](int ticks) {
    static int tick = 0;
    for (int i = 0; i < ticks; ++i, ++tick) {
      const Time now = Time{} + milliseconds(20 * tick);
      const hal::RangeReadings readings = nothing_near(tick);
      perception.sense(&readings, now, pose, params, health);
      percept = Percept{};
      perception.observe({pose, now, true, Time{}}, params, percept);
    }
  };
  look(20);
  const Vec place{120_mm, 0_m};
  ASSERT_TRUE(percept.local_grid->is_clear(place));
  const Reach& reach = percept.local_grid->reach();
  ASSERT_EQ(percept.local_grid->along(pose.at, 0_deg, 100_mm, reach.planning).suspect, 0);
  perception.touch(kFront, pose);
  look(20);
  EXPECT_FALSE(percept.local_grid->is_clear(place));
  EXPECT_GT(percept.local_grid->along(pose.at, 0_deg, 100_mm, reach.planning).suspect, 0)
      << "no planner goes there";
  EXPECT_TRUE(percept.local_grid->approaches(pose.at, {20_mm, 0_mm}, reach.guard))
      << "nor does the guard let it";
  EXPECT_TRUE(percept.local_grid->is_clear({60_mm, 0_m})) << "under the body";
  EXPECT_EQ(percept.contacts->count(), 1);
  perception.forget(pose);
  look(20);
  EXPECT_TRUE(percept.local_grid->is_clear(place));
}

}  // namespace
}  // namespace whisker::perception
