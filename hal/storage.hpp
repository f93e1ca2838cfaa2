#pragma once

#include <stdint.h>

namespace whisker::hal {

/// Memory that keeps two small records without power; optional. Calibration uses it
/// (firmware/calibration/store.hpp).
///
/// The slots are independent: a write, also one that fails or that a loss of power cuts short, changes no
/// byte of the other slot. Flash therefore needs a page or sector for each.
class Storage {
 public:
  static constexpr uint8_t kSlots = 2;
  /// Least size of a slot, bytes.
  static constexpr uint8_t kSlotBytes = 64;

  /// Copies the first `size` bytes of a slot, whatever they are: an erased slot has any bytes. slot < kSlots,
  /// size <= kSlotBytes. False: the memory does not answer; `out` is undefined.
  virtual bool read(uint8_t slot, uint8_t* out, uint8_t size) noexcept = 0;
  /// Replaces the first `size` bytes of a slot. May block for seconds while flash is erased: call it only
  /// while the wheels stand. If the power fails meanwhile, the slot has any bytes. False: the write failed,
  /// and the slot has any bytes.
  virtual bool write(uint8_t slot, const uint8_t* data, uint8_t size) noexcept = 0;

 protected:
  ~Storage() = default;
};

}  // namespace whisker::hal
