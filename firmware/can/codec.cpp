#include "firmware/can/codec.hpp"

namespace whisker::can {

hal::CanFrame sealed(uint64_t bits, uint32_t id, uint8_t size, uint8_t counter) noexcept {
  hal::CanFrame frame{id, false, false, size, {}};
  auto low = static_cast<uint32_t>(bits) | static_cast<uint32_t>(counter) << 8;
  auto high = static_cast<uint32_t>(bits >> 32);
  for (int i = 0; i < 4; ++i, low >>= 8, high >>= 8) {
    frame.data[i] = static_cast<uint8_t>(low);
    frame.data[i + 4] = static_cast<uint8_t>(high);
  }
  frame.data[0] = crc_of(id, frame.data, size);
  return frame;
}

}  // namespace whisker::can
