#pragma once

#include <stdint.h>

namespace whisker::hal {

/// Memory that keeps two records without power; optional. Calibration uses one
/// (firmware/calibration/store.hpp), and a response table another (firmware/fuzzy/table_store.hpp).
///
/// The slots are independent: erase() and write(), also if they fail or a loss of power cuts them short,
/// change no byte of the other slot. Flash therefore needs a page or sector for each.
class Storage {
 public:
  static constexpr uint8_t kSlots = 2;
  /// Least size of a slot, bytes.
  static constexpr uint8_t kSlotBytes = 64;
  /// Writes begin and end at multiples of it, bytes.
  static constexpr uint8_t kGrain = 4;

  /// Size of a slot, bytes.
  virtual uint16_t size() const noexcept = 0;
  /// Copies `size` bytes of a slot from byte `at` on, whatever they are: an erased slot has any bytes.
  /// slot < kSlots, at + size <= size(). False: the memory does not answer; `out` is undefined.
  virtual bool read(uint8_t slot, uint16_t at, uint8_t* out, uint16_t size) noexcept = 0;
  /// Prepares a slot for writes; its bytes are lost. May block for seconds while flash is erased: call it
  /// only while the wheels stand. If the power fails meanwhile, the slot has any bytes. False: it failed
  /// likewise.
  virtual bool erase(uint8_t slot) noexcept = 0;
  /// Writes `size` bytes from byte `at` on, each once after erase(). Failures as for erase().
  virtual bool write(uint8_t slot, uint16_t at, const uint8_t* data, uint16_t size) noexcept = 0;

 protected:
  ~Storage() = default;
};

}  // namespace whisker::hal
