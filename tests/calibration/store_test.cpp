#include "firmware/calibration/store.hpp"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "tests/calibration/memory_storage.hpp"

namespace whisker::calibration {
namespace {

Values numbered(std::int32_t n) {
  Values values;
  for (Measured& m : values.of) m = {1000000 + n, millionths(n)}, ++n;
  return values;
}

using Bytes = std::array<std::uint8_t, kRecordBytes>;

Bytes bytes_of(const Values& values, std::uint16_t sequence) {
  Bytes bytes;
  encode({values, sequence}, bytes.data());
  return bytes;
}

Decoded decoded(const Bytes& bytes, Record& record) { return decode(bytes.data(), kRecordBytes, record); }

TEST(CalibrationRecord, CrcIsThatOfEthernet) {
  const std::uint8_t text[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc32(text, 9), 0xCBF43926U);
  EXPECT_EQ(crc32(text, 0), 0U);
}

TEST(CalibrationRecord, ComesBackAsItWas) {
  Values values = numbered(7);
  values.of[2] = {INT32_MIN, Ratio::from_raw(INT32_MAX)};
  for (const int sequence : {0, 1, 0x1234, 0xFFFF}) {
    Record record;
    ASSERT_EQ(decoded(bytes_of(values, static_cast<std::uint16_t>(sequence)), record), Decoded::ok);
    EXPECT_EQ(record.values, values);
    EXPECT_EQ(record.sequence, sequence);
  }
}

// The bytes are a format: another board and the next release read them.
TEST(CalibrationRecord, BytesStayTheSame) {
  Values values;
  values[Quantity::gyro_scale] = {1012345, millionths(70)};
  values[Quantity::track] = {141200, millionths(160)};
  const Bytes bytes = bytes_of(values, 0x0102);
  EXPECT_EQ(bytes, (Bytes{1,    0x28, 2, 1, 0x79, 0x72, 0xf, 0, 0x46, 0,    0,    0,   0, 0,
                          0,    0,    0, 0, 0,    0,    0,   0, 0,    0,    0,    0,   0, 0,
                          0x90, 0x27, 2, 0, 0xa0, 0,    0,   0, 0xe6, 0xc9, 0x4a, 0xae}));
}

TEST(CalibrationRecord, EveryWrongBitOrPairOfBitsIsDetected) {
  for (const Values& values : {Values{}, numbered(1), numbered(-5)}) {
    const Bytes right = bytes_of(values, 3);
    for (int a = 0; a < 8 * kRecordBytes; ++a) {
      for (int b = a; b < 8 * kRecordBytes; ++b) {
        Bytes wrong = right;
        wrong[static_cast<std::size_t>(a / 8)] ^= static_cast<std::uint8_t>(1 << a % 8);
        if (b != a) wrong[static_cast<std::size_t>(b / 8)] ^= static_cast<std::uint8_t>(1 << b % 8);
        Record record{numbered(99), 77};
        ASSERT_EQ(decoded(wrong, record), Decoded::damaged) << a << ", " << b;
        ASSERT_EQ(record.sequence, 77);
      }
    }
  }
}

TEST(CalibrationRecord, ErasedOrShortMemoryIsNoRecord) {
  Record record;
  for (int filled = 0; filled < 256; ++filled) {
    std::array<std::uint8_t, hal::Storage::kSlotBytes> bytes;
    bytes.fill(static_cast<std::uint8_t>(filled));
    EXPECT_EQ(decode(bytes.data(), sizeof bytes, record), Decoded::damaged) << filled;
  }
  const Bytes bytes = bytes_of(numbered(1), 1);
  for (std::uint8_t size = 0; size < kRecordBytes; ++size) {
    EXPECT_EQ(decode(bytes.data(), size, record), Decoded::damaged) << int{size};
  }
}

/// A record of another layout, undamaged.
void write_other(std::uint8_t* bytes, std::uint8_t version, std::uint8_t size) {
  for (int i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i);
  bytes[0] = version;
  bytes[1] = size;
  const std::uint32_t crc = crc32(bytes, static_cast<std::uint8_t>(size - 4));
  for (int i = 0; i < 4; ++i) bytes[size - 4 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
}

TEST(CalibrationStore, AnEmptyOneHasNothingAndKeepsWhatItIsGiven) {
  test::MemoryStorage storage;
  Store store(storage);
  Values values = numbered(50);
  EXPECT_EQ(store.load(values), Stored::nothing);
  EXPECT_EQ(values, numbered(50));
  ASSERT_EQ(store.save(numbered(1)), Stored::ok);
  ASSERT_EQ(store.load(values), Stored::ok);
  EXPECT_EQ(values, numbered(1));
}

// More saves than the sequence number counts: the newest always wins, also where it wraps.
TEST(CalibrationStore, TheNewestIsLoadedAlsoAfterTheSequenceWraps) {
  test::MemoryStorage storage;
  Store store(storage);
  for (int i = 0; i < 66000; ++i) {
    ASSERT_EQ(store.save(numbered(i)), Stored::ok);
    Values values;
    ASSERT_EQ(store.load(values), Stored::ok);
    ASSERT_EQ(values, numbered(i));
  }
}

// Whatever byte the power fails at, and whatever that byte and the rest of the slot become.
TEST(CalibrationStore, PowerThatFailsLeavesTheOldOrTheNewValues) {
  for (const int saves_before : {1, 2, 3}) {
    for (const bool erases : {true, false}) {
      for (const int torn : {0x00, 0xFF, 0x5A, 0x01, 0x28}) {
        for (int bytes = 0; bytes <= kRecordBytes; ++bytes) {
          test::MemoryStorage storage;
          storage.erases = erases;
          storage.torn = static_cast<std::uint8_t>(torn);
          Store store(storage);
          for (int i = 1; i <= saves_before; ++i) ASSERT_EQ(store.save(numbered(i)), Stored::ok);
          storage.power = bytes;
          const Stored saved = store.save(numbered(9));
          storage.power = -1;
          Values values;
          ASSERT_EQ(Store(storage).load(values), Stored::ok) << bytes << " bytes";
          // A torn byte may be right by chance: then the new values are complete.
          EXPECT_TRUE(values == numbered(9) || values == numbered(saves_before)) << bytes << " bytes";
          EXPECT_TRUE(bytes > 30 || values == numbered(saves_before)) << bytes << " bytes";
          EXPECT_EQ(saved == Stored::ok, bytes == kRecordBytes);
          EXPECT_TRUE(saved != Stored::ok || values == numbered(9));
          ASSERT_EQ(store.save(numbered(10)), Stored::ok) << "and the next save works";
          ASSERT_EQ(store.load(values), Stored::ok);
          EXPECT_EQ(values, numbered(10));
        }
      }
    }
  }
}

TEST(CalibrationStore, AWrongBitInTheNewestRecordLeavesTheOneBefore) {
  test::MemoryStorage storage;
  Store store(storage);
  ASSERT_EQ(store.save(numbered(1)), Stored::ok);
  ASSERT_EQ(store.save(numbered(2)), Stored::ok);
  const auto good = storage.slots;
  for (std::size_t slot = 0; slot < storage.slots.size(); ++slot) {
    for (std::size_t bit = 0; bit < 8 * std::size_t{kRecordBytes}; ++bit) {
      storage.slots = good;
      storage.slots[slot][bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      Values values;
      ASSERT_EQ(store.load(values), Stored::ok);
      ASSERT_TRUE(values == numbered(1) || values == numbered(2));
    }
  }
}

TEST(CalibrationStore, FailuresHaveNamesAndChangeNothing) {
  test::MemoryStorage storage;
  Store store(storage);
  ASSERT_EQ(store.save(numbered(1)), Stored::ok);
  Values values;
  storage.refuses = true;
  EXPECT_EQ(store.save(numbered(2)), Stored::not_written);
  storage.refuses = false;
  storage.keeps = 0xFE;
  EXPECT_EQ(store.save(numbered(3)), Stored::not_written) << "reads back other bytes";
  ASSERT_EQ(store.load(values), Stored::ok);
  EXPECT_EQ(values, numbered(1));
  storage.silent = true;
  EXPECT_EQ(store.load(values), Stored::no_answer);
  EXPECT_EQ(store.save(numbered(4)), Stored::no_answer);
  EXPECT_STREQ(name(Stored::other_version), "other_version");
}

TEST(CalibrationStore, ABoardStartsWithTheStoredValuesIfTheyFit) {
  test::MemoryStorage storage;
  Store store(storage);
  Params params;
  EXPECT_FALSE(apply_stored(storage, params)) << "nothing is stored";
  Values values;
  values[Quantity::track] = {141200, millionths(160)};
  ASSERT_EQ(store.save(values), Stored::ok);
  EXPECT_TRUE(apply_stored(storage, params));
  EXPECT_EQ(params.body.track.raw(), 141200);
  EXPECT_EQ(params.wheels.counts_per_metre, Params{}.wheels.counts_per_metre);
  values[Quantity::track].value = 9000000;
  ASSERT_EQ(store.save(values), Stored::ok);
  EXPECT_FALSE(apply_stored(storage, params)) << "wider than the body";
  EXPECT_EQ(params.body.track.raw(), 141200);
}

TEST(CalibrationStore, ARecordOfAnotherLayoutIsNotUsedAndNamed) {
  for (const int version : {0, 2, 255}) {
    for (const int size : {12, 40, 64}) {
      test::MemoryStorage storage;
      Store store(storage);
      write_other(storage.slots[0].data(), static_cast<std::uint8_t>(version),
                  static_cast<std::uint8_t>(size));
      Values values = numbered(5);
      EXPECT_EQ(store.load(values), Stored::other_version);
      EXPECT_EQ(values, numbered(5));
      const auto kept = storage.slots[0];
      ASSERT_EQ(store.save(numbered(1)), Stored::ok);
      EXPECT_EQ(storage.slots[0], kept) << "the other firmware finds its own again";
      ASSERT_EQ(store.load(values), Stored::ok);
      EXPECT_EQ(values, numbered(1));
    }
  }
}

}  // namespace
}  // namespace whisker::calibration
