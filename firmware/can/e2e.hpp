/// End-to-end protection of a frame: AUTOSAR E2E Profile 1, with the frame's identifier as data id.
///
/// Byte 0 is a CRC-8 (polynomial 0x1D, initial value 0, not inverted) over the data id, low byte first, and
/// all following bytes. The low half of byte 1 is an alive counter: 0 to 14, one more with every frame of
/// this identifier, then 0 again.
/// identifier, then 0 again.
#pragma once

#include <stdint.h>

#include "hal/can_port.hpp"

namespace whisker::can {

constexpr uint8_t kAliveModulus = 15;
/// Number of frames in a row that may be lost before a frame counts as out of sequence.
constexpr uint8_t kMostLost = 7;

namespace crc8 {

struct Table {
  uint8_t of[16];
};

constexpr Table half_byte_table() noexcept {
  Table t{};
  for (int i = 0; i < 16; ++i) {
    int crc = i << 4;
    for (int bit = 0; bit < 4; ++bit) crc = (crc & 0x80) != 0 ? (crc << 1) ^ 0x1D : crc << 1;
    t.of[i] = static_cast<uint8_t>(crc);
  }
  return t;
}

inline constexpr Table kTable = half_byte_table();

constexpr uint8_t add(uint8_t crc, uint8_t byte) noexcept {
  uint8_t c = crc ^ byte;
  c = static_cast<uint8_t>((c << 4) ^ kTable.of[c >> 4]);
  return static_cast<uint8_t>((c << 4) ^ kTable.of[c >> 4]);
}

}  // namespace crc8

/// CRC of bytes 1 to size - 1.
constexpr uint8_t crc_of(uint32_t id, const uint8_t* data, uint8_t size) noexcept {
  uint8_t crc = crc8::add(0, static_cast<uint8_t>(id));
  crc = crc8::add(crc, static_cast<uint8_t>(id >> 8));
  for (uint8_t i = 1; i < size; ++i) crc = crc8::add(crc, data[i]);
  return crc;
}

constexpr uint8_t counter_of(const hal::CanFrame& frame) noexcept { return frame.data[1] & 0x0F; }

/// Counts sent frames of one identifier.
class AliveSender {
 public:
  constexpr uint8_t next() noexcept {
    const uint8_t now = next_;
    next_ = now + 1 < kAliveModulus ? static_cast<uint8_t>(now + 1) : uint8_t{0};
    return now;
  }

 private:
  uint8_t next_ = 0;
};

enum class Arrival : uint8_t {
  in_turn,          ///< the next one, possibly after lost frames
  repeated,         ///< the same counter again
  out_of_sequence,  ///< too far from the last one, or no valid counter
};

/// Checks the counters of one identifier. The first frame after forget() is always in sequence. A frame out
/// of sequence is rejected, but the next one is compared with it.
class AliveReceiver {
 public:
  /// lost: number of frames lost before this one; 0 unless it is in sequence.
  constexpr Arrival judge(uint8_t counter, uint8_t& lost) noexcept {
    lost = 0;
    if (counter >= kAliveModulus) return Arrival::out_of_sequence;
    const bool knew = known_;
    const int ahead = (counter + kAliveModulus - last_) % kAliveModulus;
    if (knew && ahead == 0) return Arrival::repeated;
    known_ = true;
    last_ = counter;
    if (!knew) return Arrival::in_turn;
    if (ahead > kMostLost + 1) return Arrival::out_of_sequence;
    lost = static_cast<uint8_t>(ahead - 1);
    return Arrival::in_turn;
  }
  constexpr void forget() noexcept { known_ = false; }

 private:
  uint8_t last_ = 0;
  bool known_ = false;
};

}  // namespace whisker::can
