/// The bytes of stored calibration values.
///
/// | bytes | content |
/// |---|---|
/// | 0 | version of the layout: kVersion |
/// | 1 | size of the record |
/// | 2, 3 | sequence number, low byte first: the record with the later number, modulo 2^16, is the newer |
/// | 4 to 35 | value and sigma of each Quantity, 32 bits each, low byte first |
/// | 36 to 39 | CRC-32 of all bytes before (polynomial 0x04C11DB7 reflected, as in Ethernet), low byte first
/// |
#pragma once

#include <stdint.h>

#include "firmware/calibration/values.hpp"

namespace whisker::calibration {

constexpr uint8_t kVersion = 1;
constexpr uint8_t kRecordBytes = 40;

struct Record {
  Values values;
  uint16_t sequence = 0;
};

enum class Decoded : uint8_t {
  ok,
  damaged,        ///< no record, or an incomplete or changed one
  other_version,  ///< an undamaged record of another layout: newer or older firmware wrote it
};

/// `bytes` has kRecordBytes.
void encode(const Record& record, uint8_t* bytes) noexcept;
/// `bytes` has `size`. Unless ok, `record` is unchanged.
Decoded decode(const uint8_t* bytes, uint8_t size, Record& record) noexcept;

/// CRC-32 of these bytes.
uint32_t crc32(const uint8_t* bytes, uint8_t size) noexcept;

}  // namespace whisker::calibration
