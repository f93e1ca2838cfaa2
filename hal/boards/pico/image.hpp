/// The sum that an image carries of itself. Nothing in a UF2 file or in the boot ROM finds a flipped byte of
/// it.
#pragma once

#include <stdint.h>

namespace whisker::hal::pico {

/// Behind the vectors. toolchain/uf2.py writes the sum into the file.
struct ImageHeader {
  static constexpr uint32_t kMagic = 0x4B534857;  // "WHSK"
  uint32_t magic;
  const uint8_t* end;  ///< of the image in the flash
  uint32_t sum;        ///< CRC-32 of the image from its start to its end, this word as 0xFFFFFFFF
};

/// Takes 40 ms. False: the image is not the one that was built.
bool image_is_intact() noexcept;

}  // namespace whisker::hal::pico
