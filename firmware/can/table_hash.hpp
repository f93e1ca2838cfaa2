#pragma once

#include <stdint.h>

#include "firmware/can/table.hpp"

namespace whisker::can {

/// FNV-1a 32, at compile time.
class TableHash {
 public:
  constexpr void add(const char* text) noexcept {
    for (; *text != 0; ++text) byte(static_cast<uint8_t>(*text));
    byte(0);
  }
  constexpr void add(int64_t number) noexcept {
    auto bits = static_cast<uint64_t>(number);
    for (int i = 0; i < 8; ++i, bits >>= 8) byte(static_cast<uint8_t>(bits));
  }
  constexpr uint32_t value() const noexcept { return value_; }

 private:
  constexpr void byte(uint8_t b) noexcept { value_ = (value_ ^ b) * UINT32_C(0x01000193); }
  uint32_t value_ = UINT32_C(0x811C9DC5);
};

/// Hash of everything that defines the meaning of a frame: nodes with the same hash are compatible.
constexpr uint32_t table_hash() noexcept {
  TableHash hash;
  hash.add(int64_t{kProtocol});
  for (const Message& m : kMessages) {
    hash.add(m.name);
    hash.add(int64_t{m.function});
    hash.add(int64_t{m.size});
    for (uint8_t i = 0; i < m.count; ++i) {
      const Signal& s = m.signals[i];
      hash.add(s.name);
      hash.add(int64_t{s.start} << 16 | int64_t{s.length} << 8 | (s.is_signed ? 1 : 0));
      hash.add(s.min);
      hash.add(s.max);
      hash.add(s.factor);
      hash.add(s.unit);
      hash.add(int64_t{s.part});
    }
  }
  return hash.value();
}

inline constexpr uint32_t kTableHash = table_hash();

}  // namespace whisker::can
