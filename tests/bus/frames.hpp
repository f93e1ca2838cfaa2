#pragma once

#include <cstdint>
#include <ostream>
#include <tuple>
#include <vector>

#include "hal/can_port.hpp"

namespace whisker::hal {

/// The content on the wire: a remote frame has no data bytes.
inline bool operator==(const CanFrame& a, const CanFrame& b) {
  const auto head = [](const CanFrame& f) { return std::tuple(f.id, f.extended, f.remote, f.size); };
  if (head(a) != head(b)) return false;
  for (int i = 0; i < (a.remote ? 0 : a.size); ++i) {
    if (a.data[i] != b.data[i]) return false;
  }
  return true;
}

inline std::ostream& operator<<(std::ostream& out, const CanFrame& f) {
  out << std::hex << f.id << (f.extended ? "x" : "") << (f.remote ? "#R" : "#") << std::dec << int{f.size};
  for (int i = 0; i < f.size && i < 8; ++i) out << ' ' << int{f.data[i]};
  return out;
}

}  // namespace whisker::hal

namespace whisker::bus {

constexpr std::uint8_t kLife_ms = 20;

inline hal::CanFrame frame(std::uint32_t id, std::uint8_t size = 8, std::uint8_t first = 0) {
  hal::CanFrame f{id, id > 0x7FF, false, size, {}};
  for (std::uint8_t i = 0; i < size; ++i) f.data[i] = static_cast<std::uint8_t>(first + i);
  return f;
}

inline hal::CanFrame remote(std::uint32_t id, std::uint8_t size = 0) {
  return {id, id > 0x7FF, true, size, {}};
}

/// All waiting frames.
inline std::vector<hal::CanFrame> taken(hal::CanPort& port) {
  std::vector<hal::CanFrame> frames;
  for (hal::CanFrame f{}; port.receive(f);) frames.push_back(f);
  return frames;
}

}  // namespace whisker::bus
