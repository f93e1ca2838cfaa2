#include "firmware/calibration/record.hpp"

#include "firmware/storage/words.hpp"

namespace whisker::calibration {
namespace {

using storage::get_word;
using storage::put_word;

constexpr uint8_t kHeaderBytes = 4;
constexpr uint8_t kCrcBytes = 4;
static_assert(kRecordBytes == kHeaderBytes + 8 * kQuantities + kCrcBytes);

}  // namespace

uint32_t crc32(const uint8_t* bytes, uint8_t size) noexcept {
  Crc32 crc;
  for (uint8_t i = 0; i < size; ++i) crc.add(bytes[i]);
  return crc.value();
}

void encode(const Record& record, uint8_t* bytes) noexcept {
  bytes[0] = kVersion;
  bytes[1] = kRecordBytes;
  bytes[2] = static_cast<uint8_t>(record.sequence);
  bytes[3] = static_cast<uint8_t>(record.sequence >> 8);
  uint8_t* at = bytes + kHeaderBytes;
  for (const Measured& measured : record.values.of) {
    put_word(at, static_cast<uint32_t>(measured.value));
    put_word(at + 4, static_cast<uint32_t>(measured.sigma.raw()));
    at += 8;
  }
  put_word(at, crc32(bytes, kRecordBytes - kCrcBytes));
}

Decoded decode(const uint8_t* bytes, uint8_t size, Record& record) noexcept {
  if (size < kHeaderBytes + kCrcBytes) return Decoded::damaged;
  const uint8_t told = bytes[1];
  if (told < kHeaderBytes + kCrcBytes || told > size) return Decoded::damaged;
  const uint8_t protected_bytes = static_cast<uint8_t>(told - kCrcBytes);
  if (get_word(bytes + protected_bytes) != crc32(bytes, protected_bytes)) return Decoded::damaged;
  if (bytes[0] != kVersion || told != kRecordBytes) return Decoded::other_version;
  record.sequence = static_cast<uint16_t>(bytes[2] | bytes[3] << 8);
  const uint8_t* at = bytes + kHeaderBytes;
  for (Measured& measured : record.values.of) {
    measured.value = as_signed(get_word(at));
    measured.sigma = Ratio::from_raw(as_signed(get_word(at + 4)));
    at += 8;
  }
  return Decoded::ok;
}

}  // namespace whisker::calibration
