// What belongs to a set, and what its optional frames carry.
#include "firmware/can/input_set.hpp"

#include <cstdint>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "firmware/apps/can/base.hpp"
#include "firmware/apps/can/remote_board.hpp"
#include "host/harness/bus/memory_bus.hpp"

namespace whisker::can {
namespace {

constexpr std::uint32_t kTick = 0x1'0005;
constexpr std::uint16_t kTick16 = 5;

class Set : public testing::Test {
 protected:
  InputSets sets_;

  void measure(std::uint32_t tick) {
    for (int beam = 0; beam < hal::kBeams; ++beam)
      sets_.on_frame(beam, {}, static_cast<std::uint16_t>(tick), BumpState::none);
    WheelState wheels;
    wheels.tick = static_cast<std::uint8_t>(tick % 8);
    sets_.on_frame(wheels);
  }
  void gyro(std::uint32_t tick, const hal::GyroReading& reading = {}, std::uint8_t valid = 1) {
    sets_.on_frame(GyroState{valid, static_cast<std::uint8_t>(tick % 8), reading});
  }
  bool part(FixPart part, std::uint16_t tick, std::uint32_t value = 7) {
    return sets_.on_frame(FixValue{part, tick, value});
  }
  void sync(std::uint32_t tick, bool gyro, bool fix) {
    Sync s;
    s.tick = tick;
    s.gyro = gyro ? 1 : 0;
    s.fix = fix ? 1 : 0;
    sets_.on_frame(s);
  }
};

TEST_F(Set, WithoutOptionalFramesIsFiveFrames) {
  measure(kTick);
  EXPECT_FALSE(sets_.complete());
  sync(kTick, false, false);
  ASSERT_TRUE(sets_.complete());
  EXPECT_FALSE(sets_.set().has_gyro);
  EXPECT_FALSE(sets_.set().has_fix);
}

TEST_F(Set, WaitsForTheGyroThatSyncAnnounces) {
  measure(kTick);
  sync(kTick, true, false);
  EXPECT_FALSE(sets_.complete());
  gyro(kTick - 1);
  EXPECT_FALSE(sets_.complete()) << "of another tick";
  gyro(kTick, {70, 6, 5});
  ASSERT_TRUE(sets_.complete());
  EXPECT_TRUE(sets_.set().gyro_valid);
  EXPECT_EQ(sets_.set().gyro.sum, 70U);
  gyro(kTick, {}, 0);
  ASSERT_TRUE(sets_.complete());
  EXPECT_TRUE(sets_.set().has_gyro);
  EXPECT_FALSE(sets_.set().gyro_valid);
}

TEST_F(Set, IgnoresAGyroThatSyncDoesNotAnnounce) {
  measure(kTick);
  gyro(kTick);
  sync(kTick, false, false);
  ASSERT_TRUE(sets_.complete());
  EXPECT_FALSE(sets_.set().gyro_valid);
}

TEST_F(Set, WaitsForAllPartsOfTheFixThatSyncAnnounces) {
  measure(kTick);
  sync(kTick, false, true);
  for (int i = 0; i < kFixValues; ++i) {
    EXPECT_FALSE(sets_.complete()) << i;
    EXPECT_TRUE(part(static_cast<FixPart>(i), kTick16, static_cast<std::uint32_t>(100 + i)));
  }
  ASSERT_TRUE(sets_.complete());
  const InputSet set = sets_.set();
  ASSERT_TRUE(set.has_fix);
  EXPECT_EQ(set.fix.pose.at.x.raw(), 100);
  EXPECT_EQ(set.fix.pose.at.y.raw(), 101);
  EXPECT_EQ(set.fix.pose.heading.raw(), 102U);
  EXPECT_EQ(set.fix.sigma.along.raw(), 103);
  EXPECT_EQ(set.fix.sigma.across.raw(), 104);
  EXPECT_EQ(set.fix.sigma.heading.raw(), 105U);
}

TEST_F(Set, NeverMixesTheFixesOfTwoTicks) {
  measure(kTick);
  for (int i = 0; i < kFixValues; ++i) part(static_cast<FixPart>(i), kTick16 - 1);
  sync(kTick, false, true);
  EXPECT_FALSE(sets_.complete());
  for (int i = 1; i < kFixValues; ++i) part(static_cast<FixPart>(i), kTick16);
  EXPECT_FALSE(sets_.complete()) << "x is of the tick before";
  part(FixPart::x, kTick16);
  EXPECT_TRUE(sets_.complete());
}

TEST_F(Set, RefusesASigmaOutOfRange) {
  EXPECT_TRUE(part(FixPart::sigma_along, kTick16, kSigmaLimitUm));
  EXPECT_FALSE(part(FixPart::sigma_along, kTick16, kSigmaLimitUm + 1));
  EXPECT_FALSE(part(FixPart::sigma_across, kTick16, UINT32_MAX));
  EXPECT_TRUE(part(FixPart::sigma_heading, kTick16, 1U << 30));
  EXPECT_FALSE(part(FixPart::sigma_heading, kTick16, (1U << 30) + 1));
  EXPECT_TRUE(part(FixPart::x, kTick16, UINT32_MAX)) << "-1 um";
}

RC_GTEST_PROP(Fix, ComesBackFromTheBus, (std::int32_t x, std::int32_t y, std::uint32_t heading)) {
  const auto along = *rc::gen::inRange(0, kSigmaLimitUm + 1);
  const auto turn = *rc::gen::inRange<std::uint32_t>(0, (1U << 30) + 1);
  const localization::UncertainPose in{{{Length::from_raw(x), Length::from_raw(y)}, Angle::from_raw(heading)},
                                       {Length::from_raw(along), 3_mm, Angle::from_raw(turn)}};
  FixParts parts;
  const FixValues values = values_of(in);
  for (int i = 0; i < kFixValues; ++i) {
    FixValue part;
    RC_ASSERT(decode(encode(FixValue{static_cast<FixPart>(i), 9, values.of[i]}, 9, 0), part));
    RC_ASSERT(!parts.complete(9));
    RC_ASSERT(parts.on_frame(part));
  }
  RC_ASSERT(parts.complete(9) && !parts.complete(8));
  const localization::UncertainPose out = parts.fix();
  RC_ASSERT(out.pose.at.x.raw() == x && out.pose.at.y.raw() == y && out.pose.heading.raw() == heading);
  RC_ASSERT(out.sigma.along.raw() == along && out.sigma.across == 3_mm && out.sigma.heading.raw() == turn);
}

TEST(Fix, ASigmaTooLargeForTheBusBecomesTheLargest) {
  const FixValues values = values_of({{}, {1000_m, Length::from_raw(-5), Angle::from_raw(0x9000'0000)}});
  EXPECT_EQ(values.of[3], static_cast<std::uint32_t>(kSigmaLimitUm));
  EXPECT_EQ(values.of[4], 0U);
  EXPECT_EQ(values.of[5], 1U << 30);
}

hal::GyroReading through_a_frame(const hal::GyroReading& reading) {
  GyroState out;
  EXPECT_TRUE(decode(encode(GyroState{1, 0, reading}, 9, 0), out));
  return out.reading;
}

RC_GTEST_PROP(Gyro, TheSumsContinueAsFarAsTheCoreFollowsThem, (std::uint32_t sum, std::uint16_t samples)) {
  hal::GyroReading in{sum, samples, static_cast<std::uint16_t>(samples * 3)};
  can_app::RemoteBoard board;
  hal::GyroReading last_in{}, last_out{};
  for (int step = 0; step < 20; ++step) {
    InputSet set;
    set.has_gyro = set.gyro_valid = true;
    set.gyro = through_a_frame(in);
    board.on_frame(set, false);
    hal::GyroReading out{};
    RC_ASSERT(board.read(out));
    if (step > 0) {
      RC_ASSERT(out.sum - last_out.sum == in.sum - last_in.sum);
      RC_ASSERT(static_cast<std::uint16_t>(out.samples - last_out.samples) ==
                static_cast<std::uint16_t>(in.samples - last_in.samples));
      RC_ASSERT(static_cast<std::uint16_t>(out.saturated - last_out.saturated) ==
                static_cast<std::uint16_t>(in.saturated - last_in.saturated));
    }
    last_in = in;
    last_out = out;
    const int more = *rc::gen::inRange(0, 256);
    const int each = *rc::gen::element(-32767, 32767, 0, 123);
    in.sum += static_cast<std::uint32_t>(more * each);
    in.samples = static_cast<std::uint16_t>(in.samples + more);
    in.saturated = static_cast<std::uint16_t>(in.saturated + (each == 32767 ? more : 0));
  }
}

TEST(Gyro, ASetWithoutOneHasNoReading) {
  can_app::RemoteBoard board;
  InputSet set;
  set.has_gyro = true;
  board.on_frame(set, false);
  hal::GyroReading out{};
  EXPECT_FALSE(board.read(out)) << "it does not answer";
}

/// Rangefinders and wheels that answer, and a gyro that may not.
class Sensors final : public hal::Rangefinders, public hal::Drive, public hal::Gyro {
 public:
  bool gyro_answers = true;
  bool read(hal::RangeReadings& out) noexcept override {
    out = {};
    return true;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    out = {};
    return true;
  }
  bool read(hal::GyroReading& out) noexcept override {
    if (gyro_answers) out = {1, 2, 3};
    return gyro_answers;
  }
  bool command(hal::WheelSpeeds) noexcept override { return true; }
};

TEST(Gyro, OneThatDoesNotAnswerIsAnErrorOfTheBaseByName) {
  bus::MemoryBus wire;
  BaseNode node(wire.attach(), {1, 1, 0}, 100);
  Sensors sensors;
  can_app::Base base(node, sensors, sensors, nullptr, &sensors);
  base.measure(1, 10);
  EXPECT_EQ(node.errors() & Error::gyro_refused, 0);
  sensors.gyro_answers = false;
  base.measure(2, 10);
  EXPECT_NE(node.errors() & Error::gyro_refused, 0);
  EXPECT_STREQ(word_in<kErrorWords>(14), "gyro_refused");
  sensors.gyro_answers = true;
  base.measure(3, 10);
  EXPECT_EQ(node.errors() & Error::gyro_refused, 0);
}

}  // namespace
}  // namespace whisker::can
