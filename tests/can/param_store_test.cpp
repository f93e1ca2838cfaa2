// The parameters that a board keeps: whatever breaks, the old ones are there or the new ones.
#include <gtest/gtest.h>

#include "firmware/can/param_server.hpp"
#include "firmware/can/param_store.hpp"
#include "tests/calibration/memory_storage.hpp"

namespace whisker::can {
namespace {

constexpr std::uint16_t kSlot = 512;
constexpr std::uint32_t kVersion = 0x000200;

Params with_speed(Speed speed) {
  Params p;
  p.wheels.max_speed = speed;
  return p;
}

const Params kOld = with_speed(250_mm_per_s);
const Params kNew = with_speed(200_mm_per_s);

std::int32_t speed_in(test::MemoryStorage& storage) {
  Params p;
  EXPECT_EQ(ParamStore(storage, kVersion).load(p), Stored::ok);
  return p.wheels.max_speed.raw();
}

TEST(ParamStoreTest, KeepsEveryParameter) {
  test::MemoryStorage storage(kSlot);
  Params all;
  ASSERT_EQ(ParamStore(storage, kVersion).load(all), Stored::nothing);
  Params changed;
  for (int i = 0; i < kParams; ++i) {
    const std::uint32_t raw = raw_param(changed, i) + 1;
    if (!in_own_range(i, raw)) continue;
    Params one = changed;
    set_raw_param(one, i, raw);
    if (check(one) == ParamFault::none) changed = one;
  }
  ASSERT_EQ(ParamStore(storage, kVersion).save(changed), Stored::ok);
  ASSERT_EQ(ParamStore(storage, kVersion).load(all), Stored::ok);
  for (int i = 0; i < kParams; ++i) EXPECT_EQ(raw_param(all, i), raw_param(changed, i)) << i;
}

TEST(ParamStoreTest, ALossOfPowerAtAnyByteLeavesTheOldOnesOrTheNewOnes) {
  for (int cut = 0; cut < kParamRecordBytes; ++cut) {
    test::MemoryStorage storage(kSlot);
    ASSERT_EQ(ParamStore(storage, kVersion).save(kOld), Stored::ok);
    storage.power = cut;
    EXPECT_NE(ParamStore(storage, kVersion).save(kNew), Stored::ok);
    storage.power = -1;
    ASSERT_EQ(speed_in(storage), kOld.wheels.max_speed.raw()) << cut;
    ASSERT_EQ(ParamStore(storage, kVersion).save(kNew), Stored::ok);
    ASSERT_EQ(speed_in(storage), kNew.wheels.max_speed.raw()) << cut;
  }
  for (int cut = 0; cut < kSlot; ++cut) {
    test::MemoryStorage storage(kSlot);
    ASSERT_EQ(ParamStore(storage, kVersion).save(kOld), Stored::ok);
    storage.erase_power = cut;
    EXPECT_NE(ParamStore(storage, kVersion).save(kNew), Stored::ok);
    ASSERT_EQ(speed_in(storage), kOld.wheels.max_speed.raw()) << cut;
  }
}

TEST(ParamStoreTest, AFlippedBitLosesTheRecord) {
  for (std::size_t bit = 0; bit < 8 * kParamRecordBytes; ++bit) {
    test::MemoryStorage storage(kSlot);
    ASSERT_EQ(ParamStore(storage, kVersion).save(kOld), Stored::ok);
    for (auto& slot : storage.slots) slot[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    Params p;
    EXPECT_EQ(ParamStore(storage, kVersion).load(p), Stored::nothing) << bit;
  }
}

TEST(ParamStoreTest, ARecordOfAnotherFirmwareDoesNotCountAndIsReplaced) {
  test::MemoryStorage storage(kSlot);
  ASSERT_EQ(ParamStore(storage, kVersion + 1).save(kOld), Stored::ok);
  Params p;
  EXPECT_EQ(ParamStore(storage, kVersion).load(p), Stored::other_version);
  ASSERT_EQ(ParamStore(storage, kVersion).save(kNew), Stored::ok);
  EXPECT_EQ(speed_in(storage), kNew.wheels.max_speed.raw());
}

TEST(ParamStoreTest, MemoryThatWearsOutOrIsTooSmallIsNoticed) {
  test::MemoryStorage storage(kSlot);
  storage.keeps = 0xEF;
  EXPECT_EQ(ParamStore(storage, kVersion).save(kNew), Stored::not_written);
  storage.refuses = true;
  EXPECT_EQ(ParamStore(storage, kVersion).save(kNew), Stored::not_written);
  storage.silent = true;
  Params p;
  EXPECT_EQ(ParamStore(storage, kVersion).load(p), Stored::no_answer);
  test::MemoryStorage small;
  EXPECT_EQ(ParamStore(small, kVersion).save(kNew), Stored::not_written);
}

}  // namespace
}  // namespace whisker::can
