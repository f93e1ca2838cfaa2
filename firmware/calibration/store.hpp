/// Keeps calibration values in a storage, so that a loss of power at any instant leaves the old ones or the
/// new ones.
#pragma once

#include <stdint.h>

#include "firmware/calibration/record.hpp"
#include "hal/storage.hpp"

namespace whisker::calibration {

enum class Stored : uint8_t {
  ok,
  nothing,        ///< no slot has an undamaged record
  other_version,  ///< the only records are of another layout; save() replaces one of them
  no_answer,      ///< the storage does not answer
  not_written,    ///< the storage failed to write, or reads back other bytes: the old values are still there
};
const char* name(Stored stored) noexcept;

class Store {
 public:
  /// Must outlive it.
  explicit Store(hal::Storage& storage) noexcept : storage_(storage) {}

  /// The newest undamaged values. Unless ok, `values` is unchanged.
  Stored load(Values& values) noexcept;
  /// Writes into the slot that has not the newest values, and reads it back. Blocks as
  /// hal::Storage::write().
  Stored save(const Values& values) noexcept;

 private:
  struct Newest {
    Record record;
    uint8_t slot = hal::Storage::kSlots - 1;
    Stored found = Stored::nothing;
  };
  Newest newest() noexcept;

  hal::Storage& storage_;
};

}  // namespace whisker::calibration
